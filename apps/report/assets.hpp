/// The texts of page.css and viewer.js, built into the program.
#pragma once

#include <string_view>

namespace hemoflux::report {

extern const std::string_view page_css;
extern const std::string_view viewer_js;

}  // namespace hemoflux::report
