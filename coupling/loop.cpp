#include "coupling/loop.hpp"

#include <fmt/format.h>

#include "coupling/interpolate.hpp"
#include "exchange/error.hpp"
#include "exchange/memory.hpp"
#include "fluid/cell_report.hpp"

namespace hemoflux::coupling {

using exchange::Shape;

/// One partner with what joins it to the grid.
struct Loop::Partner {
    Immersed& immersed;
    exchange::FieldView position, force;
    StencilSet stencils;
    Spreader spreader;
    exchange::Buffer<double> v[3];

    /// `first`: the spreader that clears the field, null for the first partner itself.
    Partner(Immersed& what, const exchange::FieldTable& fields, const CellGrid& grid, Kernel kernel,
            Spreader* first)
        : immersed(what),
          position(fields.read(what.name() + ".position", Shape::vector, "um")),
          force(fields.read(what.name() + ".force", Shape::vector, what.force_unit())),
          stencils(grid, kernel, what.nodes()),
          spreader(stencils, first) {
        for (auto& component : v) component = exchange::Buffer<double>(what.nodes());
    }
    void locate() { stencils.update(position.component[0], position.component[1], position.component[2]); }
};

Loop::Loop(fluid::Solver& fluid, Kernel kernel)
    : fluid_(fluid), kernel_(kernel), grid_(fluid.grid().rectilinear(), fluid.grid().periodic()) {
    fluid_.offer(fields_);
    velocity_ = fields_.read("fluid.velocity", Shape::vector, "c");
    force_density_ = fields_.read("fluid.force_density", Shape::vector, "rho_0 c^2 / um");
}

Loop::Loop(fluid::Solver& fluid, membrane::Batch& cells, const LoopOptions& o) : Loop(fluid, o.kernel) {
    double* nu =
        o.nu_inside.empty() ? nullptr : fields_.read("fluid.viscosity", Shape::scalar, "um c").component[0];
    cells_ = std::make_unique<ImmersedCells>(
        grid_, cells,
        CellOptions{o.force_factor, o.nu_inside, fluid_.options().nu, o.smoothing, o.recentre, o.contact,
                    o.pull, o.surface_nu, o.membrane_time, o.maxwell_stiffness},
        nu);
    add(*cells_);
}

Loop::~Loop() = default;

void Loop::add(Immersed& immersed) {
    fields_.offer(immersed.name(), {"position", Shape::vector, "um"}, immersed.positions());
    fields_.offer(immersed.name(), {"force", Shape::vector, immersed.force_unit()}, immersed.forces());
    partners_.push_back(std::make_unique<Partner>(immersed, fields_, grid_, kernel_,
                                                  partners_.empty() ? nullptr : &partners_[0]->spreader));
}

void Loop::step(double dt) {
    for (const auto& p : partners_) {
        p->immersed.compute_forces(dt);
        p->locate();
        p->spreader.spread(p->force.component[0], p->force.component[1], p->force.component[2],
                           p->immersed.force_factor(), force_density_);
    }
    fluid_.step(dt);
    for (const auto& p : partners_) p->immersed.correct(dt, p->stencils, fluid_.state().view());
    for (const auto& p : partners_)
        interpolate(p->stencils, velocity_, p->v[0].data(), p->v[1].data(), p->v[2].data());
    for (const auto& p : partners_)
        p->immersed.advance(dt, {{p->v[0].data(), p->v[1].data(), p->v[2].data()}, p->immersed.nodes()});
}

void Loop::check() {
    const std::size_t bad = fluid_.first_bad_cell();
    if (bad < fluid_.grid().view().layout.cells()) {
        throw NumericalError(
            fluid::describe_cell(fluid_, bad),
            "its density or velocity is no longer a sound number; the step is probably too long",
            "shorten numerics.step_strain, or lower numerics.lattice_viscosity");
    }
    for (const auto& p : partners_) {
        p->locate();
        const std::size_t lost = p->stencils.first_lost();
        if (lost < p->stencils.size()) p->immersed.report_lost(lost);
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
    for (const auto& p : partners_) p->spreader.forget();
}

}  // namespace hemoflux::coupling
