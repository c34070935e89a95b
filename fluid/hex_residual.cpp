#include "fluid/hex_residual.hpp"

#include <type_traits>

#include "exchange/parallel.hpp"
#include "fluid/hex_face.hpp"

namespace hemoflux::fluid {
namespace {

using exchange::Four;
using exchange::load_four;
using exchange::Pack;
using exchange::store_four;

/// Cells one task balances, packs of faces another takes; fixed, so that nothing depends on the number of threads.
constexpr std::size_t cell_chunk = exchange::on_gpu ? 1 : 64;
constexpr std::size_t pack_chunk = exchange::on_gpu ? 1 : 16;

/// Values and gradients of a block of cells.
struct Gradients {
    HexView grid;
    HexRange cells;
    const double* values;
    double* records;

    HEMOFLUX_INLINE void cell(std::size_t i, double* out) const {
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
        store_four(out, here);
        store_four(out + 4, x);
        store_four(out + 8, y);
        store_four(out + 12, z);
    }
    HEMOFLUX_FN void operator()(std::size_t block) const {
        const std::size_t first = cells.first + block * gradient_block,
                          last = first + gradient_block < cells.last ? first + gradient_block : cells.last;
        double* out = records + 16 * (first % grid.cell_records);
        for (std::size_t i = first; i < last; ++i, out += 16) cell(i, out);
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
    HexRange faces;

    HEMOFLUX_FN void operator()(std::size_t chunk) const {
        constexpr std::size_t lanes = exchange::lanes<Pack>, size = pack_chunk * lanes;
        const std::size_t first = faces.first + chunk * size,
                          last = first + size < faces.last ? first + size : faces.last;
        for (std::size_t f = first; f < last; f += lanes) {
            const HexFace<Pack> face{grid, f};
            face.prefetch();
            Pack q[4];
            face.template flux<Force, Viscosity, Preconditioned>(records, force, parameters, inv_gamma, q);
            exchange::store_fours(flux + 4 * (f % grid.fluxes), q);
        }
    }
};

/// Mass fluxes that are prescribed.
struct PrescribedMass {
    HexView grid;
    HexBorderView border;
    std::size_t first;
    double* flux;
    HEMOFLUX_FN void operator()(std::size_t k) const {
        const std::size_t b = grid.border_order[first + k];
        const HexBorderFace& face = border.face[b];
        if (face.velocity == VelocityCondition::given || face.velocity == VelocityCondition::symmetry)
            flux[4 * (grid.border_face[b] % grid.fluxes)] = face.mass_flux;
    }
};

/// dQ/dt of a chunk of cells.
struct Balances {
    HexView grid;
    HexRange cells;
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
        const std::size_t first = cells.first + chunk * cell_chunk,
                          last = first + cell_chunk < cells.last ? first + cell_chunk : cells.last;
        for (std::size_t i = first; i < last; ++i) cell(i);
    }
};

std::size_t chunks(const HexRange& range, std::size_t size) {
    return (range.last - range.first + size - 1) / size;
}

/// Calls f for all i < n on the calling thread.
struct Serial {
    template <class Function>
    void operator()(std::size_t n, const Function& f) const {
        for (std::size_t i = 0; i < n; ++i) f(i);
    }
};
/// The same on the whole device.
struct Everywhere {
    template <class Function>
    void operator()(std::size_t n, const Function& f) const {
        exchange::for_each_index(n, f);
    }
};

/// The parts of a stage, each a loop of the kind Each.
template <class Each, bool Force, bool Viscosity, bool Preconditioned>
struct Parts {
    HexView grid;
    HexBorderView border;
    FlowParameters p;
    HexFields fields;

