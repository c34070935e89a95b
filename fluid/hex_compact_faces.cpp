// The faces of an unstructured grid for implicit methods.
#include <algorithm>

#include "fluid/hex_solver.hpp"

namespace hemoflux::fluid {

CompactModel HexSolver::compact_model() const {
    const double limit = largest_delta(options_);
    CompactModel model{options_.gamma, {}};
    model.faces.reserve(grid_.faces());
    std::vector<HexBorderFace> border(boundary_.view().count);
    exchange::copy_to_host(border.data(), boundary_.view().face, border.size() * sizeof(HexBorderFace));
    const std::size_t interior = grid_.interior_faces();
    for (std::size_t i = 0; i < grid_.faces(); ++i) {
        CompactFace f;
        f.border = i >= interior;
        f.left = grid_.left[i];
        f.right = f.border ? f.left : grid_.right[i];
        if (!f.border && f.left == f.right) continue;
        f.area = norm(grid_.area[i]);
        f.normal = (1 / f.area) * grid_.area[i];
        f.nu = options_.nu;
        f.delta = std::min(limit, grid_.delta[i]);
        f.weight_left = 0.5;
        if (f.border) {
            const HexBorderFace& b = border[i - interior];
            f.velocity = b.velocity;
            f.density = b.density;
            if (b.density == DensityCondition::given) f.offset[0] = 2 * b.value[0];
            if (b.density == DensityCondition::given_gradient) f.offset[0] = -b.step * b.value[0];
            if (b.velocity == VelocityCondition::given)
                for (int c = 1; c < 4; ++c) f.offset[c] = 2 * b.value[c];
        } else {
            Vec3d other = grid_.centre[f.right];
            if (!grid_.shift.empty()) other += grid_.shift[i];
            const double to_left = dot(grid_.face_centre[i] - grid_.centre[f.left], f.normal),
                         to_right = dot(other - grid_.face_centre[i], f.normal);
            f.weight_left = to_right / (to_left + to_right);
        }
        model.faces.push_back(f);
    }
    return model;
}

}  // namespace hemoflux::fluid
