#include "fluid/flow.hpp"

#include <array>

namespace hemoflux::fluid {

void Flow::initialise(const std::function<FlowPoint(const Vec3d&)>& flow) {
    std::array<std::vector<double>, 4> q;
    q.fill(std::vector<double>(cells()));
    for (std::size_t i = 0; i < cells(); ++i) {
        const FlowPoint p = flow(centre(i));
        q[0][i] = p.density;
        q[1][i] = p.velocity.x, q[2][i] = p.velocity.y, q[3][i] = p.velocity.z;
    }
    for (int c = 0; c < 4; ++c) set_values(c, q[static_cast<std::size_t>(c)]);
}

}  // namespace hemoflux::fluid
