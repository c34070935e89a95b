# Turns a text file into a C++ source that holds its bytes: cmake -D INPUT=page.css -D OUTPUT=page_css.cpp
# -D NAME=page_css -P embed.cmake defines `const std::string_view hemoflux::report::page_css`.
file(READ ${INPUT} bytes HEX)
string(REGEX REPLACE "(................................)" "\\1\n    " bytes "${bytes}")
string(REGEX REPLACE "([0-9a-f][0-9a-f])" "0x\\1," bytes "${bytes}")
get_filename_component(file ${INPUT} NAME)
file(WRITE ${OUTPUT} "// The bytes of apps/report/${file}.
#include \"apps/report/assets.hpp\"

namespace hemoflux::report {
namespace {
const unsigned char bytes[] = {
    ${bytes}
};
}  // namespace
const std::string_view ${NAME}(reinterpret_cast<const char*>(bytes), sizeof(bytes));
}  // namespace hemoflux::report
")
