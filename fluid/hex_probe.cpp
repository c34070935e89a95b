#include "fluid/hex_probe.hpp"

#include <Eigen/Dense>
#include <algorithm>

#include "fluid/hex_solver.hpp"
#include "fluid/probe.hpp"

namespace hemoflux::fluid {
namespace {

constexpr std::uint32_t none = ~std::uint32_t{0};
/// Weight of a point at no distance: values at cell centres and on walls are met to this share of the misfit.
constexpr double eps = 1e-4;

Eigen::Vector3d eigen(const Vec3d& v) { return {v.x, v.y, v.z}; }

/// The directions in which a grid is more than one cell thick around a cell, scaled by its size there.
Eigen::Matrix<double, Eigen::Dynamic, 3> frame_of(const std::vector<Eigen::Vector3d>& neighbours) {
    Eigen::Matrix3d spread = Eigen::Matrix3d::Zero();
    for (const auto& d : neighbours) spread += d * d.transpose();
    spread /= static_cast<double>(neighbours.size());
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> axes(spread);
    Eigen::Matrix<double, Eigen::Dynamic, 3> frame(0, 3);
    for (int a = 0; a < 3; ++a) {
        const double length2 = axes.eigenvalues()[a];
        if (length2 < 1e-10 * axes.eigenvalues()[2]) continue;
        frame.conservativeResize(frame.rows() + 1, 3);
        frame.row(frame.rows() - 1) = axes.eigenvectors().col(a).transpose() / std::sqrt(length2);
    }
    return frame;
}

/// 1, d_a, d_a d_b: all of them up to second order.
Eigen::RowVectorXd monomials(const Eigen::VectorXd& d) {
    const Eigen::Index n = d.size();
    Eigen::RowVectorXd row(1 + n + n * (n + 1) / 2);
    row[0] = 1;
    Eigen::Index at = 1;
    for (Eigen::Index a = 0; a < n; ++a) row[at++] = d[a];
    for (Eigen::Index a = 0; a < n; ++a)
        for (Eigen::Index b = a; b < n; ++b) row[at++] = d[a] * d[b];
    return row;
}

}  // namespace

HexInterpolant::HexInterpolant(const meshing::HexGrid& grid, std::size_t fields, std::vector<double> cell,
                               BorderValues border)
    : grid_(grid),
      fields_(fields),
      cell_(std::move(cell)),
      border_(std::move(border)),
      known_(grid.border_faces(), none),
      nearest_(grid.centre) {
    for (std::size_t i = 0; i < border_.face.size(); ++i)
        known_[border_.face[i] - grid.interior_faces()] = static_cast<std::uint32_t>(i);
}

std::vector<std::uint32_t> HexInterpolant::stencil(std::uint32_t cell) const {
    std::vector<std::uint32_t> cells{cell};
    const auto add_neighbours = [&](std::uint32_t c) {
        for (std::uint32_t i = grid_.first_face[c]; i < grid_.first_face[c + 1]; ++i) {
            const std::uint32_t f = grid_.face[i];
            if (f >= grid_.interior_faces()) continue;
            const std::uint32_t other = grid_.left[f] == c ? grid_.right[f] : grid_.left[f];
            // across a periodic pair the neighbour's centre is elsewhere
            const bool glued = !grid_.shift.empty() && norm(grid_.shift[f]) > 0;
            if (!glued && std::find(cells.begin(), cells.end(), other) == cells.end()) cells.push_back(other);
        }
    };
    add_neighbours(cell);
    const std::size_t ring = cells.size();
    for (std::size_t i = 1; i < ring; ++i) add_neighbours(cells[i]);
    return cells;
}

void HexInterpolant::operator()(const Vec3d& at, double* values) const {
    const auto nearest = static_cast<std::uint32_t>(nearest_(at));
    const auto cells = stencil(nearest);
    std::vector<Eigen::Vector3d> away, around;
    std::vector<const double*> value;
    for (const std::uint32_t c : cells) {
        away.push_back(eigen(grid_.centre[c] - at));
        value.push_back(&cell_[c * fields_]);
        if (c != nearest) around.push_back(eigen(grid_.centre[c] - grid_.centre[nearest]));
    }
    for (const std::uint32_t c : cells)
        for (std::uint32_t i = grid_.first_face[c]; i < grid_.first_face[c + 1]; ++i) {
            const std::uint32_t f = grid_.face[i];
            if (f < grid_.interior_faces()) continue;
            const std::uint32_t known = known_[f - grid_.interior_faces()];
            if (known == none) continue;
            away.push_back(eigen(grid_.face_centre[f] - at));
            value.push_back(&border_.value[known * fields_]);
        }
    if (around.empty()) {
        std::copy_n(value.front(), fields_, values);
        return;
    }
    const auto frame = frame_of(around);
    const auto points = static_cast<Eigen::Index>(away.size());
    const Eigen::Index n = frame.rows();
    Eigen::MatrixXd a(points, 1 + n + n * (n + 1) / 2), b(points, static_cast<Eigen::Index>(fields_));
    for (Eigen::Index p = 0; p < points; ++p) {
        const Eigen::VectorXd d = frame * away[static_cast<std::size_t>(p)];
        const double weight = 1 / std::sqrt(d.squaredNorm() + eps);
        a.row(p) = weight * monomials(d);
        for (std::size_t f = 0; f < fields_; ++f)
            b(p, static_cast<Eigen::Index>(f)) = weight * value[static_cast<std::size_t>(p)][f];
    }
    // least norm where the points do not determine the quadratic
    const Eigen::MatrixXd c = a.completeOrthogonalDecomposition().solve(b);
    for (std::size_t f = 0; f < fields_; ++f) values[f] = c(0, static_cast<Eigen::Index>(f));
}

namespace {

/// Density and velocity apart, as they are given on different faces.
class HexProbe final : public Probe {
  public:
    explicit HexProbe(const HexSolver& solver)
        : density_(solver.grid(), 1, solver.values(0), given_density(solver)),
          velocity_(solver.grid(), 3, velocities(solver), given_velocity(solver)) {}

