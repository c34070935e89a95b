#include "meshing/vtk_arrays.hpp"

#include <fmt/format.h>
#include <vtkLZ4DataCompressor.h>
#include <vtkLZMADataCompressor.h>
#include <vtkNew.h>
#include <vtkSmartPointer.h>
#include <vtkZLibDataCompressor.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstring>
#include <limits>

#include "meshing/file_text.hpp"
#include "meshing/format_error.hpp"

namespace hemoflux::meshing {
namespace {

/// A type of values: 'f', 'i' or 'u' with its bytes; 's' for strings.
struct Type {
    const char* name;
    char kind;
    std::size_t size;
};

[[noreturn]] void refuse(const VtkElement& array, const std::string& why) {
    throw FormatError(fmt::format("array \"{}\" {}", array.attribute("Name").substr(0, 40), why));
}

[[noreturn]] void refuse_number(const VtkElement& array, std::uint64_t values, std::uint64_t n) {
    refuse(array, fmt::format("holds {} values instead of {}", values, n));
}

const Type& type_of(const VtkElement& array) {
    static constexpr std::array<Type, 11> types{{{"Float64", 'f', 8},
                                                 {"Float32", 'f', 4},
                                                 {"Int64", 'i', 8},
                                                 {"Int32", 'i', 4},
                                                 {"Int16", 'i', 2},
                                                 {"Int8", 'i', 1},
                                                 {"UInt64", 'u', 8},
                                                 {"UInt32", 'u', 4},
                                                 {"UInt16", 'u', 2},
                                                 {"UInt8", 'u', 1},
                                                 {"String", 's', 1}}};
    const std::string_view name = array.attribute("type");
    const auto* found =
        std::find_if(types.begin(), types.end(), [&](const Type& t) { return t.name == name; });
    if (found == types.end())
        refuse(array, fmt::format("is of type \"{}\", which is not read", name.substr(0, 40)));
    return *found;
}

bool is_text(const VtkElement& array) {
    return !array.attributes.contains("offset") && array.attribute("format") != "binary";
}

/// Whether nothing at all stands for the array, not even a header.
bool is_absent(const VtkElement& array) {
    return !array.attributes.contains("offset") &&
           array.text.find_first_not_of(blank) == std::string_view::npos;
}

template <class T>
bool parses(std::string_view word, T& value) {
    if (word.starts_with('+')) {
        word.remove_prefix(1);
        if (word.starts_with('-')) return false;
    }
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
    return error == std::errc() && end == word.data() + word.size();
}

/// Whether VTK's streams read the word as a value of this type.
bool is_value(std::string_view word, const Type& type, std::int64_t& whole) {
    if (type.kind == 'f') {
        double value = 0;
        if (!parses(word, value)) return false;
        if (!std::isfinite(value)) return word.size() <= std::string_view("-nan").size();  // not "infinity"
        return type.size == 8 || std::abs(value) <= std::numeric_limits<float>::max();
    }
    if (type.kind == 'u' && type.size == 8) {
        std::uint64_t value = 0;
        const bool good = parses(word, value);
        whole = static_cast<std::int64_t>(value);
        return good;
    }
    const unsigned bits = static_cast<unsigned>(8 * type.size);
    const std::int64_t high = type.kind == 'u' || type.kind == 's'
                                  ? (std::int64_t{1} << bits) - 1
                                  : std::numeric_limits<std::int64_t>::max() >> (64 - bits);
    return parses(word, whole) && whole <= high && whole >= (type.kind == 'i' ? -high - 1 : 0);
}

/// The whole numbers of an array written as text (of real ones: as many zeros).
std::vector<std::int64_t> words(const VtkElement& array, const Type& type) {
    std::vector<std::int64_t> values;
    std::string_view rest = array.text;
    for (std::size_t at = rest.find_first_not_of(blank); at != std::string_view::npos;
         at = rest.find_first_not_of(blank)) {
        const std::string_view word = rest.substr(at, rest.find_first_of(blank, at) - at);
        rest.remove_prefix(at + word.size());
        std::int64_t whole = 0;
        if (!is_value(word, type, whole))
            refuse(array,
                   fmt::format("holds \"{}\", which is no value of type {}", word.substr(0, 40), type.name));
        values.push_back(whole);
    }
    return values;
}

std::size_t encoded(std::size_t bytes) { return (bytes + 2) / 3 * 4; }

/// The first n bytes encoded in base64.
std::string decode(std::string_view text, std::size_t n) {
    if (text.size() < encoded(n)) throw FormatError("an array in base64 breaks off");
    std::string out;
    out.reserve(n + 2);
    for (std::size_t at = 0; out.size() < n; at += 4) {
        std::uint32_t bits = 0;
        for (std::size_t k = 0; k < 4; ++k) {
            const char c = text[at + k];
            const bool padding = c == '=' && out.size() + k > n && k > 1;
            const std::uint32_t six = c >= 'A' && c <= 'Z'   ? static_cast<std::uint32_t>(c - 'A')
                                      : c >= 'a' && c <= 'z' ? static_cast<std::uint32_t>(c - 'a' + 26)
                                      : c >= '0' && c <= '9' ? static_cast<std::uint32_t>(c - '0' + 52)
                                      : c == '+'             ? 62U
                                      : c == '/'             ? 63U
                                                             : 64U;
            if (six == 64 && !padding)
                throw FormatError("an array is not in base64, or ends before its length");
            bits = bits << 6 | (padding ? 0U : six);
        }
        for (const unsigned shift : {16U, 8U, 0U}) out.push_back(static_cast<char>(bits >> shift & 0xFFU));
    }
    out.resize(n);
    return out;
}

/// The first n bytes of data, as bytes or in base64.
std::string take(std::string_view source, std::size_t n, bool raw) {
    if (source.size() < n) throw FormatError("an array breaks off");
    return raw ? std::string(source.substr(0, n)) : decode(source, n);
}

vtkSmartPointer<vtkDataCompressor> compressor_of(const std::string& name) {
    if (name == "vtkZLibDataCompressor") return vtkSmartPointer<vtkZLibDataCompressor>::New();
    if (name == "vtkLZ4DataCompressor") return vtkSmartPointer<vtkLZ4DataCompressor>::New();
    if (name == "vtkLZMADataCompressor") return vtkSmartPointer<vtkLZMADataCompressor>::New();
    throw FormatError(fmt::format("its compressor \"{}\" is not known", name.substr(0, 40)));
}

}  // namespace

VtkArrays::VtkArrays(const VtkElement& root, std::string_view appended)
    : compressor_(root.attribute("compressor")), swap_(root.attribute("byte_order") == "BigEndian") {
    if (!compressor_.empty()) compressor_of(compressor_);
    const std::string_view header = root.attribute("header_type"), order = root.attribute("byte_order");
    if (!order.empty() && order != "BigEndian" && order != "LittleEndian")
        throw FormatError(fmt::format("its byte_order \"{}\" is not known", order.substr(0, 40)));
    if (!header.empty() && header != "UInt32" && header != "UInt64")
        throw FormatError(fmt::format("its header_type \"{}\" is not known", header.substr(0, 40)));
    word_ = header == "UInt64" ? 8 : 4;
    if (appended.empty()) return;
    const std::size_t end = appended.find('>');
    const std::size_t underscore =
        end == std::string_view::npos ? end : appended.find_first_not_of(blank, end + 1);
    if (underscore == std::string_view::npos || appended[underscore] != '_')
        throw FormatError("its appended data do not begin with _");
    const VtkElement element = vtk_markup(appended.substr(0, end + 1));
    raw_ = element.attribute("encoding") == "raw";
    appended_ = appended.substr(underscore + 1);
}

std::uint64_t VtkArrays::word(const std::string& bytes, std::size_t index) const {
    std::string copy = bytes.substr(index * word_, word_);
    if (swap_) std::reverse(copy.begin(), copy.end());
    std::uint64_t value = 0;
    std::memcpy(&value, copy.data(), copy.size());
    return value;
}

std::string VtkArrays::uncompressed(std::string_view source, bool raw) const {
    const std::uint64_t n = word(take(source, word_, raw), 0);
    if (n > source.size()) throw FormatError("an array claims more bytes than the file holds");
    return take(source, word_ + n, raw).substr(word_);
}

std::string VtkArrays::decompressed(std::string_view source, bool raw) const {
    const std::uint64_t blocks = word(take(source, word_, raw), 0);
    if (blocks == 0) return {};
    if (blocks > source.size() / word_) throw FormatError("an array claims more blocks than the file holds");
    const std::size_t front = word_ * (3 + blocks);
    const std::string header = take(source, front, raw);
    const std::uint64_t block = word(header, 1), partial = word(header, 2);
    source.remove_prefix(raw ? front : encoded(front));
    std::uint64_t packed = 0;
    for (std::size_t b = 0; b < blocks; ++b) {
        const std::uint64_t size = word(header, 3 + b);
        if (size > source.size() - packed) throw FormatError("a compressed array breaks off");
        packed += size;
    }
    const std::uint64_t most = best_compression * source.size();
    if (block > most || partial > block || (block > 0 && blocks - 1 > most / block))
        throw FormatError("an array claims to unpack to more than its bytes can hold");
    const std::string data = take(source, packed, raw);
    const auto compressor = compressor_of(compressor_);
    std::string out;
    for (std::size_t b = 0, at = 0; b < blocks; ++b) {
        const std::size_t size = word(header, 3 + b);
        const std::size_t n = b + 1 == blocks && partial > 0 ? partial : block;
        const std::size_t begin = out.size();
        out.resize(begin + n);
        if (compressor->Uncompress(reinterpret_cast<const unsigned char*>(data.data() + at), size,
                                   reinterpret_cast<unsigned char*>(out.data() + begin), n) != n)
            throw FormatError("a compressed array does not unpack");
        at += size;
    }
    return out;
}

std::string VtkArrays::bytes(const VtkElement& array) const {
    std::string_view source = array.text;
    const bool appended = array.attributes.contains("offset");
    if (appended) {
        const std::uint64_t offset = array.count("offset");
        if (offset > appended_.size()) refuse(array, "begins behind the end of the file");
        source = appended_.substr(offset);
    } else {
        source.remove_prefix(std::min(source.find_first_not_of(blank), source.size()));
    }
    const bool raw = appended && raw_;
    return compressor_.empty() ? uncompressed(source, raw) : decompressed(source, raw);
}

void VtkArrays::check(const VtkElement& array, std::uint64_t n) const {
    const Type& type = type_of(array);
    if (n == 0 && is_absent(array)) return;
    std::uint64_t values = 0;
    if (type.kind == 's') {  // each ends with a zero
        if (is_text(array)) {
            const auto codes = words(array, type);
            values = static_cast<std::uint64_t>(std::count(codes.begin(), codes.end(), 0));
        } else {
            const std::string codes = bytes(array);
            values = static_cast<std::uint64_t>(std::count(codes.begin(), codes.end(), '\0'));
        }
    } else if (is_text(array)) {
        values = words(array, type).size();
    } else {
        const std::size_t size = bytes(array).size();
        if (size % type.size != 0)
            refuse(array, fmt::format("holds {} bytes for values of {}", size, type.size));
        values = size / type.size;
    }
    if (values != n) refuse_number(array, values, n);
}

std::vector<std::int64_t> VtkArrays::integers(const VtkElement& array, std::uint64_t n) const {
    const Type& type = type_of(array);
    if (type.kind != 'i' && type.kind != 'u')
        refuse(array, fmt::format("is of type {}, not of whole numbers", type.name));
    if (n == 0 && is_absent(array)) return {};
    if (is_text(array)) {
        std::vector<std::int64_t> values = words(array, type);
        if (values.size() != n) refuse_number(array, values.size(), n);
        return values;
    }
    const std::string data = bytes(array);
    if (data.size() % type.size != 0 || data.size() / type.size != n)
        refuse_number(array, data.size() / type.size, n);
    std::vector<std::int64_t> values(n);
    for (std::size_t i = 0; i < n; ++i) {
        std::string value = data.substr(i * type.size, type.size);
        if (swap_) std::reverse(value.begin(), value.end());
        const bool negative = type.kind == 'i' && (static_cast<unsigned char>(value.back()) & 0x80U) != 0;
        values[i] = negative ? -1 : 0;
        std::memcpy(&values[i], value.data(), value.size());
    }
    return values;
}

}  // namespace hemoflux::meshing
