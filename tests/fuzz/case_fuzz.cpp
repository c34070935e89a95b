// Case files: TOML, schema, units, rules between keys.
#include <cstddef>
#include <cstdint>
#include <string>

#include "apps/case.hpp"
#include "exchange/error.hpp"
#include "tests/fuzz/library_leaks.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    try {
        static_cast<void>(
            hemoflux::apps::parse_case({reinterpret_cast<const char*>(data), size}, "case.toml", "/"));
    } catch (const hemoflux::Error&) {  // whatever else leaves is a defect
    }
    return 0;
}
