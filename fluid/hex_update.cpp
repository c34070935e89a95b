#include "fluid/hex_update.hpp"

#include <cmath>

#include "exchange/parallel.hpp"
#include "exchange/records.hpp"
#include "fluid/norm_kernels.hpp"

namespace hemoflux::fluid {
namespace {

using exchange::Cost;
using exchange::for_each_index;
using exchange::Four;
using exchange::load_four;
using exchange::store_four;

struct Update {
    const double* base;
    const double* rate;
    double* sum;
    UpdateParameters p;
    double* values;

    HEMOFLUX_FN void operator()(std::size_t cell) const {
        const std::size_t i = 4 * cell;
        const double step = p.local_dt ? p.a * p.local_dt[cell] : p.a;
        Four total = load_four(rate + i);
        if (p.accumulate || p.use_sum) {
            Four weighted = p.w * total;
            if (!p.first) weighted += load_four(sum + i);
            if (p.accumulate) store_four(sum + i, weighted);
            if (p.use_sum) total = weighted;
        }
        double increment[4];
        store_four(increment, step * total);
        const double rho = base[i], new_rho = rho + increment[0], inverse = 1 / new_rho;
        for (int c = 1; c < 4; ++c) values[i + c] = (rho * base[i + c] + increment[c]) * inverse;
        values[i] = new_rho;
    }
};

struct LocalSteps {
    HexView grid;
    const double* values;
    LocalStepParameters p;
    double* dt;
    HEMOFLUX_FN void operator()(std::size_t cell) const {
        double convective = 0, squares = 0;
        for (int a = 0; a < 3; ++a) {
            const double s = grid.projection[3 * cell + a];
            convective += convective_radius(values[4 * cell + 1 + a], p.gamma) * s;
            squares += s * s;
        }
        const double inverse_volume = grid.inverse_volume[cell];
        const double viscous = 2 * p.nu / p.gamma * squares * inverse_volume;
        dt[cell] = p.sigma / (inverse_volume * (convective + p.c * viscous));
    }
};

struct Conserved {
    std::size_t cells;
    const double* values;
    double* q;
    HEMOFLUX_FN void operator()(std::size_t cell) const {
        const double rho = values[4 * cell];
        q[cell] = rho;
        for (std::size_t c = 1; c < 4; ++c) q[c * cells + cell] = rho * values[4 * cell + c];
    }
};

struct Values {
    std::size_t cells;
    const double* q;
    double* values;
    HEMOFLUX_FN void operator()(std::size_t cell) const {
        const double rho = q[cell];
        values[4 * cell] = rho;
        for (std::size_t c = 1; c < 4; ++c) values[4 * cell + c] = q[c * cells + cell] / rho;
    }
};

struct Components {
    std::size_t cells;
    const double* records;
    double* to;
    HEMOFLUX_FN void operator()(std::size_t cell) const {
        for (std::size_t c = 0; c < 4; ++c) to[c * cells + cell] = records[4 * cell + c];
    }
};

struct SquareOf {
    const double* rate;
    HEMOFLUX_FN Squares operator()(std::size_t cell) const {
        Squares s;
        for (int c = 0; c < 4; ++c) s.c[c] = rate[4 * cell + c] * rate[4 * cell + c];
        return s;
    }
};

/// Volume and excess of mass over density 1.
struct Mass {
    double volume = 0, excess = 0;
    HEMOFLUX_FN Mass& operator+=(const Mass& b) {
        volume += b.volume;
        excess += b.excess;
        return *this;
    }
};
struct MassOf {
    HexView grid;
    const double* values;
    HEMOFLUX_FN Mass operator()(std::size_t cell) const {
        const double volume = 1 / grid.inverse_volume[cell];
        return {volume, volume * (values[4 * cell] - 1)};
    }
};

HEMOFLUX_INLINE double squared_speed(const double* q) { return q[1] * q[1] + q[2] * q[2] + q[3] * q[3]; }

struct SquaredSpeed {
    const double* values;
    HEMOFLUX_FN exchange::Maximum operator()(std::size_t cell) const {
        return {squared_speed(values + 4 * cell)};
    }
};

struct IsBad {
    const double* values;
    HEMOFLUX_FN bool operator()(std::size_t cell) const {
        const double* q = values + 4 * cell;
        return !possible(q[0], squared_speed(q));
    }
};

}  // namespace

void update_hex(std::size_t cells, const double* base, const double* rate, double* sum,
                const UpdateParameters& p, double* values) {
    for_each_index(cells, Update{base, rate, sum, p, values}, Cost::cheap);
}

void hex_local_steps(const HexView& grid, const double* values, const LocalStepParameters& p, double* dt) {
    for_each_index(grid.cells, LocalSteps{grid, values, p, dt}, Cost::cheap);
}

void hex_conserved(std::size_t cells, const double* values, double* q) {
    for_each_index(cells, Conserved{cells, values, q}, Cost::cheap);
}
void hex_values(std::size_t cells, const double* q, double* values) {
    for_each_index(cells, Values{cells, q, values}, Cost::cheap);
}
void hex_components(std::size_t cells, const double* records, double* to) {
    for_each_index(cells, Components{cells, records, to}, Cost::cheap);
}

ResidualNorm hex_norm(std::size_t cells, const double* rate) {
    exchange::Reduction<Squares> reduction;
    const Squares s = reduction.sum(cells, SquareOf{rate});
    const auto rms = [&](int c) { return std::sqrt(s.c[c] / static_cast<double>(cells)); };
    return {rms(0), {rms(1), rms(2), rms(3)}};
}

double hex_mean_density(const HexView& grid, const double* values) {
    exchange::Reduction<Mass> reduction;
    const Mass mass = reduction.sum(grid.cells, MassOf{grid, values});
    return 1 + mass.excess / mass.volume;
}

double hex_largest_speed(std::size_t cells, const double* values) {
    exchange::Reduction<exchange::Maximum> reduction;
    return std::sqrt(reduction.sum(cells, SquaredSpeed{values}).value);
}

std::size_t hex_first_bad(std::size_t cells, const double* values) {
    return exchange::find_first(cells, IsBad{values});
}

}  // namespace hemoflux::fluid
