/// The pictures of which a gallery is made.
#pragma once

#include <filesystem>

#include "apps/output/gallery.hpp"

namespace hemoflux::output {

/// Draws the gallery in this process, which must have a display. FileError when a surface cannot be read or
/// the picture not be written.
void render_gallery(const GallerySpec& spec, const std::filesystem::path& png);

}  // namespace hemoflux::output
