#include "apps/output/pictures.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <stdexcept>

#include "apps/output/child.hpp"
#include "apps/output/render.hpp"

namespace hemoflux::output {
namespace fs = std::filesystem;
namespace {

std::vector<fs::path> pictures_in(const fs::path& folder) {
    std::vector<fs::path> files;
    std::error_code error;
    for (const auto& entry : fs::directory_iterator(folder, error)) {
        const std::string name = entry.path().filename().string();
        if (name.starts_with("picture_") && name.ends_with(".png")) files.push_back(entry.path());
    }
    std::sort(files.begin(), files.end());
    return files;
}

Pictures draw(const fs::path& folder, const PictureSpec& spec, const fs::path& given) {
    if (!fs::exists(folder / "cells.pvd") && !fs::exists(folder / "fluid.pvd"))
        return {{}, "no pictures: the run has written no frames"};
    for (const fs::path& old : pictures_in(folder)) fs::remove(old);
    // a shell in between would resolve /proc/self/exe to itself
    const fs::path program = fs::canonical(given);
    const auto command = render_command(program, fs::absolute(folder), spec);
    const std::string reason = run_on_display(command);
    if (reason.empty()) return {pictures_in(folder), {}};
    return {pictures_in(folder), "no pictures: " + reason};
}

}  // namespace

std::string run_on_display(const std::vector<std::string>& command) {
    constexpr std::chrono::seconds limit{300};
    const char* display = std::getenv("DISPLAY");
    std::string reason = "there is no display and xvfb-run is missing (Debian packages xvfb, xauth)";
    if (display && *display) {
        const ChildResult result = run_child(command, "", limit);
        if (result.ok()) return {};
        reason = result.why();
    }
    if (find_program("xvfb-run")) {
        // two searches for a free number that begin at the same one may both find it
        const std::string number = std::to_string(99 + ::getpid() % 900);
        std::vector<std::string> hidden{"xvfb-run", "-a", "-n", number, "-s", "-screen 0 1280x1024x24"};
        hidden.insert(hidden.end(), command.begin(), command.end());
        const ChildResult result = run_child(hidden, "", limit);
        if (result.ok()) return {};
        reason = result.why();
    }
    return reason;
}

std::vector<std::string> render_command(const fs::path& program, const fs::path& folder,
                                        const PictureSpec& spec) {
    return {
        program.string(),           "render-pictures",           folder.string(), std::to_string(spec.count),
        std::to_string(spec.width), std::to_string(spec.height), spec.slice,      spec.time_label};
}

Pictures make_pictures(const fs::path& folder, const PictureSpec& spec, const fs::path& program) {
    try {
        return draw(folder, spec, program);
    } catch (const std::exception& error) {
        return {{}, std::string("no pictures: ") + error.what()};
    }
}

int render_pictures_main(const std::vector<std::string>& words) {
    try {
        if (words.size() != 6) throw std::invalid_argument("render-pictures is called by hemoflux itself");
        PictureSpec spec;
        spec.count = std::stoi(words[1]);
        spec.width = std::stoi(words[2]);
        spec.height = std::stoi(words[3]);
        spec.slice = words[4];
        spec.time_label = words[5];
        render_pictures(words[0], spec);
        return 0;
    } catch (const std::exception& error) {
        std::fprintf(stderr, "%s\n", error.what());
        return 1;
    }
}

}  // namespace hemoflux::output
