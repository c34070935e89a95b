#include "scalar_lbfs.hpp"

namespace hemoflux::bench {
namespace {

constexpr std::size_t directions = 15;
constexpr double e[directions][3] = {{0, 0, 0},   {1, 0, 0},  {-1, 0, 0},  {0, 1, 0},    {0, -1, 0},
                                     {0, 0, 1},   {0, 0, -1}, {1, 1, 1},   {-1, -1, -1}, {1, 1, -1},
                                     {-1, -1, 1}, {1, -1, 1}, {-1, 1, -1}, {-1, 1, 1},   {1, -1, -1}};
constexpr double weight[directions] = {2.0 / 9,  1.0 / 9,  1.0 / 9,  1.0 / 9,  1.0 / 9,
                                       1.0 / 9,  1.0 / 9,  1.0 / 72, 1.0 / 72, 1.0 / 72,
                                       1.0 / 72, 1.0 / 72, 1.0 / 72, 1.0 / 72, 1.0 / 72};

/// (2.7) for one direction.
double equilibrium(std::size_t a, double density, double u, double v, double w) {
    const double along = e[a][0] * u + e[a][1] * v + e[a][2] * w;
    return density * weight[a] * (1 + 3 * along + 4.5 * along * along - 1.5 * (u * u + v * v + w * w));
}

}  // namespace

ScalarFlow::ScalarFlow(std::array<std::size_t, 3> n, double width, double viscosity)
    : cells_(n[0] * n[1] * n[2]), width_(width), viscosity_(viscosity) {
    fields_.fill(std::vector<double>(cells_));
    residual_.fill(std::vector<double>(cells_));
    for (auto& of_field : gradient_) of_field.fill(std::vector<double>(cells_));
    const std::array<std::size_t, 3> stride{1, n[0], n[0] * n[1]};
    for (std::size_t axis = 0; axis < 3; ++axis)
        for (std::size_t cell = 0; cell < cells_; ++cell) {
            const std::size_t i = cell / stride[axis] % n[axis], origin = cell - i * stride[axis];
            below_[axis].push_back(origin + (i + n[axis] - 1) % n[axis] * stride[axis]);
            above_[axis].push_back(origin + (i + 1) % n[axis] * stride[axis]);
        }
}

void ScalarFlow::compute_gradients() {
    for (std::size_t field = 0; field < 4; ++field)
        for (std::size_t axis = 0; axis < 3; ++axis)
            for (std::size_t cell = 0; cell < cells_; ++cell)
                gradient_[field][axis][cell] =
                    (fields_[field][above_[axis][cell]] - fields_[field][below_[axis][cell]]) / (2 * width_);
}

ScalarFlow::Moments ScalarFlow::extrapolate(std::size_t cell, const std::array<double, 3>& offset) const {
    Moments value;
    for (std::size_t field = 0; field < 4; ++field) {
        value[field] = fields_[field][cell];
        for (std::size_t axis = 0; axis < 3; ++axis)
            value[field] += offset[axis] * gradient_[field][axis][cell];
    }
    return value;
}

ScalarFlow::Moments ScalarFlow::face_flux(std::size_t left, std::size_t right, std::size_t normal) const {
    const double delta = width_ / 2, relaxation = 3 * viscosity_ / delta;  // tau - 1/2
    double before[directions], density = 0, momentum[3] = {0, 0, 0};
    for (std::size_t a = 0; a < directions; ++a) {
        std::array<double, 3> from_left, from_right;
        for (std::size_t axis = 0; axis < 3; ++axis) from_left[axis] = from_right[axis] = -e[a][axis] * delta;
        from_left[normal] += width_ / 2;
        from_right[normal] -= width_ / 2;
        Moments node;
        if (e[a][normal] > 0) {
            node = extrapolate(left, from_left);
        } else if (e[a][normal] < 0) {
            node = extrapolate(right, from_right);
        } else {
            const Moments l = extrapolate(left, from_left), r = extrapolate(right, from_right);
            for (std::size_t field = 0; field < 4; ++field) node[field] = (l[field] + r[field]) / 2;
        }
        before[a] = equilibrium(a, node[0], node[1], node[2], node[3]);
        density += before[a];
        for (std::size_t axis = 0; axis < 3; ++axis) momentum[axis] += e[a][axis] * before[a];
    }
    Moments flux{momentum[normal], 0, 0, 0};
    for (std::size_t a = 0; a < directions; ++a) {
        const double after =
            equilibrium(a, density, momentum[0] / density, momentum[1] / density, momentum[2] / density);
        const double f = after - relaxation * (after - before[a]);
        for (std::size_t axis = 0; axis < 3; ++axis) flux[1 + axis] += e[a][normal] * e[a][axis] * f;
    }
    return flux;
}

void ScalarFlow::evaluate() {
    compute_gradients();
    for (auto& component : residual_) component.assign(cells_, 0.0);
    for (std::size_t axis = 0; axis < 3; ++axis)
        for (std::size_t left = 0; left < cells_; ++left) {
            const std::size_t right = above_[axis][left];
            const Moments flux = face_flux(left, right, axis);
            for (std::size_t c = 0; c < 4; ++c) {
                residual_[c][left] -= flux[c] / width_;
                residual_[c][right] += flux[c] / width_;
            }
        }
}

}  // namespace hemoflux::bench
