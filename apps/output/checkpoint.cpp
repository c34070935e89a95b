#include "apps/output/checkpoint.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <boost/crc.hpp>
#include <charconv>
#include <cstdint>
#include <cstring>

#include "apps/output/atomic_file.hpp"
#include "exchange/error.hpp"

namespace hemoflux::output {
namespace fs = std::filesystem;
namespace {

static_assert(std::endian::native == std::endian::little, "checkpoints are written little-endian");

constexpr std::string_view magic = "HEMOFLUX";
constexpr std::uint32_t format_version = 1;
constexpr std::size_t header_size = magic.size() + sizeof(std::uint32_t) + 2 * sizeof(std::uint64_t);
enum class Kind : std::uint8_t { array, number, text };

std::uint64_t checksum(std::string_view bytes) {
    boost::crc_optimal<64, 0x42F0E1EBA9EA3693, ~0ULL, ~0ULL, true, true> crc;
    crc.process_bytes(bytes.data(), bytes.size());
    return crc.checksum();
}

template <class T>
void append(std::string& out, const T& value) {
    out.append(reinterpret_cast<const char*>(&value), sizeof value);
}

void append_entry(std::string& out, Kind kind, const std::string& name, std::size_t count, const void* data,
                  std::size_t bytes) {
    append(out, kind);
    append(out, static_cast<std::uint32_t>(name.size()));
    out += name;
    append(out, static_cast<std::uint64_t>(count));
    out.append(static_cast<const char*>(data), bytes);
}

FileError damaged(const fs::path& path, const std::string& why) {
    return {"damaged checkpoint " + path.string(), why, "Restart from an older checkpoint"};
}

/// Takes values off the front of the file's content.
class Reader {
  public:
    Reader(std::string_view bytes, const fs::path& path) : bytes_(bytes), path_(path) {}

    std::string_view take(std::uint64_t count) {
        if (count > bytes_.size()) throw damaged(path_, "an entry runs over the end of the file");
        const std::string_view taken = bytes_.substr(0, count);
        bytes_.remove_prefix(count);
        return taken;
    }
    template <class T>
    T take() {
        T value;
        std::memcpy(&value, take(sizeof(T)).data(), sizeof(T));
        return value;
    }
    [[nodiscard]] bool empty() const { return bytes_.empty(); }

