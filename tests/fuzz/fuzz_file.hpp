/// Inputs of a fuzzer as a file, for readers that take a name.
#pragma once

#include <unistd.h>

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <string>

namespace hemoflux::fuzz {

/// Writes the input to a file of this process (in memory where /dev/shm is) and returns its name.
inline std::string write(const std::uint8_t* data, std::size_t size, const std::string& extension) {
    static const std::string folder = std::filesystem::is_directory("/dev/shm")
                                          ? "/dev/shm"
                                          : std::filesystem::temp_directory_path().string();
    const std::string name = folder + "/fuzz-" + std::to_string(::getpid()) + extension;
    std::ofstream(name, std::ios::binary)
        .write(reinterpret_cast<const char*>(data), static_cast<std::streamsize>(size));
    return name;
}

}  // namespace hemoflux::fuzz
