// Surfaces in VTK's XML format. VTK itself is not instrumented: what it does with a file is seen only when it crashes, hangs
// or takes too much memory.
#include <cstddef>
#include <cstdint>
#include <exception>
#include <string>

#include "meshing/surface_formats.hpp"
#include "tests/fuzz/library_leaks.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    try {
        static_cast<void>(hemoflux::meshing::parse_vtp({reinterpret_cast<const char*>(data), size}));
    } catch (const std::exception&) {  // read_surface() gives any of them the file's name
    }
    return 0;
}