  private:
    std::string_view bytes_;
    const fs::path& path_;
};

void read_entry(Reader& reader, Checkpoint& checkpoint, const fs::path& path) {
    const auto kind = reader.take<Kind>();
    const std::string name(reader.take(reader.take<std::uint32_t>()));
    const auto count = reader.take<std::uint64_t>();
    switch (kind) {
        case Kind::array: {
            if (count > UINT64_MAX / sizeof(double)) throw damaged(path, "array " + name + " has no size");
            const std::string_view bytes = reader.take(count * sizeof(double));
            std::vector<double> values(count);
            if (count > 0) std::memcpy(values.data(), bytes.data(), bytes.size());
            checkpoint.put(name, std::move(values));
            return;
        }
        case Kind::number:
            checkpoint.put_number(name, reader.take<double>());
            return;
        case Kind::text:
            checkpoint.put_text(name, std::string(reader.take(count)));
            return;
    }
    throw damaged(path, fmt::format("entry {} is of an unknown kind", name));
}

InputError missing(const std::string& name) {
    return {"the checkpoint does not fit this case", "it holds no " + name,
            "Restart with the case and the version of hemoflux that wrote it"};
}

template <class Map>
const auto& get(const Map& map, const std::string& name) {
    const auto it = map.find(name);
    if (it == map.end()) throw missing(name);
    return it->second;
}

/// The step in the name of a checkpoint file; nothing for another name.
std::optional<long long> step_of(const std::string& name) {
    constexpr std::string_view begin = "checkpoint_", end = ".bin";
    if (name.size() <= begin.size() + end.size() || !name.starts_with(begin) || !name.ends_with(end))
        return {};
    long long step = 0;
    const char* last = name.data() + name.size() - end.size();
    const auto [stop, error] = std::from_chars(name.data() + begin.size(), last, step);
    return error == std::errc() && stop == last ? std::optional(step) : std::nullopt;
}

/// Checkpoints of a folder, newest first; the step is padded, but compared as a number all the same.
std::vector<fs::path> list(const fs::path& folder) {
    std::vector<std::pair<long long, fs::path>> found;
    std::error_code error;
    for (const auto& entry : fs::directory_iterator(folder, error))
        if (const auto step = step_of(entry.path().filename().string()))
            found.emplace_back(*step, entry.path());
    std::sort(found.rbegin(), found.rend());
    std::vector<fs::path> paths;
    for (auto& [step, path] : found) paths.push_back(std::move(path));
    return paths;
}

}  // namespace

const std::vector<double>& Checkpoint::array(const std::string& name, std::optional<std::size_t> size) const {
    const auto& values = get(arrays_, name);
    if (size && values.size() != *size)
        throw InputError("the checkpoint does not fit this case",
                         fmt::format("{} has {} values where the case has {}", name, values.size(), *size),
                         "Restart with the case that wrote it");
    return values;
}

double Checkpoint::number(const std::string& name) const { return get(numbers_, name); }
const std::string& Checkpoint::text(const std::string& name) const { return get(texts_, name); }

bool Checkpoint::contains(const std::string& name) const {
    return arrays_.contains(name) || numbers_.contains(name) || texts_.contains(name);
}

void Checkpoint::require_text(const std::string& name, const std::string& expected,
                              const std::string& meaning) const {
    if (const std::string& stored = text(name); stored != expected)
        throw InputError(
            "the checkpoint does not fit this run",
            fmt::format("{} was {} when it was written and is {} now", meaning, stored, expected),
            "Restart with what wrote it, or start anew without --restart");
}

void write_checkpoint(const fs::path& path, const Checkpoint& checkpoint) {
    std::string out(magic);
    append(out, format_version);
    append(out, std::uint64_t{0});  // the size, known at the end
    append(out, static_cast<std::uint64_t>(checkpoint.arrays().size() + checkpoint.numbers().size() +
                                           checkpoint.texts().size()));
    for (const auto& [name, v] : checkpoint.arrays())
        append_entry(out, Kind::array, name, v.size(), v.data(), v.size() * sizeof(double));
    for (const auto& [name, v] : checkpoint.numbers()) append_entry(out, Kind::number, name, 1, &v, sizeof v);
    for (const auto& [name, v] : checkpoint.texts())
        append_entry(out, Kind::text, name, v.size(), v.data(), v.size());
    const std::uint64_t size = out.size() + sizeof(std::uint64_t);
    std::memcpy(out.data() + magic.size() + sizeof format_version, &size, sizeof size);
    append(out, checksum(out));
    write_file(path, out);
}

Checkpoint read_checkpoint(const fs::path& path) {
    const std::string content = read_file(path);
    if (!std::string_view(content).starts_with(magic))
        throw damaged(path, "it is not a checkpoint of hemoflux");
    if (content.size() < header_size + sizeof(std::uint64_t))
        throw damaged(path, "it is shorter than its header");
    Reader header(std::string_view(content).substr(magic.size()), path);
    if (const auto version = header.take<std::uint32_t>(); version != format_version)
        throw InputError(
            "cannot read checkpoint " + path.string(),
            fmt::format("it is of format {}, this program reads format {}", version, format_version),
            "Restart with the version of hemoflux that wrote it");
    if (const auto size = header.take<std::uint64_t>(); size != content.size())
        throw damaged(path, fmt::format("it has {} bytes, {} were written", content.size(), size));
    const std::string_view body = std::string_view(content).substr(0, content.size() - sizeof(std::uint64_t));
    std::uint64_t stored;
    std::memcpy(&stored, body.data() + body.size(), sizeof stored);
    if (checksum(body) != stored) throw damaged(path, "its checksum does not match its content");

    const auto entries = header.take<std::uint64_t>();
    Reader reader(body.substr(header_size), path);
    Checkpoint checkpoint;
    for (std::uint64_t i = 0; i < entries; ++i) read_entry(reader, checkpoint, path);
    if (!reader.empty()) throw damaged(path, "it goes on after its last entry");
    return checkpoint;
}

fs::path checkpoint_file(const fs::path& folder, long long step) {
    return folder / fmt::format("checkpoint_{:010}.bin", step);
}

void write_rotating(const fs::path& folder, long long step, const Checkpoint& checkpoint) {
    const fs::path written = checkpoint_file(folder, step);
    write_checkpoint(written, checkpoint);
    const auto files = list(folder);
    const auto current = std::find(files.begin(), files.end(), written);
    std::error_code ignored;
    // kept: this one and the one before it; newer ones were left by a run that this one has restarted past
    for (auto it = files.begin(); it != files.end(); ++it)
        if (it < current || it > current + 1) fs::remove(*it, ignored);
}

LatestCheckpoint latest_checkpoint(const fs::path& folder) {
    std::string warning;
    for (const fs::path& path : list(folder)) {
        try {
            return {path, read_checkpoint(path), warning};
        } catch (const FileError& error) {
            warning += (warning.empty() ? "" : " ") + std::string(error.what());
        }
    }
    throw FileError("no checkpoint to restart from in " + folder.string(),
                    warning.empty() ? "there is no checkpoint file" : warning, "Start the run anew");
}

}  // namespace hemoflux::output
