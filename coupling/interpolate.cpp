#include "coupling/interpolate.hpp"

#include "exchange/parallel.hpp"

namespace hemoflux::coupling {
namespace {

/// Gathers the velocity of marker m: the 16 rows of its cells are summed lane by lane, four cells along x at
/// once.
struct Interpolate {
    CellGridView grid;
    const Stencil* stencils;
    const double* HEMOFLUX_RESTRICT field[3];
    double* HEMOFLUX_RESTRICT velocity[3];

    HEMOFLUX_FN void operator()(std::size_t m) const {
        const Stencil& s = stencils[m];
        const exchange::Layout& layout = grid.layout;
        std::size_t y[stencil_width], x[stencil_width];
        for (int a = 0; a < stencil_width; ++a) {
            y[a] = static_cast<std::size_t>(grid.axis[1].cell(s.first[1] + a)) * layout.row;
            x[a] = static_cast<std::size_t>(s.wraps_x ? grid.axis[0].cell(s.first[0] + a) : s.first[0] + a);
        }
        double u[stencil_width] = {}, v[stencil_width] = {}, w[stencil_width] = {};
        for (int c = 0; c < stencil_width; ++c) {
            const std::size_t plane =
                layout.origin + static_cast<std::size_t>(grid.axis[2].cell(s.first[2] + c)) * layout.plane;
            for (int b = 0; b < stencil_width; ++b) {
                const double weight = s.weight[1][b] * s.weight[2][c];
                const std::size_t row = plane + y[b];
                if (s.wraps_x) {
                    for (int a = 0; a < stencil_width; ++a) {
                        u[a] += weight * field[0][row + x[a]];
                        v[a] += weight * field[1][row + x[a]];
                        w[a] += weight * field[2][row + x[a]];
                    }
                } else {
                    const std::size_t at = row + x[0];
                    for (int a = 0; a < stencil_width; ++a) u[a] += weight * field[0][at + a];
                    for (int a = 0; a < stencil_width; ++a) v[a] += weight * field[1][at + a];
                    for (int a = 0; a < stencil_width; ++a) w[a] += weight * field[2][at + a];
                }
            }
        }
        double V[3] = {0, 0, 0};
        for (int a = 0; a < stencil_width; ++a) {
            V[0] += s.weight[0][a] * u[a];
            V[1] += s.weight[0][a] * v[a];
            V[2] += s.weight[0][a] * w[a];
        }
        for (int q = 0; q < 3; ++q) velocity[q][m] = V[q];
    }
};

}  // namespace

void interpolate(const StencilSet& stencils, const exchange::FieldView& velocity, double* vx, double* vy,
                 double* vz) {
    exchange::for_each_index(
        stencils.size(), Interpolate{stencils.grid(),
                                     stencils.data(),
                                     {velocity.component[0], velocity.component[1], velocity.component[2]},
                                     {vx, vy, vz}});
}

}  // namespace hemoflux::coupling
