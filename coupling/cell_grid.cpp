#include "coupling/cell_grid.hpp"

#include <algorithm>
#include <cmath>

#include "coupling/interpolate.hpp"
#include "coupling/node_bins.hpp"
#include "coupling/spread.hpp"

namespace hemoflux::coupling {
namespace {

using exchange::FieldView;

/// Width at x, linear between the centres and constant beyond the first and the last; on the host.
double width_at(const meshing::Axis& axis, bool periodic, double x) {
    if (periodic) x -= axis.length() * std::floor((x - axis.lower()) / axis.length());
    const auto centres = axis.centres(), widths = axis.widths();
    const auto after = std::upper_bound(centres.begin(), centres.end(), x);
    if (after == centres.begin()) return widths.front();
    if (after == centres.end()) return widths.back();
    const auto k = static_cast<std::size_t>(after - centres.begin());
    return widths[k - 1] + (x - centres[k - 1]) / (centres[k] - centres[k - 1]) * (widths[k] - widths[k - 1]);
}

class CellSpreader final : public ForceSpreader {
  public:
    CellSpreader(const StencilSet& stencils, ForceSpreader* first)
        : spreader_(stencils, first ? &dynamic_cast<CellSpreader&>(*first).spreader_ : nullptr) {}

    void spread(const FieldView& force, double factor, const FieldView& density) override {
        spreader_.spread(force.component[0], force.component[1], force.component[2], factor, density);
    }
    void accelerate(double dt, const FieldView& density, const FluidFields& fluid) const override {
        spreader_.accelerate(dt, density, fluid);
    }
    void forget() override { spreader_.forget(); }

  private:
    Spreader spreader_;
};

class CellLink final : public NodeLink {
  public:
    CellLink(const CellGrid& grid, Kernel kernel, std::size_t nodes) : stencils_(grid, kernel, nodes) {}

    [[nodiscard]] std::size_t size() const override { return stencils_.size(); }
    void locate(const FieldView& positions) override {
        stencils_.update(positions.component[0], positions.component[1], positions.component[2]);
    }
    [[nodiscard]] std::size_t first_lost() const override { return stencils_.first_lost(); }
    void interpolate(const FieldView& field, const FieldView& values) const override {
        coupling::interpolate(stencils_, field, values.component[0], values.component[1],
                              values.component[2]);
    }
    [[nodiscard]] std::unique_ptr<ForceSpreader> spreader(ForceSpreader* first) const override {
        return std::make_unique<CellSpreader>(stencils_, first);
    }

  private:
    StencilSet stencils_;
};

}  // namespace

NodeBox CellGrid::box() const { return node_box(view()); }

bool CellGrid::contains(const Vec3d& at) const {
    const double x[3] = {at.x, at.y, at.z};
    for (std::size_t a = 0; a < 3; ++a)
        if (!axes_[a].view().contains(x[a])) return false;
    return true;
}

double CellGrid::cell_volume(const Vec3d& at) const {
    const double x[3] = {at.x, at.y, at.z};
    double volume = 1;
    for (std::size_t a = 0; a < 3; ++a) {
        const auto& faces = grid_.axes[a].faces;
        const auto after = std::upper_bound(faces.begin() + 1, faces.end() - 1, x[a]);
        volume *= *after - *(after - 1);
    }
    return volume;
}

double CellGrid::width(const Vec3d& at, const Vec3d& n) const {
    const auto h = [&](std::size_t a, double x) {
        return width_at(grid_.axes[a], axes_[a].view().periodic, x);
    };
    return norm(Vec3d{n.x * h(0, at.x), n.y * h(1, at.y), n.z * h(2, at.z)});
}

std::unique_ptr<NodeLink> CellGrid::link(Kernel kernel, std::size_t nodes) const {
    return std::make_unique<CellLink>(*this, kernel, nodes);
}

}  // namespace hemoflux::coupling
