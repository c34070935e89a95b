// Meshes in VTK's XML format.
#include "exchange/error.hpp"
#include "meshing/hex_io.hpp"
#include "tests/fuzz/fuzz_file.hpp"
#include "tests/fuzz/library_leaks.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const std::string file = hemoflux::fuzz::write(data, size, ".vtu");
    try {
        static_cast<void>(hemoflux::meshing::read_hex_mesh(file));
    } catch (const hemoflux::Error&) {  // whatever else leaves is a defect
    }
    return 0;
}
