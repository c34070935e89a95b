/// .pvd: the index of a time series of VTK files, which ParaView opens as one.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace hemoflux::output {

/// One file of a series and its time.
struct Frame {
    double time;
    std::string file;  ///< relative to the .pvd
};

/// A .pvd file that is written anew, atomically, with every added frame: after a kill it is valid and names
/// only files that are complete.
class PvdSeries {
  public:
    /// An empty series; the file appears with the first frame.
    explicit PvdSeries(std::filesystem::path path) : path_(std::move(path)) {}

    /// The series of an earlier run without the frames later than last_time; empty when there is no file.
    /// FileError when unreadable, InputError when it is not a .pvd file.
    static PvdSeries resume(std::filesystem::path path, double last_time);

    /// Adds a file that is already written. FileError.
    void add(double time, const std::filesystem::path& file);

    /// All frames so far; their number is the number of the next file.
    [[nodiscard]] const std::vector<Frame>& frames() const noexcept { return frames_; }
    /// Number of the next file.
    [[nodiscard]] int next() const noexcept { return static_cast<int>(frames_.size()); }

  private:
    std::filesystem::path path_;
    std::vector<Frame> frames_;
};

/// The frames named in a .pvd file, in its order. FileError, InputError as PvdSeries::resume().
std::vector<Frame> read_pvd(const std::filesystem::path& path);

}  // namespace hemoflux::output