    [[nodiscard]] std::array<double, 4> operator()(const Vec3d& at) const override {
        std::array<double, 4> q{};
        density_(at, q.data());
        velocity_(at, q.data() + 1);
        return q;
    }

  private:
    static std::vector<double> velocities(const HexSolver& solver) {
        const std::vector<double> u = solver.values(1), v = solver.values(2), w = solver.values(3);
        std::vector<double> all;
        for (std::size_t c = 0; c < u.size(); ++c) all.insert(all.end(), {u[c], v[c], w[c]});
        return all;
    }
    template <class Given, class Append>
    static BorderValues border(const HexSolver& solver, const Given& given, const Append& append) {
        BorderValues values;
        for (const auto& range : solver.grid().patches) {
            const Patch& patch = solver.boundary().patches().at(range.name);
            if (!given(patch)) continue;
            for (std::size_t f = range.first; f < range.first + range.count; ++f) {
                values.face.push_back(static_cast<std::uint32_t>(f));
                append(patch, solver.grid().face_centre[f], values.value);
            }
        }
        return values;
    }
    static BorderValues given_density(const HexSolver& solver) {
        return border(
            solver, [](const Patch& p) { return p.density == DensityCondition::given; },
            [&](const Patch& p, const Vec3d& x, auto& out) {
                out.push_back(p.density_at(x, solver.time()));
            });
    }
    static BorderValues given_velocity(const HexSolver& solver) {
        return border(
            solver, [](const Patch& p) { return p.velocity == VelocityCondition::given; },
            [&](const Patch& p, const Vec3d& x, auto& out) {
                const Vec3d u = p.velocity_at(x, solver.time());
                out.insert(out.end(), {u.x, u.y, u.z});
            });
    }

    HexInterpolant density_, velocity_;
};

}  // namespace

std::unique_ptr<Probe> make_probe(const HexSolver& solver) { return std::make_unique<HexProbe>(solver); }

}  // namespace hemoflux::fluid
