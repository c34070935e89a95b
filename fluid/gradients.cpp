// The rectilinear solver's gradients, and the stresses on its sides.
#include <cmath>

#include "exchange/error.hpp"
#include "fluid/host_fields.hpp"
#include "fluid/solver.hpp"

namespace hemoflux::fluid {
namespace {

constexpr auto ghosts = static_cast<std::ptrdiff_t>(exchange::ghosts);

/// Three-point derivatives on one axis, see grid.hpp.
class Derivative {
  public:
    Derivative(const std::vector<double>& widths, GradientMethod method) : widths_(widths), method_(method) {}

    /// f(m): value in cell m; derivative at the centre of cell i.
    template <class F>
    double operator()(std::ptrdiff_t i, const F& f) const {
        const double minus = (width(i - 1) + width(i)) / 2, plus = (width(i) + width(i + 1)) / 2;
        const double forward = (f(i + 1) - f(i)) / plus, backward = (f(i) - f(i - 1)) / minus;
        if (method_ == GradientMethod::least_squares)
            return (minus * forward + plus * backward) / (plus + minus);
        return (forward + backward) / 2;
    }
    [[nodiscard]] double width(std::ptrdiff_t i) const {
        return widths_[static_cast<std::size_t>(i + ghosts)];
    }

  private:
    const std::vector<double>& widths_;
    GradientMethod method_;
};

/// Derivative at x = 0 of the quadratic through (0, f0), (a, fa), (b, fb).
double slope(double f0, double a, double fa, double b, double fb) {
    return (b * b * (fa - f0) - a * a * (fb - f0)) / (a * b * (b - a));
}

/// Value at x = 0 of the polynomial through up to three points (x[m], f[m]).
double extrapolate(const double (&x)[3], const double (&f)[3], std::size_t count) {
    double sum = 0;
    for (std::size_t a = 0; a < count; ++a) {
        double weight = 1;
        for (std::size_t b = 0; b < count; ++b)
            if (b != a) weight *= x[b] / (x[b] - x[a]);
        sum += weight * f[a];
    }
    return sum;
}

/// The cells of one side and what stands before it.
struct SideView {
    const HostFields& fields;
    std::size_t normal, t1, t2;
    std::ptrdiff_t n;
    bool upper;

