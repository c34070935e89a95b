#include "fluid/krylov.hpp"

#include <cmath>

#include "exchange/parallel.hpp"

namespace hemoflux::fluid {
namespace {

/// Values summed by one call, in eight interleaved sums that a compiler can keep in one register.
constexpr std::size_t group = 64, interleaved = 8;

/// Sum of term(i) over group g of n values.
template <class Term>
HEMOFLUX_INLINE double group_sum(std::size_t n, std::size_t g, const Term& term) {
    const std::size_t first = g * group, last = first + group < n ? first + group : n;
    double sum[interleaved] = {0, 0, 0, 0, 0, 0, 0, 0};
    std::size_t i = first;
    for (; i + interleaved <= last; i += interleaved)
        for (std::size_t l = 0; l < interleaved; ++l) sum[l] += term(i + l);
    for (std::size_t l = 0; i + l < last; ++l) sum[l] += term(i + l);
    return ((sum[0] + sum[4]) + (sum[2] + sum[6])) + ((sum[1] + sum[5]) + (sum[3] + sum[7]));
}

/// w . (vector j) over one group.
struct Projection {
    const float* basis;
    const double* w;
    std::size_t n;
    HEMOFLUX_FN double operator()(std::size_t j, std::size_t g) const {
        const float* v = basis + j * n;
        return group_sum(n, g, [&](std::size_t i) { return static_cast<double>(v[i]) * w[i]; });
    }
};

struct SquareSum {
    const double* w;
    std::size_t n;
    HEMOFLUX_FN double operator()(std::size_t g) const {
        return group_sum(n, g, [&](std::size_t i) { return w[i] * w[i]; });
    }
};

/// One group of values; base of element-wise kernels.
struct Group {
    std::size_t n;
    HEMOFLUX_INLINE std::size_t first(std::size_t g) const { return g * group; }
    HEMOFLUX_INLINE std::size_t last(std::size_t g) const {
        return g * group + group < n ? g * group + group : n;
    }
};

/// w -= sum_j h_j (vector j)
struct Subtract : Group {
    const float* basis;
    const double* h;
    std::size_t k;
    double* w;
    HEMOFLUX_FN void operator()(std::size_t g) const {
        for (std::size_t j = 0; j < k; ++j) {
            const float* v = basis + j * n;
            for (std::size_t i = first(g); i < last(g); ++i) w[i] -= h[j] * static_cast<double>(v[i]);
        }
    }
};

struct Combine : Group {
    const float* basis;
    const double* y;
    std::size_t k;
    float* out;
    HEMOFLUX_FN void operator()(std::size_t g) const {
        for (std::size_t i = first(g); i < last(g); ++i) out[i] = 0;
        for (std::size_t j = 0; j < k; ++j) {
            const auto factor = static_cast<float>(y[j]);
            const float* v = basis + j * n;
            for (std::size_t i = first(g); i < last(g); ++i) out[i] += factor * v[i];
        }
    }
};

struct Store : Group {
    const double* w;
    double factor;
    float* v;
    HEMOFLUX_FN void operator()(std::size_t g) const {
        for (std::size_t i = first(g); i < last(g); ++i) v[i] = static_cast<float>(factor * w[i]);
    }
};

struct Perturb : Group {
    const double *q, *z;
    double step;
    double* out;
    HEMOFLUX_FN void operator()(std::size_t g) const {
        for (std::size_t i = first(g); i < last(g); ++i) out[i] = q[i] + step * z[i];
    }
};

struct Multiply : Group {
    double* v;
    double factor;
    HEMOFLUX_FN void operator()(std::size_t g) const {
        for (std::size_t i = first(g); i < last(g); ++i) v[i] *= factor;
    }
};

/// Groups of cells; the four components one after the other.
struct DifferenceProduct : Group {
    const double *z, *dt, *moved, *base;
    double inverse_step, scale[4];
    double* w;
    HEMOFLUX_FN void operator()(std::size_t g) const {
        for (std::size_t c = 0; c < 4; ++c)
            for (std::size_t i = first(g); i < last(g); ++i) {
                const std::size_t at = c * n + i;
                w[at] = scale[c] * (z[at] / dt[i] - (moved[at] - base[at]) * inverse_step);
            }
    }
};

struct AddDifference : Group {
    const float* v;
    const double *moved, *base;
    double factor;
    float* out;
    HEMOFLUX_FN void operator()(std::size_t g) const {
        for (std::size_t i = first(g); i < last(g); ++i)
            out[i] = static_cast<float>(static_cast<double>(v[i]) + factor * (moved[i] - base[i]));
    }
};

struct Scaled : Group {
    const double* r;
    double scale[4];
    double* out;
    HEMOFLUX_FN void operator()(std::size_t g) const {
        for (std::size_t c = 0; c < 4; ++c)
            for (std::size_t i = first(g); i < last(g); ++i) out[c * n + i] = scale[c] * r[c * n + i];
    }
};

std::size_t groups(std::size_t n) { return (n + group - 1) / group; }

template <class Kernel>
void each_group(std::size_t n, const Kernel& kernel) {
    exchange::for_each_index(groups(n), kernel, n < 8192 ? exchange::Cost::cheap : exchange::Cost::heavy);
}

}  // namespace

struct KrylovBasis::Sums {
    exchange::Reduction<double> reduction;
};

KrylovBasis::KrylovBasis(std::size_t n, std::size_t most)
    : n_(n), most_(most), basis_(n * (most + 1)), coefficient_(most + 1), sums_(std::make_unique<Sums>()) {}
KrylovBasis::KrylovBasis(KrylovBasis&&) noexcept = default;
KrylovBasis::~KrylovBasis() = default;

void KrylovBasis::store(std::size_t k, const double* w, double factor) {
    each_group(n_, Store{{n_}, w, factor, basis_.data() + k * n_});
}

double KrylovBasis::start(const double* w) {
    const double length = std::sqrt(sum_of_squares(w, n_));
    store(0, w, 1 / length);
    return length;
}

std::vector<double> KrylovBasis::add(std::size_t k, double* w) {
    std::vector<double> h(k + 1, 0.0), part(coefficient_.size());
    for (int sweep = 0; sweep < 2; ++sweep) {
        sums_->reduction.sum_segments(k, groups(n_), Projection{basis_.data(), w, n_}, coefficient_.data());
        each_group(n_, Subtract{{n_}, basis_.data(), coefficient_.data(), k, w});
        exchange::copy_to_host(part.data(), coefficient_.data(), k * sizeof(double));
        for (std::size_t j = 0; j < k; ++j) h[j] += part[j];
    }
    h[k] = std::sqrt(sum_of_squares(w, n_));
    store(k, w, h[k] > 0 ? 1 / h[k] : 0);
    return h;
}

void KrylovBasis::combine(const std::vector<double>& y, float* out) {
    exchange::copy_to_device(coefficient_.data(), y.data(), y.size() * sizeof(double));
    each_group(n_, Combine{{n_}, basis_.data(), coefficient_.data(), y.size(), out});
}

double HessenbergProblem::add(std::vector<double> h) {
    const std::size_t k = column_.size();
    for (std::size_t j = 0; j < k; ++j) {
        const double a = h[j], b = h[j + 1];
        h[j] = cosine_[j] * a + sine_[j] * b;
        h[j + 1] = cosine_[j] * b - sine_[j] * a;
    }
    const double length = std::hypot(h[k], h[k + 1]);
    cosine_.push_back(h[k] / length);
    sine_.push_back(h[k + 1] / length);
    h[k] = length;
    h.pop_back();
    column_.push_back(std::move(h));
    g_.push_back(-sine_[k] * g_[k]);
    g_[k] *= cosine_[k];
    return std::fabs(g_[k + 1]);
}

std::vector<double> HessenbergProblem::solve() const {
    const std::size_t m = column_.size();
    std::vector<double> y(m);
    for (std::size_t i = m; i-- > 0;) {
        double sum = g_[i];
        for (std::size_t j = i + 1; j < m; ++j) sum -= column_[j][i] * y[j];
        y[i] = sum / column_[i][i];
    }
    return y;
}

double sum_of_squares(const double* w, std::size_t n) {
    exchange::Reduction<double> reduction;
    return reduction.sum(groups(n), SquareSum{w, n});
}

void perturb(const double* q, const double* z, double step, double* out, std::size_t n) {
    each_group(n, Perturb{{n}, q, z, step, out});
}

void difference_product(const double* z, const double* dt, const double* moved, const double* base,
                        double step, const double (&scale)[4], std::size_t cells, double* w) {
    each_group(cells,
               DifferenceProduct{
                   {cells}, z, dt, moved, base, 1 / step, {scale[0], scale[1], scale[2], scale[3]}, w});
}

void add_difference(const float* v, const double* moved, const double* base, double factor, float* out,
                    std::size_t n) {
    each_group(n, AddDifference{{n}, v, moved, base, factor, out});
}

void scaled(const double* r, const double (&scale)[4], std::size_t cells, double* out) {
    each_group(cells, Scaled{{cells}, r, {scale[0], scale[1], scale[2], scale[3]}, out});
}

void multiply(double* v, double factor, std::size_t n) { each_group(n, Multiply{{n}, v, factor}); }

}  // namespace hemoflux::fluid
