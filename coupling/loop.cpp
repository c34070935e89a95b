#include "coupling/loop.hpp"

#include <fmt/format.h>

#include <stdexcept>

#include "coupling/cell_grid.hpp"
#include "coupling/hex_cells.hpp"
#include "coupling/step_control.hpp"
#include "exchange/error.hpp"
#include "exchange/memory.hpp"
#include "fluid/cell_report.hpp"

namespace hemoflux::coupling {

using exchange::Shape;

/// One partner with what joins it to the grid.
struct Loop::Partner {
    Immersed& immersed;
    exchange::FieldView position, force;
    std::unique_ptr<NodeLink> link;
    std::unique_ptr<ForceSpreader> spreader;
    exchange::Buffer<double> v[3];
    std::unique_ptr<VelocityChange> change;  // null unless watched

    /// `first`: the spreader that clears the field, null for the first partner itself.
    Partner(Immersed& what, const exchange::FieldTable& fields, const FluidGrid& grid, Kernel kernel,
            ForceSpreader* first)
        : immersed(what),
          position(fields.read(what.name() + ".position", Shape::vector, "um")),
          force(fields.read(what.name() + ".force", Shape::vector, what.force_unit())),
          link(grid.link(kernel, what.nodes())),
          spreader(link->spreader(first)) {
        for (auto& component : v) component = exchange::Buffer<double>(what.nodes());
    }
    exchange::FieldView velocity() { return {{v[0].data(), v[1].data(), v[2].data()}, v[0].size()}; }
};

Loop::Loop(fluid::Flow& fluid, std::unique_ptr<FluidGrid> grid, Kernel kernel)
    : fluid_(fluid), kernel_(kernel), grid_(std::move(grid)) {
    fluid_.offer(fields_);
    at_cells_.density = fields_.read("fluid.density", Shape::scalar, "rho_0");
    at_cells_.velocity = fields_.read("fluid.velocity", Shape::vector, "c");
    force_density_ = fields_.read("fluid.force_density", Shape::vector, "rho_0 c^2 / um");
}

Loop::Loop(fluid::Solver& fluid, Kernel kernel)
    : Loop(fluid, std::make_unique<CellGrid>(fluid.grid().rectilinear(), fluid.grid().periodic()), kernel) {}

Loop::Loop(fluid::HexSolver& fluid, Kernel kernel)
    : Loop(fluid, std::make_unique<HexCells>(fluid.grid()), kernel) {}

Loop::Loop(fluid::Solver& fluid, membrane::Batch& cells, const LoopOptions& options)
    : Loop(fluid, options.kernel) {
    add_cells(cells, options, fluid.options().nu);
}

Loop::Loop(fluid::HexSolver& fluid, membrane::Batch& cells, const LoopOptions& options)
    : Loop(fluid, options.kernel) {
    add_cells(cells, options, fluid.options().nu);
}

void Loop::add_cells(membrane::Batch& cells, const LoopOptions& o, double nu) {
    exchange::FieldView viscosity;
    if (!o.nu_inside.empty()) viscosity = fields_.read("fluid.viscosity", Shape::scalar, "um c");
    CellOptions of_cells = o;
    of_cells.nu_outside = nu;
    cells_ = std::make_unique<ImmersedCells>(*grid_, cells, of_cells, viscosity);
    add(*cells_);
}

Loop::~Loop() = default;

void Loop::add(Immersed& immersed) {
    fields_.offer(immersed.name(), {"position", Shape::vector, "um"}, immersed.positions());
    fields_.offer(immersed.name(), {"force", Shape::vector, immersed.force_unit()}, immersed.forces());
    partners_.push_back(std::make_unique<Partner>(
        immersed, fields_, *grid_, kernel_, partners_.empty() ? nullptr : partners_[0]->spreader.get()));
}

void Loop::step(double dt) {
    for (const auto& p : partners_) {
        p->immersed.compute_forces(dt);
        p->link->locate(p->position);
        p->spreader->spread(p->force, p->immersed.force_factor(), force_density_);
    }
    fluid_.step(dt);
    for (const auto& p : partners_) p->immersed.correct(dt, *p->link, at_cells_);
    for (const auto& p : partners_) p->link->interpolate(at_cells_.velocity, p->velocity());
    for (const auto& p : partners_) {
        p->immersed.advance(dt, p->velocity());
        if (p->change) p->change->observe(p->velocity());  // as the nodes have moved
    }
}

void Loop::watch_velocities() {
    for (const auto& p : partners_) p->change = std::make_unique<VelocityChange>(p->immersed.nodes());
}

const Loop::Partner* Loop::most_changed_partner() const {
    const Partner* most = nullptr;
    for (const auto& p : partners_)
        if (p->change && p->change->known() && !(most && p->change->largest() <= most->change->largest()))
            most = p.get();
    return most;
}

std::optional<double> Loop::velocity_change() const {
    const Partner* most = most_changed_partner();
    return most ? std::optional(most->change->largest()) : std::nullopt;
}

std::string Loop::most_changed() const {
    const Partner* most = most_changed_partner();
    return most ? most->immersed.describe_node(most->change->where()) : "no node";
}

std::vector<double> Loop::velocities() const {
    std::vector<double> all;
    for (const auto& p : partners_) {
        if (!p->change) continue;
        const std::vector<double> one = p->change->memory();
        all.insert(all.end(), one.begin(), one.end());
    }
    return all;
}

void Loop::restore_velocities(const std::vector<double>& velocities) {
    auto at = velocities.begin();
    for (const auto& p : partners_) {
        const auto n = static_cast<std::ptrdiff_t>(velocities.empty() ? 0 : 3 * p->immersed.nodes());
        if (velocities.end() - at < n) throw std::length_error("Loop::restore_velocities: too few values");
        if (p->change) p->change->restore({at, at + n});
        at += n;
    }
}

void Loop::check() {
    const std::size_t bad = fluid_.first_bad_cell();
    if (bad < fluid_.cells())
        throw NumericalError(
            fluid::describe_cell(fluid_, bad),
            "its density or velocity is no longer a sound number; the step is probably too long",
            "shorten numerics.step_strain, or lower numerics.lattice_viscosity");
    for (const auto& p : partners_) {
        p->link->locate(p->position);
        const std::size_t lost = p->link->first_lost();
        if (lost < p->link->size()) p->immersed.report_lost(lost);
        p->immersed.check();
    }
}

NodalForce Loop::nodal_force() const {
    NodalForce total;
    for (const auto& p : partners_) {
        std::vector<double> f[3];
        for (int q = 0; q < 3; ++q) {
            f[q].resize(p->force.size);
            exchange::copy_to_host(f[q].data(), p->force.component[q], p->force.size * sizeof(double));
        }
        for (std::size_t i = 0; i < p->force.size; ++i) {
            const Vec3d one = p->immersed.force_factor() * Vec3d{f[0][i], f[1][i], f[2][i]};
            total.sum += one;
            total.gross += norm(one);
        }
    }
    return total;
}

void Loop::restore(const CellMemory& memory) {
    if (cells_) cells_->restore(memory);
    for (const auto& p : partners_) p->spreader->forget();
}

}  // namespace hemoflux::coupling
