/// A gallery of surfaces: each drawn to one scale with its name and its section, as one PNG.
///
/// Drawn by a child process for the reason given in pictures.hpp: this program itself with the hidden
/// subcommand `render-gallery`.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace hemoflux::output {

/// One surface of a gallery.
struct GalleryItem {
    std::filesystem::path file;  ///< .vtp
    std::string caption;         ///< lines below each other, separated by \n
};

/// What a gallery shows.
struct GallerySpec {
    std::string title;
    std::vector<GalleryItem> items;
    int columns = 4;
    std::string colour = {};  ///< point array that colours the surfaces; empty: blood red
    std::string legend = {};  ///< what the colours mean, with its unit
};

/// Draws the surfaces, and below each its section by the plane y = 0 of its centre, into a PNG file. Returns
/// nothing on success, else one line that says why there is no picture; never throws.
std::optional<std::string> draw_gallery(const GallerySpec& spec, const std::filesystem::path& png,
                                        const std::filesystem::path& program = "/proc/self/exe");

/// The child's side: the words after "render-gallery". Needs a display; returns the exit code and prints what
/// went wrong on standard error.
int render_gallery_main(const std::vector<std::string>& words);

}  // namespace hemoflux::output