    /// Value of a field in the m-th cell from the side, m = -1 the ghost cell, at (a, b) along the side.
    [[nodiscard]] double cell(std::size_t field, std::ptrdiff_t m, std::ptrdiff_t a, std::ptrdiff_t b) const {
        std::ptrdiff_t ijk[3];
        ijk[normal] = upper ? n - 1 - m : m;
        ijk[t1] = a, ijk[t2] = b;
        return fields.at(field, ijk[0], ijk[1], ijk[2]);
    }
    /// Value on the side itself.
    [[nodiscard]] double face(std::size_t field, std::ptrdiff_t a, std::ptrdiff_t b) const {
        return (cell(field, -1, a, b) + cell(field, 0, a, b)) / 2;
    }
};

std::size_t side_number(const std::vector<std::string>& names, const std::string& patch) {
    for (std::size_t p = 0; p < names.size(); ++p)
        if (names[p] == patch) return p;
    throw InputError("patch \"" + patch + "\"", "the box has the sides x-, x+, y-, y+, z- and z+",
                     "name one of them");
}

}  // namespace

std::vector<std::array<Vec3d, 4>> Solver::gradients() const {
    const HostFields fields = host_fields(*this);
    const GradientMethod method = options_.gradient;
    const Derivative dx(grid_.ghosted_widths(0), method), dy(grid_.ghosted_widths(1), method),
        dz(grid_.ghosted_widths(2), method);
    const auto n = [&](int a) { return static_cast<std::ptrdiff_t>(fields.layout.n[a]); };
    std::vector<std::array<Vec3d, 4>> gradients;
    gradients.reserve(fields.layout.cells());
    for (std::ptrdiff_t k = 0; k < n(2); ++k)
        for (std::ptrdiff_t j = 0; j < n(1); ++j)
            for (std::ptrdiff_t i = 0; i < n(0); ++i) {
                auto& gradient = gradients.emplace_back();
                for (std::size_t q = 0; q < 4; ++q)
                    gradient[q] = {dx(i, [&](std::ptrdiff_t m) { return fields.at(q, m, j, k); }),
                                   dy(j, [&](std::ptrdiff_t m) { return fields.at(q, i, m, k); }),
                                   dz(k, [&](std::ptrdiff_t m) { return fields.at(q, i, j, m); })};
            }
    return gradients;
}

std::vector<WallFace> Solver::wall_faces(const std::string& patch) const {
    const std::size_t p = side_number(patches(), patch), normal = p / 2;
    if (grid_.periodic()[normal])
        throw InputError("patch \"" + patch + "\"", "it is periodic, so nothing lies behind it",
                         "name a wall");
    const HostFields fields = host_fields(*this);
    const SideView side{fields,
                        normal,
                        normal == 0 ? 1u : 0u,
                        normal == 2 ? 1u : 2u,
                        static_cast<std::ptrdiff_t>(fields.layout.n[normal]),
                        p % 2 == 1};
    const auto derivative = [this](std::size_t axis) {
        return Derivative(grid_.ghosted_widths(static_cast<int>(axis)), GradientMethod::least_squares);
    };
    const Derivative dn = derivative(normal), d1 = derivative(side.t1), d2 = derivative(side.t2);
    const std::vector<double> c1 = ghosted_centres(grid_, side.t1), c2 = ghosted_centres(grid_, side.t2);
    const meshing::Axis& axis = grid_.rectilinear().axes[normal];
    // distances of the first cells from the side
    double x[3];
    const std::size_t count = std::min<std::size_t>(3, axis.cells());
    double reach = 0;
    for (std::size_t m = 0; m < count; ++m) {
        const auto i = static_cast<std::ptrdiff_t>(m);
        const double width = dn.width(side.upper ? side.n - 1 - i : i);
        x[m] = reach + width / 2;
        reach += width;
    }
    const double out = side.upper ? 1 : -1, mu = options_.nu;
    std::vector<WallFace> faces;
    for (std::ptrdiff_t b = 0; b < static_cast<std::ptrdiff_t>(fields.layout.n[side.t2]); ++b)
        for (std::ptrdiff_t a = 0; a < static_cast<std::ptrdiff_t>(fields.layout.n[side.t1]); ++a) {
            double density[3];
            for (std::size_t m = 0; m < count; ++m)
                density[m] = side.cell(0, static_cast<std::ptrdiff_t>(m), a, b);
            const double pressure = options_.gamma / 3 * (extrapolate(x, density, count) - 1);
            double gradient[3][3];  // [component][direction]
            for (std::size_t c = 0; c < 3; ++c) {
                const double wall = side.face(1 + c, a, b), first = side.cell(1 + c, 0, a, b);
                // along the inward normal
                gradient[c][normal] =
                    -out * (count > 1 ? slope(wall, x[0], first, x[1], side.cell(1 + c, 1, a, b))
                                      : (first - wall) / x[0]);
                gradient[c][side.t1] = d1(a, [&](std::ptrdiff_t m) { return side.face(1 + c, m, b); });
                gradient[c][side.t2] = d2(b, [&](std::ptrdiff_t m) { return side.face(1 + c, a, m); });
            }
            const double area = d1.width(a) * d2.width(b);
            double centre[3], n[3] = {0, 0, 0}, traction[3];
            centre[normal] = side.upper ? axis.upper() : axis.lower();
            centre[side.t1] = c1[static_cast<std::size_t>(a + ghosts)];
            centre[side.t2] = c2[static_cast<std::size_t>(b + ghosts)];
            n[normal] = out;
            for (std::size_t c = 0; c < 3; ++c)
                traction[c] = -mu * out * (gradient[c][normal] + gradient[normal][c]);
            const Vec3d outward{area * n[0], area * n[1], area * n[2]};
            faces.push_back({{centre[0], centre[1], centre[2]},
                             outward,
                             pressure * outward,
                             {area * traction[0], area * traction[1], area * traction[2]}});
        }
    return faces;
}

}  // namespace hemoflux::fluid
