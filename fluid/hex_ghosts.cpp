// Kernels that fill the ghost cells of an unstructured grid.
#include "exchange/parallel.hpp"
#include "exchange/records.hpp"
#include "fluid/hex_boundary.hpp"

namespace hemoflux::fluid {
namespace {

struct Border {
    HexView grid;
    HexBorderView border;
    HEMOFLUX_INLINE std::size_t cell(std::size_t b) const { return grid.left[grid.border_face[b]]; }
    HEMOFLUX_INLINE std::size_t ghost(std::size_t b) const { return grid.cells + b; }
};

/// v <- v - 2 n (n.v)
HEMOFLUX_INLINE void reflect(const double (&n)[3], double& x, double& y, double& z) {
    const double twice = 2 * (n[0] * x + n[1] * y + n[2] * z);
    x -= twice * n[0];
    y -= twice * n[1];
    z -= twice * n[2];
}

using exchange::Four;
using exchange::load_four;
using exchange::store_four;

struct GhostValues : Border {
    double* values;
    HEMOFLUX_FN void operator()(std::size_t b) const {
        const HexBorderFace& face = border.face[b];
        const double* in = values + 4 * cell(b);
        double* out = values + 4 * ghost(b);
        double q[4] = {in[0], in[1], in[2], in[3]};
        if (face.density == DensityCondition::given) q[0] = 2 * face.value[0] - q[0];
        if (face.density == DensityCondition::given_gradient) q[0] -= face.step * face.value[0];
        if (face.velocity == VelocityCondition::given)
            for (int c = 1; c < 4; ++c) q[c] = 2 * face.value[c] - q[c];
        if (face.velocity == VelocityCondition::symmetry) reflect(face.normal, q[1], q[2], q[3]);
        for (int c = 0; c < 4; ++c) out[c] = q[c];
    }
};

/// Density and the three velocity components are treated side by side, in one register.
struct GhostRecords : Border {
    std::size_t first;
    const double* values;
    double* records;
    HEMOFLUX_FN void operator()(std::size_t k) const {
        const std::size_t b = grid.border_order[first + k], f = grid.border_face[b];
        const HexBorderFace& face = border.face[b];
        const double* in = records + 16 * std::size_t{grid.left_record[f]} + 4;
        double* out = records + 16 * std::size_t{grid.right_record[f]};
        const double* n = face.normal;
        const Four g[3] = {load_four(in), load_four(in + 4), load_four(in + 8)};
        const Four twice = 2.0 * (n[0] * g[0] + n[1] * g[1] + n[2] * g[2]);
        const bool of_density = face.density == DensityCondition::given,
                   of_velocity = face.velocity == VelocityCondition::given;
        const double sign_density = of_density ? -1 : 1, sign_velocity = of_velocity ? -1 : 1;
        const double signs[4] = {sign_density, sign_velocity, sign_velocity, sign_velocity};
        const double slopes[4] = {of_density ? 2.0 : 0.0, of_velocity ? 2.0 : 0.0, of_velocity ? 2.0 : 0.0,
                                  of_velocity ? 2.0 : 0.0};
        const Four sign = load_four(signs), given = load_four(slopes);
        store_four(out, load_four(values + 4 * ghost(b)));
        for (int a = 0; a < 3; ++a)
            store_four(out + 4 + 4 * a, sign * (g[a] - n[a] * twice) + given * load_four(face.slope[a]));
        if (face.density == DensityCondition::given_gradient)
            for (int a = 0; a < 3; ++a) out[4 + 4 * a] -= 2 * face.value[0] * n[a];
        if (face.velocity == VelocityCondition::symmetry)
            for (int a = 0; a < 3; ++a) reflect(face.normal, out[5 + 4 * a], out[6 + 4 * a], out[7 + 4 * a]);
    }
};

struct CopyToGhosts : Border {
    double* values;
    HEMOFLUX_FN void operator()(std::size_t b) const {
        store_four(values + 4 * ghost(b), load_four(values + 4 * cell(b)));
    }
};

}  // namespace

void fill_ghost_values(const HexView& grid, const HexBorderView& border, double* values) {
    exchange::for_each_index(border.count, GhostValues{{grid, border}, values}, exchange::Cost::cheap);
}

void fill_ghost_records(const HexView& grid, const HexBorderView& border, HexRange ghosts,
                        const double* values, double* records) {
    exchange::for_each_index(ghosts.last - ghosts.first,
                             GhostRecords{{grid, border}, ghosts.first, values, records},
                             exchange::Cost::cheap);
}

void copy_to_ghosts(const HexView& grid, double* values) {
    exchange::for_each_index(grid.border, CopyToGhosts{{grid, {}}, values}, exchange::Cost::cheap);
}

}  // namespace hemoflux::fluid
