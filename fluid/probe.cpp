#include "fluid/probe.hpp"

#include <stdexcept>

#include "fluid/grid_interpolant.hpp"
#include "fluid/hex_solver.hpp"
#include "fluid/host_fields.hpp"

namespace hemoflux::fluid {
namespace {

class GridProbe final : public Probe {
  public:
    explicit GridProbe(const Solver& solver) {
        const HostFields fields = host_fields(solver);
        for (std::size_t c = 0; c < 4; ++c) {
            std::array<Border, 6> borders{};
            for (std::size_t p = 0; p < 6; ++p) {
                const Patch& patch = solver.boundary().patches()[p];
                const bool given = c == 0 ? patch.density == DensityCondition::given
                                          : patch.velocity == VelocityCondition::given;
                borders[p] = patch.velocity == VelocityCondition::periodic ? Border::periodic
                             : given                                       ? Border::face
                                                                           : Border::open;
            }
            fields_.emplace_back(solver.grid(), fields.q[c], borders);
        }
    }

    [[nodiscard]] std::array<double, 4> operator()(const Vec3d& at) const override {
        return {fields_[0](at), fields_[1](at), fields_[2](at), fields_[3](at)};
    }

  private:
    std::vector<GridInterpolant> fields_;
};

}  // namespace

std::unique_ptr<Probe> make_probe(const Solver& solver) { return std::make_unique<GridProbe>(solver); }

std::unique_ptr<Probe> make_probe(const Flow& flow) {
    if (const auto* solver = dynamic_cast<const Solver*>(&flow)) return make_probe(*solver);
    if (const auto* solver = dynamic_cast<const HexSolver*>(&flow)) return make_probe(*solver);
    throw std::invalid_argument("make_probe: unknown kind of flow");
}

}  // namespace hemoflux::fluid