    void gradients(HexRange cells) const {
        Each()(chunks(cells, gradient_block), Gradients{grid, cells, fields.values, fields.records});
    }
    void fluxes(HexRange faces, HexRange ghosts) const {
        fill_ghost_records(grid, border, ghosts, fields.values, fields.records);
        Each()(chunks(faces, pack_chunk * exchange::lanes<Pack>),
               Fluxes<Force, Viscosity, Preconditioned>{grid, fields.records, fields.force, fields.flux, p,
                                                        1 / p.gamma, faces});
        Each()(ghosts.last - ghosts.first, PrescribedMass{grid, border, ghosts.first, fields.flux});
    }
    void balances(HexRange cells) const {
        const auto& f = p.uniform_force;
        Each()(chunks(cells, cell_chunk), Balances{grid,
                                                   cells,
                                                   fields.flux,
                                                   p.with_force ? fields.force : nullptr,
                                                   {f[0], f[1], f[2]},
                                                   1 / p.gamma,
                                                   fields.rate});
    }
};

/// The stages one thread visits, in a ring of its own.
template <bool Force, bool Viscosity, bool Preconditioned>
struct Segment {
    Parts<Serial, Force, Viscosity, Preconditioned> parts;
    const HexStage* stages;
    std::size_t count, segments, records;

    void operator()(std::size_t segment) const {
        const std::size_t first = count * segment / segments, last = count * (segment + 1) / segments;
        if (first == last) return;
        Parts<Serial, Force, Viscosity, Preconditioned> own = parts;
        own.fields.records += 16 * records * segment;
        own.fields.flux += 4 * own.grid.fluxes * segment;
        // what the first balances need of the stages before is computed here once more
        const std::size_t warm_up = stages[first].warm_up;
        for (std::size_t s = warm_up; s < last; ++s) {
            const HexStage& stage = stages[s];
            own.gradients({s == warm_up ? stage.lowest : stage.gradients.first, stage.gradients.last});
            own.fluxes(stage.faces, stage.ghosts);
            if (s >= first) own.balances(stage.cells);
        }
    }
};

template <bool Force, bool Viscosity, bool Preconditioned>
void launch(const HexGeometry& geometry, const HexBorderView& border, const FlowParameters& p,
            const HexFields& fields) {
    const std::vector<HexStage>& stages = geometry.stages();
    if constexpr (exchange::on_gpu) {
        const Parts<Everywhere, Force, Viscosity, Preconditioned> parts{geometry.view(), border, p, fields};
        for (const HexStage& stage : stages) {
            parts.gradients(stage.gradients);
            parts.fluxes(stage.faces, stage.ghosts);
            parts.balances(stage.cells);
        }
    } else {
        exchange::for_each_index(
            fields.rings, Segment<Force, Viscosity, Preconditioned>{{geometry.view(), border, p, fields},
                                                                    stages.data(),
                                                                    stages.size(),
                                                                    fields.rings,
                                                                    geometry.records()});
    }
}

/// Calls f with Force, Viscosity and Preconditioned as compile-time constants; a viscosity field stands in the records
/// of the force.
template <class Function>
void choose(const FlowParameters& p, const Function& f) {
    using Yes = std::true_type;
    using No = std::false_type;
    const bool preconditioned = p.gamma != 1;
    if (p.with_viscosity)
        preconditioned ? f(Yes(), Yes(), Yes()) : f(Yes(), Yes(), No());
    else if (p.with_force)
        preconditioned ? f(Yes(), No(), Yes()) : f(Yes(), No(), No());
    else
        preconditioned ? f(No(), No(), Yes()) : f(No(), No(), No());
}

}  // namespace

void evaluate_gradients(const HexView& grid, const HexFields& fields) {
    Parts<Everywhere, false, false, false>{grid, {}, {}, fields}.gradients({0, grid.cells});
}

void evaluate_fluxes(const HexView& grid, const HexBorderView& border, const FlowParameters& p,
                     const HexFields& fields) {
    if (p.with_force) copy_to_ghosts(grid, fields.force);
    choose(p, [&](auto force, auto viscosity, auto preconditioned) {
        Parts<Everywhere, force(), viscosity(), preconditioned()>{grid, border, p, fields}.fluxes(
            {0, exchange::round_up(grid.faces, face_block)}, {0, grid.border});
    });
}

void evaluate_hex_residual(const HexGeometry& geometry, const HexBorderView& border, const FlowParameters& p,
                           const HexFields& fields) {
    fill_ghost_values(geometry.view(), border, fields.values);
    if (p.with_force) copy_to_ghosts(geometry.view(), fields.force);
    choose(p, [&](auto force, auto viscosity, auto preconditioned) {
        launch<force(), viscosity(), preconditioned()>(geometry, border, p, fields);
    });
}

}  // namespace hemoflux::fluid
