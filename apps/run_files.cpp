#include "apps/run_files.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <sstream>

#include "apps/output/atomic_file.hpp"
#include "apps/output/pictures.hpp"
#include "apps/output/vtk_writer.hpp"
#include "apps/speed.hpp"
#include "exchange/backend.hpp"
#include "exchange/error.hpp"
#include "fluid/vorticity.hpp"

namespace hemoflux::apps {
namespace {

bool same_folder(const RunOptions& options) {
    std::error_code error;
    return !options.restart.empty() && std::filesystem::equivalent(options.restart, options.output, error);
}

std::vector<double> scaled(std::vector<double> values, double factor) {
    for (double& v : values) v *= factor;
    return values;
}

/// Curl of the velocity in every cell, from the solver's own gradients, times `factor`.
output::DataArray vorticity(const fluid::Flow& flow, double factor) {
    output::DataArray curl{"vorticity_1_per_s", 3, {}};
    for (const Vec3d& w : fluid::vorticity(flow.gradients()))
        curl.values.insert(curl.values.end(), {factor * w.x, factor * w.y, factor * w.z});
    return curl;
}

/// The fields the case asks for, in physical units.
std::vector<output::DataArray> fluid_arrays(const Case& c, const Scales& s, const fluid::Flow& flow,
                                            double gamma) {
    // one component of the body force, or the viscosity (3), times a factor; empty where there is none
    const auto coefficient = [&](int k, double factor) {
        if (const auto* hex = dynamic_cast<const fluid::HexSolver*>(&flow))
            return scaled(hex->coefficient(k), factor);
        const fluid::State& state = dynamic_cast<const fluid::Solver&>(flow).state();
        const double* field = k == 3 ? state.view().nu : state.view().force[k];
        return field ? scaled(state.interior(field), factor) : std::vector<double>{};
    };
    std::vector<output::DataArray> arrays;
    for (const std::string& name : c.output.fields) {
        if (name == "velocity") {
            const double f = s.velocity_um_per_s;
            arrays.push_back(output::vector_array("velocity_um_per_s", scaled(flow.values(1), f),
                                                  scaled(flow.values(2), f), scaled(flow.values(3), f)));
        } else if (name == "density") {
            arrays.push_back({"density_kg_per_m3", 1, scaled(flow.values(0), s.density)});
        } else if (name == "pressure") {
            std::vector<double> p = flow.values(0);
            for (double& value : p) value = gamma * (value - 1) / 3 * s.pressure_pa;
            arrays.push_back({"pressure_Pa", 1, std::move(p)});
        } else if (name == "vorticity") {
            arrays.push_back(vorticity(flow, s.velocity_um_per_s));
        } else if (name == "viscosity") {
            std::vector<double> mu = coefficient(3, s.viscosity_pa_s);
            if (!mu.empty()) arrays.push_back({"viscosity_Pa_s", 1, std::move(mu)});
        } else if (name == "force") {
            const double f = s.pressure_pa;
            const std::vector<double> x = coefficient(0, f);
            if (!x.empty())
                arrays.push_back(
                    output::vector_array("force_density_Pa_per_um", x, coefficient(1, f), coefficient(2, f)));
        }
    }
    return arrays;
}

/// Arrays in the order of the grid's cells, put into the order of the mesh.
std::vector<output::DataArray> in_mesh_order(std::vector<output::DataArray> arrays,
                                             const std::vector<std::size_t>& original) {
    for (output::DataArray& a : arrays) {
        const auto n = static_cast<std::size_t>(a.components);
        std::vector<double> sorted(a.values.size());
        for (std::size_t i = 0; i < original.size(); ++i)
            for (std::size_t k = 0; k < n; ++k) sorted[n * original[i] + k] = a.values[n * i + k];
        a.values = std::move(sorted);
    }
    return arrays;
}

/// Lines of a resolved case, each with the table it stands in.
std::vector<std::string> lines_of(const std::string& resolved) {
    std::istringstream text(resolved);
    std::vector<std::string> lines;
    std::string table;
    for (std::string line; std::getline(text, line);) {
        if (line.empty()) continue;
        if (line.front() == '[') table = line + " ";
        lines.push_back(line.front() == '[' ? line : table + line);
    }
    return lines;
}

void require_same_case(const std::string& stored, const std::string& now) {
    const auto before = lines_of(stored), after = lines_of(now);
    const auto line = [](const std::vector<std::string>& lines, std::size_t i) {
        return i < lines.size() ? lines[i] : std::string("nothing more");
    };
    for (std::size_t i = 0; i < std::max(before.size(), after.size()); ++i)
        if (line(before, i) != line(after, i))
            throw InputError(
                "the checkpoint is of another case",
                fmt::format("it was written with {}, and the case now has {}", line(before, i),
                            line(after, i)),
                "Continue with the case unchanged (hemoflux run --restart DIR without a case and "
                "--set), or start anew without --restart");
}

/// Whole periods that bring the middle of a cell back into the box. Nodes are kept unwrapped; a picture shows every cell
/// once and in one piece, which may stick out of the box.
Vec3d into_box(const coupling::NodeBox& box, const std::vector<Vec3d>& nodes) {
    Vec3d sum{0, 0, 0};
    for (const Vec3d& r : nodes) sum += r;
    const Vec3d middle = (1 / static_cast<double>(nodes.size())) * sum;
    const double at[3] = {middle.x, middle.y, middle.z};
    double shift[3] = {0, 0, 0};
    for (std::size_t q = 0; q < 3; ++q)
        if (box.periodic[q]) shift[q] = -box.length[q] * std::floor((at[q] - box.lower[q]) / box.length[q]);
    return {shift[0], shift[1], shift[2]};
}

std::optional<output::LatestCheckpoint> checkpoint_to_continue(const Case& c, const RunOptions& options) {
    if (options.restart.empty()) return {};
    output::LatestCheckpoint latest = output::latest_checkpoint(options.restart);
    latest.checkpoint.require_text("version", HEMOFLUX_VERSION, "the version of hemoflux");
    require_same_case(latest.checkpoint.text("case"), c.resolved);
    if (const double step = latest.checkpoint.number("step"); !(step >= 0 && step < 1e15))
        throw InputError("the checkpoint " + latest.path.string(), fmt::format("its step is {}", step),
                         "Restart from an older checkpoint, or start anew without --restart");
    return latest;
}

/// Writes the case before anything else, so that the folder is known as a run whatever kills it; returns the log's name.
std::filesystem::path begin_folder(const output::OutputFolder& folder, const Case& c) {
    output::write_file(folder.resolved(), c.resolved);
    return folder.log();
}

}  // namespace

RunFiles::RunFiles(const Case& c, const RunOptions& options)
    : case_(c),
      continued_(checkpoint_to_continue(c, options)),
      folder_(options.output, same_folder(options) ? output::Folder::restart : output::Folder::fresh),
      log_(begin_folder(folder_, c), options.quiet, same_folder(options)) {
    if (continued_) {
        if (!continued_->warning.empty()) log_.warn(continued_->warning);
        moved_ = !same_folder(options);
        first_step_ =
            static_cast<long long>(restart()->number("step"));  // as checkpoint_to_continue() found it
        log_.info(fmt::format("continuing from {} (step {})", continued_->path.string(), first_step_));
    }
    note_environment(log_);
}

void RunFiles::start_history(const std::vector<std::string>& columns) {
    history_.emplace(folder_.history(), columns);
    if (!continued_) return;
    const auto& values = restart()->array("history");
    for (std::size_t i = 0; i + columns.size() <= values.size(); i += columns.size())
        add_row({values.begin() + static_cast<std::ptrdiff_t>(i),
                 values.begin() + static_cast<std::ptrdiff_t>(i + columns.size())});
}

void RunFiles::add_row(const std::vector<double>& row) {
    history_->add(row);
    rows_.push_back(row);
}

void RunFiles::start_series(double position) {
    if (continued_) {
        fluid_series_ = output::PvdSeries::resume(folder_.fluid_series(), position + 1e-9);
        cell_series_ = output::PvdSeries::resume(folder_.cell_series(), position + 1e-9);
    } else {
        fluid_series_.emplace(folder_.fluid_series());
        cell_series_.emplace(folder_.cell_series());
    }
}

void RunFiles::write_flow(const Case& c, const Scales& scales, const fluid::HexSolver& flow,
                          const meshing::HexMesh& mesh, const membrane::Batch* cells,
                          const RigidBodies* bodies, const coupling::Loop* loop, double position) {
    auto file = folder_.fluid_file(fluid_series_->next());
    file.replace_extension(".vtu");
    output::write_fluid(
        file, mesh, in_mesh_order(fluid_arrays(c, scales, flow, flow.options().gamma), flow.grid().original),
        position, c.output.compression);
    fluid_series_->add(position, file);
    if (cells || bodies)
        write_surfaces(cells, bodies, cells ? loop->grid().box() : coupling::NodeBox{}, position);
}

void RunFiles::write_frame(const Case& c, const Scales& scales, const fluid::Solver& fluid,
                           const membrane::Batch* cells, const RigidBodies* bodies, double position) {
    const auto fluid_file = folder_.fluid_file(fluid_series_->next());
    output::write_fluid(fluid_file, fluid.grid().rectilinear().axes,
                        fluid_arrays(c, scales, fluid, fluid.options().gamma), position,
                        c.output.compression);
    fluid_series_->add(position, fluid_file);
    if (!cells && !bodies) return;
    const meshing::RectilinearGrid& grid = fluid.grid().rectilinear();
    coupling::NodeBox box;
    for (std::size_t q = 0; q < 3; ++q) {
        box.lower[q] = grid.axes[q].lower();
        box.length[q] = grid.axes[q].length();
        box.periodic[q] = c.periodic(q);
    }
    write_surfaces(cells, bodies, box, position);
}

void RunFiles::write_surfaces(const membrane::Batch* cells, const RigidBodies* bodies,
                              const coupling::NodeBox& box, double position) {
    std::vector<meshing::SurfaceMesh> meshes;
    std::vector<double> fx, fy, fz;
    for (std::size_t i = 0; cells && i < cells->cells(); ++i) {
        meshes.push_back({cells->positions(i), cells->topology().triangles()});
        meshing::translate(meshes.back(), into_box(box, meshes.back().vertices));
        constexpr double piconewton_per_unit = 1 / membrane::piconewton;
        for (const Vec3d& f : cells->forces(i)) {
            fx.push_back(f.x * piconewton_per_unit);
            fy.push_back(f.y * piconewton_per_unit);
            fz.push_back(f.z * piconewton_per_unit);
        }
    }
    if (bodies) {
        const RigidBodies::Frame rigid = bodies->frame();
        meshes.insert(meshes.end(), rigid.meshes.begin(), rigid.meshes.end());
        for (const Vec3d& f : rigid.forces_pn) {
            fx.push_back(f.x);
            fy.push_back(f.y);
            fz.push_back(f.z);
        }
    }
    const auto cell_file = folder_.cell_file(cell_series_->next());
    output::write_cells(cell_file, meshes, {output::vector_array("force_pN", fx, fy, fz)}, position, {}, {},
                        case_.output.compression);
    cell_series_->add(position, cell_file);
}

void RunFiles::write_checkpoint(output::Checkpoint checkpoint, long long step) {
    checkpoint.put_text("version", HEMOFLUX_VERSION);
    checkpoint.put_text("case", case_.resolved);
    checkpoint.put_number("step", static_cast<double>(step));
    std::vector<double> history;
    for (const auto& row : rows_)
        if (row.front() <= static_cast<double>(step)) history.insert(history.end(), row.begin(), row.end());
    checkpoint.put("history", std::move(history));
    output::write_rotating(folder_.path(), step, checkpoint);
}

output::Summary start_summary(const Case& c) {
    output::Summary summary;
    summary.case_name = c.title;
    summary.version = HEMOFLUX_VERSION;
    summary.backend = exchange::backend_name();
    summary.threads = exchange::threads();
    for (const ReferenceInput& r : c.references)
        if (!of_sweep(r)) summary.references[r.observable] = {r.value, r.low, r.high, r.source};
    return summary;
}

void note_environment(const output::Log& log) {
    const Machine m = this_machine();
    log.detail(fmt::format("{}   version {}; backend {}; threads {}; cores {}; processor {}",
                           environment_word, HEMOFLUX_VERSION, m.backend, m.threads, m.cores, m.processor));
}

std::string closing_line(const std::filesystem::path& folder) {
    return fmt::format("results are in {0}; hemoflux report {0} makes a page of them", folder.string());
}

void draw_pictures(const Case& c, const RunFiles& files, const std::string& time_label) {
    if (!c.output.pictures) return;
    const output::Pictures pictures =
        output::make_pictures(files.folder().path(), {.time_label = time_label});
    if (!pictures.message.empty()) files.log().warn(pictures.message);
}

}  // namespace hemoflux::apps
