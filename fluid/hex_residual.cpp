#include "fluid/hex_residual.hpp"

#include "exchange/parallel.hpp"
#include "fluid/hex_face.hpp"

namespace hemoflux::fluid {
namespace {

using exchange::Four;
using exchange::load_four;
using exchange::Pack;
using exchange::store_four;

/// Cells one task takes; fixed, so that nothing depends on the number of threads.
constexpr std::size_t cell_chunk = exchange::on_gpu ? 1 : 64;
/// Packs of faces one task takes.
constexpr std::size_t pack_chunk = exchange::on_gpu ? 1 : 16;

/// Values and gradients of a chunk of cells.
struct Gradients {
    HexView grid;
    const double* values;
    double* records;

    HEMOFLUX_INLINE void cell(std::size_t i) const {
        const std::uint32_t* neighbour = grid.neighbour + hex_sides * i;
        const double* w = grid.weight + 3 * hex_sides * i;
        const Four here = load_four(values + 4 * i);
        Four x(0.0), y(0.0), z(0.0);
        for (std::size_t j = 0; j < hex_sides; ++j) {
            const Four step = load_four(values + 4 * std::size_t{neighbour[j]}) - here;
            x += w[3 * j] * step;
            y += w[3 * j + 1] * step;
            z += w[3 * j + 2] * step;
        }
        double* out = records + 16 * i;
        store_four(out, here);
        store_four(out + 4, x);
        store_four(out + 8, y);
        store_four(out + 12, z);
    }
    HEMOFLUX_FN void operator()(std::size_t chunk) const {
        const std::size_t last =
            (chunk + 1) * cell_chunk < grid.cells ? (chunk + 1) * cell_chunk : grid.cells;
        for (std::size_t i = chunk * cell_chunk; i < last; ++i) cell(i);
    }
};

/// Fluxes through a chunk of faces.
template <bool Force, bool Viscosity, bool Preconditioned>
struct Fluxes {
    HexView grid;
    const double* records;
    const double* force;
    double* flux;
    FlowParameters parameters;
    double inv_gamma;
    std::size_t packs;

    HEMOFLUX_FN void operator()(std::size_t chunk) const {
        const std::size_t last = (chunk + 1) * pack_chunk < packs ? (chunk + 1) * pack_chunk : packs;
        for (std::size_t p = chunk * pack_chunk; p < last; ++p) {
            const HexFace<Pack> face{grid, p * exchange::lanes<Pack>};
            Pack q[4];
            face.template flux<Force, Viscosity, Preconditioned>(records, force, parameters, inv_gamma, q);
            exchange::store_fours(flux + 4 * face.first, q);
        }
    }
};

/// Mass fluxes that are prescribed.
struct PrescribedMass {
    HexView grid;
    HexBorderView border;
    double* flux;
    HEMOFLUX_FN void operator()(std::size_t b) const {
        const HexBorderFace& face = border.face[b];
        if (face.velocity == VelocityCondition::given || face.velocity == VelocityCondition::symmetry)
            flux[4 * (grid.interior + b)] = face.mass_flux;
    }
};

/// dQ/dt of a chunk of cells.
struct Balances {
    HexView grid;
    const double* flux;
    const double* force;
    double uniform_force[3];
    double force_scale;
    double* rate;

    HEMOFLUX_INLINE void cell(std::size_t i) const {
        const std::uint32_t* side = grid.side + hex_sides * i;
        constexpr double sign[2] = {-1, 1};
        Four in(0.0);
        for (std::size_t j = 0; j < hex_sides; ++j) {
            in += sign[side[j] & 1u] * load_four(flux + 4 * std::size_t{side[j] >> 1});
        }
        double* out = rate + 4 * i;
        store_four(out, grid.inverse_volume[i] * in);
        if (force)
            for (std::size_t a = 0; a < 3; ++a)
                out[1 + a] += force_scale * (force[4 * i + a] + uniform_force[a]);
    }
    HEMOFLUX_FN void operator()(std::size_t chunk) const {
        const std::size_t last =
            (chunk + 1) * cell_chunk < grid.cells ? (chunk + 1) * cell_chunk : grid.cells;
        for (std::size_t i = chunk * cell_chunk; i < last; ++i) cell(i);
    }
};

std::size_t chunks(std::size_t n, std::size_t size) { return (n + size - 1) / size; }

template <bool Force, bool Viscosity, bool Preconditioned>
void launch_fluxes(const HexView& grid, const FlowParameters& p, const HexFields& fields) {
    const std::size_t packs = chunks(grid.faces, exchange::lanes<Pack>);
    exchange::for_each_index(chunks(packs, pack_chunk),
                             Fluxes<Force, Viscosity, Preconditioned>{grid, fields.records, fields.force,
                                                                      fields.flux, p, 1 / p.gamma, packs});
}

}  // namespace

void evaluate_gradients(const HexView& grid, const HexFields& fields) {
    exchange::for_each_index(chunks(grid.cells, cell_chunk), Gradients{grid, fields.values, fields.records});
}

void evaluate_fluxes(const HexView& grid, const HexBorderView& border, const FlowParameters& p,
                     const HexFields& fields) {
    const bool preconditioned = p.gamma != 1;
    if (p.with_force) copy_to_ghosts(grid, fields.force);
    if (p.with_viscosity)
        preconditioned ? launch_fluxes<true, true, true>(grid, p, fields)
                       : launch_fluxes<true, true, false>(grid, p, fields);
    else if (p.with_force)
        preconditioned ? launch_fluxes<true, false, true>(grid, p, fields)
                       : launch_fluxes<true, false, false>(grid, p, fields);
    else
        preconditioned ? launch_fluxes<false, false, true>(grid, p, fields)
                       : launch_fluxes<false, false, false>(grid, p, fields);
    exchange::for_each_index(border.count, PrescribedMass{grid, border, fields.flux}, exchange::Cost::cheap);
}

void evaluate_hex_residual(const HexView& grid, const HexBorderView& border, const FlowParameters& p,
                           const HexFields& fields) {
    fill_ghost_values(grid, border, fields.values);
    evaluate_gradients(grid, fields);
    fill_ghost_records(grid, border, fields.values, fields.records);
    evaluate_fluxes(grid, border, p, fields);
    const auto& f = p.uniform_force;
    exchange::for_each_index(chunks(grid.cells, cell_chunk), Balances{grid,
                                                                      fields.flux,
                                                                      p.with_force ? fields.force : nullptr,
                                                                      {f[0], f[1], f[2]},
                                                                      1 / p.gamma,
                                                                      fields.rate});
}

}  // namespace hemoflux::fluid
