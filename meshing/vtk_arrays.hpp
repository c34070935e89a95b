/// What the arrays of a VTK XML file hold. VTK does not survive every array that holds less than its place demands.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "meshing/vtk_markup.hpp"

namespace hemoflux::meshing {

/// Bytes that one packed byte of a file is let unpack to: what zlib packs at most, and any of VTK's compressors in blocks
/// of its usual 32 KiB (LZMA, which could pack more, begins a block with a header of its own).
inline constexpr std::uint64_t best_compression = 1032;

/// Reads the arrays of one file: as text, in base64, or appended in base64 or as bytes; the last three compressed or not.
class VtkArrays {
  public:
    /// The outermost element of the file, and the file from <AppendedData on (empty without). FormatError where the file says
    /// nothing usable about its bytes.
    VtkArrays(const VtkElement& root, std::string_view appended);

    /// FormatError unless the array is of a known type and holds exactly n values of it. VTK looks into those of none too.
    void check(const VtkElement& array, std::uint64_t n) const;
    /// The n whole numbers of an array; FormatError unless it holds exactly those.
    [[nodiscard]] std::vector<std::int64_t> integers(const VtkElement& array, std::uint64_t n) const;

  private:
    [[nodiscard]] std::string bytes(const VtkElement& array) const;
    [[nodiscard]] std::string uncompressed(std::string_view source, bool raw) const;
    [[nodiscard]] std::string decompressed(std::string_view source, bool raw) const;
    [[nodiscard]] std::uint64_t word(const std::string& bytes, std::size_t index) const;

    std::string_view appended_;  ///< behind the underscore
    std::string compressor_;
    std::size_t word_ = 4;  ///< bytes of a number in front of data
    bool raw_ = false, swap_ = false;
};

}  // namespace hemoflux::meshing
