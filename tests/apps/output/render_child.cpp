// The child process of the pictures: what `hemoflux render-pictures` does.
#include <cstdlib>
#include <string>
#include <vector>

#include "apps/output/pictures.hpp"

int main(int argc, char** argv) {
    const std::vector<std::string> words(argv + 1, argv + argc);
    if (words.empty() || words.front() != "render-pictures") return 2;
    // no exit handlers: graphics drivers leak in theirs, which the address sanitizer would report as ours
    std::_Exit(hemoflux::output::render_pictures_main({words.begin() + 1, words.end()}));
}
