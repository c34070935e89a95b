/// Vectors of a Krylov space, and the generalised minimal residual method (Saad and Schultz 1986) on them.
///
///   x_m = x_0 + M^-1 V_m y,   y = argmin || beta e_1 - H_m y ||,   A M^-1 V_m = V_(m+1) H_m
///
/// The basis is kept in single precision and made orthogonal by classical Gram-Schmidt in two sweeps; sums are taken in
/// double precision over chunks of a fixed size, so that results do not depend on the number of threads.
#pragma once

#include <cstddef>
#include <memory>
#include <vector>

#include "exchange/buffer.hpp"

namespace hemoflux::fluid {

/// Orthonormal vectors of n values in device memory.
class KrylovBasis {
  public:
    /// Place for most + 1 vectors of n values.
    KrylovBasis(std::size_t n, std::size_t most);
    KrylovBasis(KrylovBasis&&) noexcept;
    ~KrylovBasis();

    /// Vector j.
    [[nodiscard]] const float* vector(std::size_t j) const { return basis_.data() + j * n_; }
    /// Number of the last vector there is place for.
    [[nodiscard]] std::size_t most() const { return most_; }
    /// Device memory of the vectors.
    [[nodiscard]] std::size_t bytes() const { return basis_.size() * sizeof(float); }

    /// Vector 0 <- w / |w|; returns |w|.
    double start(const double* w);
    /// Takes the parts along the vectors 0 .. k-1 out of w (which is overwritten) and makes the rest vector k; returns the
    /// k coefficients and the length of the rest. k must not exceed most().
    std::vector<double> add(std::size_t k, double* w);
    /// out <- sum_j y_j (vector j)
    void combine(const std::vector<double>& y, float* out);

  private:
    void store(std::size_t k, const double* w, double factor);

    std::size_t n_, most_;
    exchange::Buffer<float> basis_;
    exchange::Buffer<double> coefficient_;
    struct Sums;
    std::unique_ptr<Sums> sums_;
};

/// The small least-squares problem of GMRES, kept triangular by Givens rotations.
class HessenbergProblem {
  public:
    /// beta: norm of the residual at the start.
    explicit HessenbergProblem(double beta) : g_{beta} {}
    /// Adds the column (h_0 .. h_k, h_(k+1)); returns the norm of the residual.
    double add(std::vector<double> column);
    /// The coefficients y.
    [[nodiscard]] std::vector<double> solve() const;

  private:
    std::vector<std::vector<double>> column_;
    std::vector<double> cosine_, sine_, g_;
};

/// Sum of the squares of w[0 .. n).
double sum_of_squares(const double* w, std::size_t n);
/// out <- q + step z
void perturb(const double* q, const double* z, double step, double* out, std::size_t n);
/// w <- scale_c [z / dt - (moved - base) / step], component by component: (I/dt - J) z by a difference of residuals.
/// All but dt have 4 cells values.
void difference_product(const double* z, const double* dt, const double* moved, const double* base,
                        double step, const double (&scale)[4], std::size_t cells, double* w);
/// out <- v + factor (moved - base), in single precision
void add_difference(const float* v, const double* moved, const double* base, double factor, float* out,
                    std::size_t n);
/// out <- scale_c r
void scaled(const double* r, const double (&scale)[4], std::size_t cells, double* out);
/// v <- factor v
void multiply(double* v, double factor, std::size_t n);

}  // namespace hemoflux::fluid
