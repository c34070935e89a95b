#include "apps/python/simulation.hpp"

#include <fmt/format.h>

#include <cmath>

#include "exchange/error.hpp"
#include "fluid/cell_report.hpp"

namespace hemoflux::python {

Simulation::Simulation(const apps::Case& c, const output::Checkpoint* checkpoint) : case_(c) {
    columns_ = {"step", "time_s"};
    switch (case_.kind) {
        case apps::CaseKind::coupled:
            if (case_.time.adaptive)
                throw InputError("time.adaptive",
                                 "a simulation that is advanced step by step has equal steps",
                                 "Leave it out, or use hemoflux.run");
            coupled_.emplace(case_);
            coupled_->add_cells(case_, checkpoint);
            observer_.emplace(*coupled_->cells);
            columns_.push_back("strain");
            for (std::size_t i = 0; i < cells(); ++i)
                for (const std::string& name : apps::cell_columns())
                    columns_.push_back(fmt::format("{}.{}", i, name));
            break;
        case apps::CaseKind::fluid:
            fluid_.emplace(case_);
            columns_.push_back("largest_speed_um_per_s");
            break;
        case apps::CaseKind::membrane:
            throw InputError("a case of kind \"membrane\"", "it has no fluid to advance in time",
                             "Use hemoflux.Membrane, or hemoflux.run");
    }
    columns_.push_back("mean_density");
    if (checkpoint) load(*checkpoint);
}

std::unique_ptr<Simulation> Simulation::from_folder(const std::filesystem::path& folder) {
    const apps::Case c = apps::read_case(folder / "resolved.toml");
    const output::Checkpoint checkpoint = output::latest_checkpoint(folder).checkpoint;
    checkpoint.require_text("version", HEMOFLUX_VERSION, "the version of hemoflux");
    return std::unique_ptr<Simulation>(new Simulation(c, &checkpoint));
}

void Simulation::load(const output::Checkpoint& checkpoint) {
    done_ = static_cast<long long>(checkpoint.number("step"));
    if (coupled_) {
        coupled_->load(checkpoint);
        observer_->load(checkpoint);
        return;
    }
    apps::load_flow(*fluid_->flow, checkpoint);
    if (!fluid_->bodies) return;
    fluid_->bodies->load(checkpoint);
    fluid_->loop->restore({});
}

void Simulation::advance(long long steps) {
    if (case_.steady)
        throw InputError("a case with [steady]", "its iterations are no steps in time", "Use hemoflux.run");
    if (steps < 0)
        throw InputError(fmt::format("{} steps", steps), "time goes forward only", "Give a number from 0 on");
    for (long long i = 0; i < steps; ++i) {
        if (coupled_) {
            coupled_->loop->step(coupled_->numerics.step);
        } else {
            fluid_->flow->set_time(time_s() / scales().time_s());
            fluid_->step(plan().step / scales().time_s());
        }
        ++done_;
    }
    if (coupled_)
        coupled_->loop->check();
    else
        check_fluid();
}

void Simulation::check_fluid() {
    const std::size_t bad = flow().first_bad_cell();
    if (bad == flow().cells()) return;
    throw NumericalError(fluid::describe_cell(flow(), bad),
                         "its density or velocity is no longer a sound number",
                         "Shorten time.step or lower numerics.mach");
}

fluid::Flow& Simulation::flow() const {
    if (coupled_) return *coupled_->fluid;
    return *fluid_->flow;
}

double Simulation::time_s() const { return plan().at(done_) / (coupled_ ? coupled_->clock : 1); }

double Simulation::strain() const {
    return time_s() * (coupled_ ? coupled_->clock : case_.shear_rate.value_or(NAN));
}

std::vector<long long> Simulation::shape() const {
    if (case_.mesh) return {static_cast<long long>(flow().cells())};
    const auto& [x, y, z] = case_.grid.cells;
    return {z, y, x};
}

std::vector<double> Simulation::density() const {
    std::vector<double> values = flow().values(0);
    for (double& v : values) v *= scales().density;
    return values;
}

std::vector<Vec3d> Simulation::velocity() const {
    const auto u = flow().values(1), v = flow().values(2), w = flow().values(3);
    std::vector<Vec3d> velocity(u.size());
    for (std::size_t i = 0; i < u.size(); ++i)
        velocity[i] = scales().velocity_um_per_s * Vec3d{u[i], v[i], w[i]};
    return velocity;
}

std::vector<Vec3d> Simulation::centres() const {
    std::vector<Vec3d> centres(flow().cells());
    for (std::size_t i = 0; i < centres.size(); ++i) centres[i] = flow().centre(i);
    return centres;
}

const membrane::Batch& Simulation::batch(std::size_t cell) const {
    if (cell >= cells())
        throw InputError(fmt::format("cell {}", cell), fmt::format("there are {}, counted from 0", cells()),
                         "Name one of them");
    return *coupled_->cells;
}

std::vector<Vec3d> Simulation::nodes(std::size_t cell) const { return batch(cell).positions(cell); }

std::vector<Vec3d> Simulation::forces(std::size_t cell) {
    static_cast<void>(batch(cell));
    coupled_->cells->compute_forces();
    std::vector<Vec3d> forces = coupled_->cells->forces(cell);
    for (Vec3d& f : forces) f = 1 / membrane::piconewton * f;
    return forces;
}

const std::vector<meshing::Triangle>& Simulation::triangles(std::size_t cell) const {
    return batch(cell).topology().triangles();
}

const std::vector<double>& Simulation::observe() {
    std::vector<double> row{static_cast<double>(done_), time_s()};
    if (coupled_) {
        row.push_back(strain());
        const auto cells = observer_->observe(*coupled_->cells, strain());
        row.insert(row.end(), cells.begin(), cells.end());
    } else {
        row.push_back(flow().largest_speed() * scales().velocity_um_per_s);
    }
    row.push_back(flow().mean_density());
    return rows_.emplace_back(std::move(row));
}

}  // namespace hemoflux::python
