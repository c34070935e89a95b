#include "coupling/loop.hpp"

#include <fmt/format.h>

#include "exchange/error.hpp"
#include "membrane/diagnostics.hpp"

namespace hemoflux::coupling {
namespace {

/// Volume centroid of all cells together, um.
Vec3d common_centroid(const membrane::Batch& cells) {
    double volume = 0;
    Vec3d first{0, 0, 0};
    for (std::size_t c = 0; c < cells.cells(); ++c) {
        const auto m = membrane::shape_moments(cells.topology().triangles(), cells.positions(c));
        volume += m.volume;
        first += m.volume * m.centroid;
    }
    return (1 / volume) * first;
}

/// Gives the padding nodes behind each cell's last vertex the position of its first, so that they are never
/// lost.
void place_padding(membrane::Batch& cells) {
    for (auto* coordinate : {&cells.x(), &cells.y(), &cells.z()}) {
        std::vector<double> host = coordinate->to_host();
        for (std::size_t c = 0; c < cells.cells(); ++c)
            for (std::size_t v = cells.vertices(); v < cells.stride(); ++v)
                host[c * cells.stride() + v] = host[c * cells.stride()];
        coordinate->assign(host);
    }
}

}  // namespace

Loop::Loop(fluid::Solver& fluid, membrane::Batch& cells, const LoopOptions& options)
    : fluid_(fluid),
      cells_(cells),
      options_(options),
      grid_(fluid.grid().rectilinear(), fluid.grid().periodic()),
      nodes_(cells.cells() * cells.stride()),
      stencils_(grid_, options.kernel, nodes_),
      spreader_(stencils_),
      vx_(nodes_),
      vy_(nodes_),
      vz_(nodes_) {
    using exchange::Shape;
    fluid_.offer(fields_);
    fields_.offer("membrane", {"position", Shape::vector, "um"},
                  {{cells_.x().data(), cells_.y().data(), cells_.z().data()}, nodes_});
    // Forces are written by the membrane alone; the view is shared, so it carries no const.
    fields_.offer("membrane", {"force", Shape::vector, "1e-11 N"},
                  {{const_cast<double*>(cells_.fx().data()), const_cast<double*>(cells_.fy().data()),
                    const_cast<double*>(cells_.fz().data())},
                   nodes_});
    velocity_ = fields_.read("fluid.velocity", Shape::vector, "c");
    force_density_ = fields_.read("fluid.force_density", Shape::vector, "rho_0 c^2 / um");
    nodal_force_ = fields_.read("membrane.force", Shape::vector, "1e-11 N");
    position_ = fields_.read("membrane.position", Shape::vector, "um");

    place_padding(cells_);
    if (!options_.nu_inside.empty()) {
        nu_ = fields_.read("fluid.viscosity", Shape::scalar, "um c").component[0];
        viscosity_ =
            std::make_unique<InteriorViscosity>(grid_, cells_.topology().triangles(), cells_.stride(),
                                                options_.nu_inside, fluid_.options().nu, options_.smoothing);
    }
    const Vec3d centroid = common_centroid(cells_);
    target_ = {centroid.x, centroid.y, centroid.z};
    if (options_.recentre)
        recentring_ = std::make_unique<Recentring>(cells_.topology().triangles(), cells_.stride(),
                                                   cells_.cells(), centroid);
}

Loop::~Loop() = default;

void Loop::step(double dt) {
    double *x = position_.component[0], *y = position_.component[1], *z = position_.component[2];
    cells_.compute_forces();
    stencils_.update(x, y, z);
    spreader_.spread(nodal_force_.component[0], nodal_force_.component[1], nodal_force_.component[2],
                     options_.force_factor, force_density_);
    if (viscosity_) viscosity_->update(x, y, z, nu_);
    fluid_.step(dt);
    interpolate(stencils_, velocity_, vx_.data(), vy_.data(), vz_.data());
    move(nodes_, dt, vx_.data(), vy_.data(), vz_.data(), x, y, z);
    if (recentring_) shift_ += recentring_->apply(x, y, z);
}

void Loop::check() {
    const std::size_t bad = fluid_.first_bad_cell();
    if (bad < fluid_.grid().view().layout.cells()) {
        const Vec3d at = fluid_.centre(bad);
        throw NumericalError(
            fmt::format("fluid cell {} at ({:.3f}, {:.3f}, {:.3f}) um", bad, at.x, at.y, at.z),
            "its density or velocity is no longer a sound number; the step is probably too long",
            "shorten numerics.step_strain, or lower numerics.lattice_viscosity");
    }
    stencils_.update(position_.component[0], position_.component[1], position_.component[2]);
    const std::size_t lost = stencils_.first_lost();
    if (lost < nodes_)
        throw NumericalError(
            fmt::format("membrane node {} of cell {}", lost % cells_.stride(), lost / cells_.stride()),
            "it has left the box or its position is no longer a number",
            "enlarge the box, set coupling.recentre, or shorten numerics.step_strain");
}

LoopMemory Loop::memory() const {
    return {viscosity_ ? viscosity_->positions() : std::array<std::vector<double>, 3>{},
            target_,
            {shift_.x, shift_.y, shift_.z}};
}

void Loop::restore(const LoopMemory& memory) {
    target_ = memory.target;
    shift_ = {memory.shift[0], memory.shift[1], memory.shift[2]};
    if (options_.recentre)
        recentring_ = std::make_unique<Recentring>(cells_.topology().triangles(), cells_.stride(),
                                                   cells_.cells(), Vec3d{target_[0], target_[1], target_[2]});
    if (viscosity_ && !memory.viscosity_nodes[0].empty()) {
        const exchange::Buffer<double> x(memory.viscosity_nodes[0]), y(memory.viscosity_nodes[1]),
            z(memory.viscosity_nodes[2]);
        viscosity_->recompute(x.data(), y.data(), z.data(), nu_);
    }
    spreader_.forget();
    place_padding(cells_);
}

}  // namespace hemoflux::coupling
