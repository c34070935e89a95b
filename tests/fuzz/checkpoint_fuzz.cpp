// Checkpoints. The checksum of the input is put right first: what is sought lies behind it.
#include <unistd.h>

#include <boost/crc.hpp>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <string>

#include "apps/output/checkpoint.hpp"
#include "exchange/error.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    std::string bytes(reinterpret_cast<const char*>(data), size);
    constexpr std::size_t size_at = 12, header = 28, checksum = 8;
    if (size >= header + checksum) {
        const std::uint64_t whole = size;
        std::memcpy(bytes.data() + size_at, &whole, sizeof whole);
        boost::crc_optimal<64, 0x42F0E1EBA9EA3693, ~0ULL, ~0ULL, true, true> crc;
        crc.process_bytes(bytes.data(), size - checksum);
        const std::uint64_t sum = crc.checksum();
        std::memcpy(bytes.data() + size - checksum, &sum, sizeof sum);
    }
    static const std::filesystem::path file =
        std::filesystem::temp_directory_path() / ("fuzz-" + std::to_string(::getpid()) + ".bin");
    std::ofstream(file, std::ios::binary) << bytes;
    try {
        const auto checkpoint = hemoflux::output::read_checkpoint(file);
        if (checkpoint.contains("step")) static_cast<void>(checkpoint.number("step"));
    } catch (const hemoflux::Error&) {  // whatever else leaves is a defect
    }
    return 0;
}
