/// What a flow run keeps open while it goes on: folder, log, history and the series for ParaView.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "apps/case.hpp"
#include "apps/flow_setup.hpp"
#include "apps/output/checkpoint.hpp"
#include "apps/output/folder.hpp"
#include "apps/output/history.hpp"
#include "apps/output/log.hpp"
#include "apps/output/pvd_series.hpp"
#include "apps/output/summary.hpp"
#include "apps/rigid_bodies.hpp"
#include "apps/run.hpp"
#include "coupling/loop.hpp"
#include "exchange/error.hpp"
#include "fluid/hex_solver.hpp"
#include "fluid/solver.hpp"
#include "membrane/batch.hpp"

namespace hemoflux::apps {

/// Files of one run. Rows of the history are kept in memory too, so that a checkpoint holds them.
class RunFiles {
  public:
    /// Makes or continues the output folder and reads the checkpoint to restart from. FileError, InputError
    /// (the checkpoint is of another version or another case).
    RunFiles(const Case& c, const RunOptions& options);

    /// The checkpoint this run continues from; null for a run from the start.
    [[nodiscard]] const output::Checkpoint* restart() const {
        return continued_ ? &continued_->checkpoint : nullptr;
    }
    /// Whether it continues a run of another folder, of which this one holds nothing yet.
    [[nodiscard]] bool moved() const { return moved_; }
    /// Steps already done.
    [[nodiscard]] long long first_step() const { return first_step_; }

    /// Starts history.csv with these columns ("step" first); after a restart with the rows of the checkpoint.
    void start_history(const std::vector<std::string>& columns);
    /// Adds a row to history.csv; one value for each column.
    void add_row(const std::vector<double>& row);

    /// Opens the series, without the frames later than `position`.
    void start_series(double position);
    /// Writes the fluid and the cells and bodies (if any) as the next frame.
    void write_frame(const Case& c, const Scales& scales, const fluid::Solver& fluid,
                     const membrane::Batch* cells, const RigidBodies* bodies, double position);
    /// The same for a flow on a mesh; loop: of the cells and bodies, if any.
    void write_flow(const Case& c, const Scales& scales, const fluid::HexSolver& flow,
                    const meshing::HexMesh& mesh, const membrane::Batch* cells, const RigidBodies* bodies,
                    const coupling::Loop* loop, double position);

    /// Writes a checkpoint with version, case, step and the history up to this step added.
    void write_checkpoint(output::Checkpoint checkpoint, long long step);

    /// Where the run writes.
    [[nodiscard]] const output::OutputFolder& folder() const { return folder_; }
    /// What goes to the terminal and to log.txt.
    [[nodiscard]] const output::Log& log() const { return log_; }
    /// Rows of history.csv.
    [[nodiscard]] const std::vector<std::vector<double>>& rows() const { return rows_; }

  private:
    /// The surfaces of a frame, cells moved back into a box that repeats.
    void write_surfaces(const membrane::Batch* cells, const RigidBodies* bodies, const coupling::NodeBox& box,
                        double position);

    const Case& case_;
    std::optional<output::LatestCheckpoint> continued_;  // before the folder: a refused one changes nothing
    output::OutputFolder folder_;
    output::Log log_;
    bool moved_ = false;
    long long first_step_ = 0;
    std::optional<output::History> history_;
    std::vector<std::vector<double>> rows_;
    std::optional<output::PvdSeries> fluid_series_, cell_series_;
};

/// Calls `march` and notes in the log file the error that ends it; main() prints it.
template <class March>
int watched(const output::Log& log, const March& march) {
    try {
        return march();
    } catch (const Error& error) {
        log.detail(error.what());
        throw;
    }
}

/// A summary with case, version, backend, threads and references filled in.
output::Summary start_summary(const Case& c);

/// With this word the line of the log begins that names version, backend, threads, cores and processor, parted by
/// semicolons: "environment   version 0.1.0; backend OMP; ...".
constexpr std::string_view environment_word = "environment";

/// Notes in the log file, and only there, what computes.
void note_environment(const output::Log& log);

/// The last line of a run: where its results are and how a page comes of them.
std::string closing_line(const std::filesystem::path& folder);

/// Pictures of the frames, whose times are labelled time_label, and the log line if there are none; never fails.
void draw_pictures(const Case& c, const RunFiles& files, const std::string& time_label);

}  // namespace hemoflux::apps
