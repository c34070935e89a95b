/// Pictures of a run: the cells with a slice of the velocity at several times, as PNG.
///
/// VTK needs a display and ends the process when it finds none, so the pictures are drawn by a child: this
/// program itself with the hidden subcommand `render-pictures DIR`, under xvfb-run where there is no display.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace hemoflux::output {

/// What the pictures show.
struct PictureSpec {
    int count = 6;                      ///< pictures at most, spread evenly over the frames
    int width = 1200, height = 900;     ///< pixels
    std::string slice = "velocity";     ///< cell array of the .vtr whose magnitude is shown
    std::string time_label = "strain";  ///< what the times of the .pvd files are
};

/// What came of it: the files, and a line to print when there is none or not all.
struct Pictures {
    std::vector<std::filesystem::path> files;
    std::string message;  ///< empty when all went well
};

/// Draws picture_NN.png and picture_series.png (all of them side by side) into the output folder from its
/// .pvd files by a child process of program (as a rule "/proc/self/exe"). Never throws: a run does not fail
/// for want of a picture.
Pictures make_pictures(const std::filesystem::path& folder, const PictureSpec& spec = {},
                       const std::filesystem::path& program = "/proc/self/exe");

/// Runs a command that needs a display: on the one there is, else on a hidden one of xvfb-run. Returns why it
/// failed; empty when it did not.
std::string run_on_display(const std::vector<std::string>& command);

/// The command line of the child: `program render-pictures FOLDER ...` with the spec as further words.
std::vector<std::string> render_command(const std::filesystem::path& program,
                                        const std::filesystem::path& folder, const PictureSpec& spec);

/// The child's side: reads the words after "render-pictures" that render_command() wrote, draws the pictures
/// in this process (which needs a display) and returns the exit code. Prints what went wrong on standard
/// error.
int render_pictures_main(const std::vector<std::string>& words);

}  // namespace hemoflux::output
