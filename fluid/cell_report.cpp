#include "fluid/cell_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "exchange/buffer.hpp"

namespace hemoflux::fluid {

std::string describe_cell(const Flow& flow, std::size_t cell) {
    const Vec3d at = flow.centre(cell);
    const double u = flow.values(1)[cell], v = flow.values(2)[cell], w = flow.values(3)[cell];
    return fmt::format("fluid cell {} at ({:.3f}, {:.3f}, {:.3f}) um, density {:.4g}, speed {:.4g} c", cell,
                       at.x, at.y, at.z, flow.values(0)[cell], std::hypot(u, v, w));
}

std::size_t first_density_outside(const Flow& flow, double lowest, double highest) {
    const std::vector<double> density = flow.values(0);
    const auto bad = std::find_if_not(density.begin(), density.end(),
                                      [&](double rho) { return rho >= lowest && rho <= highest; });
    return static_cast<std::size_t>(bad - density.begin());
}

std::size_t least_steady_cell(const Flow& flow) {
    exchange::Buffer<double> residual(4 * flow.cells());
    flow.read_residual(residual.data());
    const std::vector<double> r = residual.to_host();
    std::vector<double> size(flow.cells(), 0.0);
    for (std::size_t i = 0; i < r.size(); ++i) size[i % size.size()] += r[i] * r[i];
    return static_cast<std::size_t>(std::max_element(size.begin(), size.end()) - size.begin());
}

}  // namespace hemoflux::fluid
