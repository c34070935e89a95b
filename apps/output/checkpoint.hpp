/// Checkpoint files: named arrays, numbers and texts from which a run continues bit for bit.
///
/// File layout, little-endian: "HEMOFLUX", u32 format, u64 size of the whole file, u64 number of entries; per
/// entry u8 kind, u32 length of the name, the name, u64 count, then count doubles (arrays), one double
/// (numbers) or count bytes (texts); at the end u64 CRC-64 (ECMA-182, reflected) of everything before it.
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace hemoflux::output {

/// The state of a run under names such as "fluid.density"; kept and written in the order of the names.
class Checkpoint {
  public:
    /// Stores an array; a later one of the same name replaces it.
    void put(const std::string& name, std::vector<double> values) { arrays_[name] = std::move(values); }
    /// Stores a number; integers are exact up to 2^53.
    void put_number(const std::string& name, double value) { numbers_[name] = value; }
    /// Stores a text, e.g. the version or the hash of the case.
    void put_text(const std::string& name, std::string value) { texts_[name] = std::move(value); }

    /// The array of that name. InputError when it is missing or, with a size given, when it has another.
    [[nodiscard]] const std::vector<double>& array(const std::string& name,
                                                   std::optional<std::size_t> size = {}) const;
    /// The number of that name; InputError when missing.
    [[nodiscard]] double number(const std::string& name) const;
    /// The text of that name; InputError when missing.
    [[nodiscard]] const std::string& text(const std::string& name) const;
    /// Whether an array, number or text of that name is stored.
    [[nodiscard]] bool contains(const std::string& name) const;

    /// InputError naming both texts unless the stored text is the expected one; meaning says in words what
    /// the text is ("the case", "the version of hemoflux").
    void require_text(const std::string& name, const std::string& expected, const std::string& meaning) const;

    /// All that is stored, by name.
    [[nodiscard]] const std::map<std::string, std::vector<double>>& arrays() const noexcept {
        return arrays_;
    }
    [[nodiscard]] const std::map<std::string, double>& numbers() const noexcept { return numbers_; }
    [[nodiscard]] const std::map<std::string, std::string>& texts() const noexcept { return texts_; }

  private:
    std::map<std::string, std::vector<double>> arrays_;
    std::map<std::string, double> numbers_;
    std::map<std::string, std::string> texts_;
};

/// Writes a checkpoint atomically. FileError.
void write_checkpoint(const std::filesystem::path& path, const Checkpoint& checkpoint);

/// Reads a checkpoint. FileError when it cannot be read or is damaged (not a checkpoint, shortened,
/// checksum), InputError when it is of another format version.
Checkpoint read_checkpoint(const std::filesystem::path& path);

/// Name of the checkpoint of one step in a folder, checkpoint_0000001200.bin.
std::filesystem::path checkpoint_file(const std::filesystem::path& folder, long long step);

/// Writes checkpoint_file(folder, step) and removes all others of the folder but the one before it.
/// FileError.
void write_rotating(const std::filesystem::path& folder, long long step, const Checkpoint& checkpoint);

/// A checkpoint together with its file.
struct LatestCheckpoint {
    std::filesystem::path path;
    Checkpoint checkpoint;
    std::string warning;  ///< why a newer file was passed over; empty when none was
};

/// The newest undamaged checkpoint of a folder. FileError when there is none.
LatestCheckpoint latest_checkpoint(const std::filesystem::path& folder);

}  // namespace hemoflux::output
