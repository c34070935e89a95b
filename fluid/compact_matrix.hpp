/// The matrix A = I/dt - dR/dQ of a compact model in blocks of 4 x 4, and its incomplete block LU factors:
/// for every row i and every neighbour k < i,  A_ik <- A_ik A_kk^-1,  A_ij <- A_ij - A_ik A_kj  where A_ij has a place
/// (see fluid/compact_pattern.hpp).
/// Single precision: it is a preconditioner only.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "exchange/buffer.hpp"
#include "fluid/compact_model.hpp"
#include "fluid/compact_pattern.hpp"

namespace hemoflux::fluid {

/// I/dt - J of the compact residual, in blocks of 4 x 4, with its incomplete factors.
class CompactMatrix {
  public:
    /// volume: of the cells. fill: level of fill of the factors; empty: default_fill().
    CompactMatrix(const CompactModel& model, const std::vector<double>& volume,
                  std::optional<std::uint32_t> fill = {});

    /// Assembles A at the state q and factors it. q: [4][cells] conserved variables, dt: [cells], both in device memory.
    void factor(const double* q, const double* dt);

    /// x <- (LU)^-1 S^-1 r with S = diag(scale) over the components; r and x are [4][cells] in device memory.
    void solve(const float* r, const double (&scale)[4], double* x);

    /// Bytes of device memory.
    [[nodiscard]] std::size_t bytes() const { return bytes_; }

  private:
    template <class T>
    exchange::Buffer<T> kept(const std::vector<T>& values) {
        bytes_ += values.size() * sizeof(T);
        return exchange::Buffer<T>(values);
    }
    void set_faces(const CompactModel& model, const CompactPattern& pattern);
    void assemble(const double* q, const double* dt);

    std::size_t cells_, interior_, border_count_, bytes_ = 0;
    double gamma_;
    std::vector<std::uint32_t> level_;
    exchange::Buffer<std::uint32_t> cell_, first_, upper_, column_, reverse_, first_border_;
    exchange::Buffer<std::uint32_t> left_, right_, left_right_, right_left_, border_cell_;
    exchange::Buffer<signed char> border_sign_;
    exchange::Buffer<double> face_, border_face_, border_offset_, volume_;
    exchange::Buffer<float> block_, diagonal_, border_block_, work_;
};

}  // namespace hemoflux::fluid
