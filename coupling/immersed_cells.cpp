#include "coupling/immersed_cells.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>

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

/// How far the check for overlap looks, over the longest edge at rest: a node on a triangle lies within 0.6 edges of a
/// corner, and edges grow. At rest, so that a restarted run looks as far.
constexpr double overlap_reach = 1.2;

double longest_edge(const membrane::Batch& cells) {
    const auto& lengths = cells.reference().edge_lengths;
    return *std::max_element(lengths.begin(), lengths.end());
}

}  // namespace

ImmersedCells::ImmersedCells(const FluidGrid& grid, membrane::Batch& cells, const CellOptions& options,
                             const exchange::FieldView& nu)
    : cells_(cells), options_(options), nodes_(cells.cells() * cells.stride()), nu_(nu), pull_(options.pull) {
    if (!options_.pull.empty() && options_.pull.size() != nodes_)
        throw InputError(fmt::format("{} pulling forces", options_.pull.size()),
                         fmt::format("the cells have {} nodes with their padding", nodes_),
                         "Give one for each of them");
    place_padding(cells_);
    if (!options_.nu_inside.empty())
        viscosity_ = std::make_unique<InteriorViscosity>(
            grid, cells_.topology().triangles(), cells_.stride(), options_.nu_inside, options_.nu_outside,
            options_.smoothing, MotionLimits{}, options_.surface_nu);
    if (options_.membrane_time > 0)
        elements_ = std::make_unique<membrane::MembraneViscosity>(cells_, options_.maxwell_stiffness);
    const auto& triangles = cells_.topology().triangles();
    const NodeBox box = grid.box();
    if (options_.contact)
        contact_ = std::make_unique<Contact>(
            box, *options_.contact,
            node_areas(triangles, cells_.reference().triangle_areas, cells_.vertices()), cells_.cells(),
            cells_.stride());
    if (options_.contact || cells_.cells() > 1)
        overlap_ = std::make_unique<OverlapCheck>(box, overlap_reach * longest_edge(cells_), triangles,
                                                  cells_.cells(), cells_.vertices(), cells_.stride());
    if (options_.constraint_damping > 0)
        damping_ = std::make_unique<ConstraintDamping>(triangles, cells_.stride(), cells_.cells(),
                                                       options_.constraint_damping);
    const Vec3d centroid = common_centroid(cells_);
    target_ = {centroid.x, centroid.y, centroid.z};
    if (options_.recentre)
        recentring_ = std::make_unique<Recentring>(cells_.topology().triangles(), cells_.stride(),
                                                   cells_.cells(), centroid);
}

ImmersedCells::~ImmersedCells() = default;

exchange::FieldView ImmersedCells::positions() {
    return {{cells_.x().data(), cells_.y().data(), cells_.z().data()}, nodes_};
}

exchange::FieldView ImmersedCells::forces() {
    // Forces are written by the membrane alone; the view is shared, so it carries no const.
    return {{const_cast<double*>(cells_.fx().data()), const_cast<double*>(cells_.fy().data()),
             const_cast<double*>(cells_.fz().data())},
            nodes_};
}

void ImmersedCells::compute_forces(double /*dt*/) {
    cells_.compute_forces();
    const exchange::FieldView f = forces();
    if (contact_)
        contact_->add_forces(cells_.x().data(), cells_.y().data(), cells_.z().data(), f.component[0],
                             f.component[1], f.component[2]);
    if (!options_.pull.empty()) add(nodes_, pull_.data(), f.component[0]);
    if (elements_) elements_->add_forces(cells_);
    if (viscosity_)
        viscosity_->update(cells_.x().data(), cells_.y().data(), cells_.z().data(), nu_.component[0],
                           nu_.stride);
}

double ImmersedCells::damping_in(double dt) const {
    const double strength = options_.constraint_damping;
    if (options_.damped_step == 0 || dt == options_.damped_step) return strength;
    return (1 + strength) * dt / options_.damped_step - 1;  // strength = step / explicit limit - 1
}

void ImmersedCells::advance(double dt, const exchange::FieldView& velocity) {
    double *x = cells_.x().data(), *y = cells_.y().data(), *z = cells_.z().data();
    if (const double strength = damping_in(dt); damping_ && strength > 0) {
        damping_->set_strength(strength);
        damping_->apply(x, y, z, {velocity.component[0], velocity.component[1], velocity.component[2]});
    }
    move(nodes_, dt, velocity.component[0], velocity.component[1], velocity.component[2], x, y, z);
    if (recentring_) shift_ += recentring_->apply(x, y, z);
    if (elements_) elements_->advance(cells_, dt * options_.membrane_time);
}

Gap ImmersedCells::smallest_gap() {
    return overlap_ ? overlap_->smallest(cells_.x().data(), cells_.y().data(), cells_.z().data()) : Gap{};
}

void ImmersedCells::check() {
    const Gap gap = smallest_gap();
    if (gap.distance < 0)
        throw NumericalError(
            fmt::format("node {} of cell {} is {:.3g} um inside cell {}", gap.node, gap.cell, -gap.distance,
                        gap.other),
            "membranes cannot pass through each other",
            "raise contact.pressure or contact.range, refine the grid, or shorten numerics.step_strain");
}

std::string ImmersedCells::describe_node(std::size_t node) const {
    return fmt::format("membrane node {} of cell {}", node % cells_.stride(), node / cells_.stride());
}

void ImmersedCells::report_lost(std::size_t node) const {
    const std::string name = describe_node(node);
    const Vec3d at = cells_.positions(node / cells_.stride())[node % cells_.stride()];
    if (!std::isfinite(norm(at)))
        throw NumericalError(name, "its position is no longer a number; the step is probably too long",
                             "shorten numerics.step_strain");
    throw NumericalError(fmt::format("{} at ({:.3f}, {:.3f}, {:.3f}) um", name, at.x, at.y, at.z),
                         "it has left the box; the cell has drifted or grown as long as the box",
                         "set coupling.recentre if it drifts, or enlarge the box");
}

CellMemory ImmersedCells::memory() const {
    return {viscosity_ ? viscosity_->positions() : std::array<std::vector<double>, 3>{},
            target_,
            {shift_.x, shift_.y, shift_.z},
            options_.pull,
            elements_ ? elements_->state(cells_) : membrane::ViscousState{}};
}

void ImmersedCells::restore(const CellMemory& memory) {
    target_ = memory.target;
    shift_ = {memory.shift[0], memory.shift[1], memory.shift[2]};
    if (options_.recentre)
        recentring_ = std::make_unique<Recentring>(cells_.topology().triangles(), cells_.stride(),
                                                   cells_.cells(), Vec3d{target_[0], target_[1], target_[2]});
    if (viscosity_ && !memory.viscosity_nodes[0].empty()) {
        const exchange::Buffer<double> x(memory.viscosity_nodes[0]), y(memory.viscosity_nodes[1]),
            z(memory.viscosity_nodes[2]);
        viscosity_->recompute(x.data(), y.data(), z.data(), nu_.component[0], nu_.stride);
    }
    if (elements_ && !memory.viscous.tension.empty()) elements_->set_state(cells_, memory.viscous);
    place_padding(cells_);
}

}  // namespace hemoflux::coupling
