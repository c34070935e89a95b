/// Drawing of the frames of an output folder by VTK, in this process; needs a display.
#pragma once

#include <filesystem>

#include "apps/output/pictures.hpp"

class vtkImageData;

namespace hemoflux::output {

/// Draws the pictures of make_pictures() into folder. Camera and colour scales are the same in all of them.
/// The slice is the plane through the middle of the box normal to z; one vertex of each cell, the one
/// farthest in x at the first frame, is marked, so that tank treading can be seen. FileError or InputError
/// when the folder holds no frames or they cannot be read.
void render_pictures(const std::filesystem::path& folder, const PictureSpec& spec);

/// Writes an image as PNG, whole at once. FileError.
void write_png(const std::filesystem::path& path, vtkImageData* image);

}  // namespace hemoflux::output
