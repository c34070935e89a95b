#include "apps/output/gallery.hpp"

#include <cstdio>
#include <stdexcept>

#include "apps/output/child.hpp"
#include "apps/output/pictures.hpp"
#include "apps/output/tiles.hpp"

namespace hemoflux::output {
namespace fs = std::filesystem;
namespace {

constexpr std::size_t words_before_items = 5;

std::vector<std::string> gallery_command(const fs::path& program, const fs::path& png,
                                         const GallerySpec& spec) {
    std::vector<std::string> words{program.string(),
                                   "render-gallery",
                                   fs::absolute(png).string(),
                                   spec.title,
                                   std::to_string(spec.columns),
                                   spec.colour,
                                   spec.legend};
    for (const GalleryItem& item : spec.items) {
        words.push_back(fs::absolute(item.file).string());
        words.push_back(item.caption);
    }
    return words;
}

}  // namespace

std::optional<std::string> draw_gallery(const GallerySpec& spec, const fs::path& png,
                                        const fs::path& program) {
    const std::string none = "no picture " + png.filename().string() + ": ";
    try {
        if (spec.items.empty()) return none + "there is nothing to show";
        const auto why = run_on_display(gallery_command(fs::canonical(program), png, spec));
        return why.empty() ? std::optional<std::string>() : none + why;
    } catch (const std::exception& error) {
        return none + error.what();
    }
}

int render_gallery_main(const std::vector<std::string>& words) {
    try {
        if (words.size() < words_before_items + 2 || (words.size() - words_before_items) % 2 != 0)
            throw std::invalid_argument("render-gallery is called by hemoflux itself");
        GallerySpec spec{.title = words[1],
                         .items = {},
                         .columns = std::stoi(words[2]),
                         .colour = words[3],
                         .legend = words[4]};
        for (std::size_t i = words_before_items; i < words.size(); i += 2)
            spec.items.push_back({words[i], words[i + 1]});
        render_gallery(spec, words[0]);
        return 0;
    } catch (const std::exception& error) {
        std::fprintf(stderr, "%s\n", error.what());
        return 1;
    }
}

}  // namespace hemoflux::output
