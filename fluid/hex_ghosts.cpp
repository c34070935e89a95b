// Kernels that fill the ghost cells of an unstructured grid.
#include "exchange/parallel.hpp"
#include "exchange/records.hpp"
#include "fluid/hex_boundary.hpp"

namespace hemoflux::fluid {
namespace {

struct Border {
    HexView grid;
    HexBorderView border;
    HEMOFLUX_INLINE std::size_t cell(std::size_t b) const { return grid.left[grid.interior + b]; }
    HEMOFLUX_INLINE std::size_t ghost(std::size_t b) const { return grid.cells + b; }
};

/// v <- v - 2 n (n.v)
HEMOFLUX_INLINE void reflect(const double (&n)[3], double& x, double& y, double& z) {
    const double twice = 2 * (n[0] * x + n[1] * y + n[2] * z);
    x -= twice * n[0];
    y -= twice * n[1];
    z -= twice * n[2];
}

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

struct GhostRecords : Border {
    const double* values;
    double* records;
    HEMOFLUX_FN void operator()(std::size_t b) const {
        const HexBorderFace& face = border.face[b];
        const double* in = records + 16 * cell(b);
        double* out = records + 16 * ghost(b);
        double g[4][3];
        for (int c = 0; c < 4; ++c) {
            for (int a = 0; a < 3; ++a) g[c][a] = in[4 + 4 * a + c];
            reflect(face.normal, g[c][0], g[c][1], g[c][2]);
        }
        if (face.density == DensityCondition::given)
            for (int a = 0; a < 3; ++a) g[0][a] = 2 * face.slope[0][a] - g[0][a];
        if (face.density == DensityCondition::given_gradient)
            for (int a = 0; a < 3; ++a) g[0][a] -= 2 * face.value[0] * face.normal[a];
        if (face.velocity == VelocityCondition::given)
            for (int c = 1; c < 4; ++c)
                for (int a = 0; a < 3; ++a) g[c][a] = 2 * face.slope[c][a] - g[c][a];
        if (face.velocity == VelocityCondition::symmetry)
            for (int a = 0; a < 3; ++a) reflect(face.normal, g[1][a], g[2][a], g[3][a]);
        for (int c = 0; c < 4; ++c) {
            out[c] = values[4 * ghost(b) + c];
            for (int a = 0; a < 3; ++a) out[4 + 4 * a + c] = g[c][a];
        }
    }
};

struct CopyToGhosts : Border {
    double* values;
    HEMOFLUX_FN void operator()(std::size_t b) const {
        exchange::store_four(values + 4 * ghost(b), exchange::load_four(values + 4 * cell(b)));
    }
};

}  // namespace

void fill_ghost_values(const HexView& grid, const HexBorderView& border, double* values) {
    exchange::for_each_index(border.count, GhostValues{{grid, border}, values}, exchange::Cost::cheap);
}

void fill_ghost_records(const HexView& grid, const HexBorderView& border, const double* values,
                        double* records) {
    exchange::for_each_index(border.count, GhostRecords{{grid, border}, values, records},
                             exchange::Cost::cheap);
}

void copy_to_ghosts(const HexView& grid, double* values) {
    const std::size_t count = grid.faces - grid.interior;
    exchange::for_each_index(count, CopyToGhosts{{grid, {}}, values}, exchange::Cost::cheap);
}

}  // namespace hemoflux::fluid
