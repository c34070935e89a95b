// The band of hexahedra around the membranes, and which of them lie inside.
//
// d/h as in signed_distance.hpp, with h of the hexahedron itself: local_cells times the longest of the vectors between its
// opposite faces. The sign is the winding number along x from the cell's centre onwards, in the same exact arithmetic.
// Triangles are sorted into columns along x; a cell looks at the triangles of its own column only.
#include <algorithm>
#include <cmath>

#include "coupling/band_triangle.hpp"
#include "coupling/hex_cells.hpp"
#include "coupling/viscosity.hpp"
#include "exchange/memory.hpp"
#include "exchange/parallel.hpp"

namespace hemoflux::coupling {
namespace {

/// One membrane as the cells of one period of the grid meet it: shift is added to a cell's centre. Bounds of the band
/// around it; its columns are n[0] x n[1] rectangles of the yz plane, whose lists begin at start[column].
struct BandImage {
    std::uint32_t membrane = 0;
    Vec3d shift{0, 0, 0}, low{0, 0, 0}, high{0, 0, 0};
    int n[2] = {1, 1};
    double per_y = 0, per_z = 0;
    std::uint32_t first_column = 0;
};

struct BandView {
    const BandImage* image;
    std::size_t images;
    const std::uint32_t *start, *listed;
    const BandTriangle* triangle;
    double lattice;

    /// d/h of a cell at x, positive inside, limited to [-1, 1].
    HEMOFLUX_INLINE double distance(const BandImage& m, const Vec3d& x, double half_width) const {
        if (x.x < m.low.x || x.y < m.low.y || x.z < m.low.z || x.x > m.high.x || x.y > m.high.y ||
            x.z > m.high.z)
            return -1;
        const int j = static_cast<int>((x.y - m.low.y) * m.per_y),
                  k = static_cast<int>((x.z - m.low.z) * m.per_z);
        const int jn = j < m.n[0] ? j : m.n[0] - 1, kn = k < m.n[1] ? k : m.n[1] - 1;
        const std::size_t column = m.first_column + static_cast<std::size_t>(kn * m.n[0] + jn);
        const double y = std::floor(x.y * lattice + 0.5), z = std::floor(x.z * lattice + 0.5);
        double nearest = half_width * half_width;
        int winding = 0;
        for (std::uint32_t i = start[column]; i < start[column + 1]; ++i) {
            const BandTriangle& t = triangle[listed[i]];
            double crossing;
            const int sign = row_crossing(t, y, z, &crossing);
            if (sign != 0 && crossing > x.x) winding -= sign;
            const RowTerms terms(t, x.y, x.z);
            if (terms.far(t, x.x, x.x)) continue;
            const double d2 = squared_distance(t, terms, x.x);
            if (d2 < nearest) nearest = d2;
        }
        const double ratio = std::sqrt(nearest) / half_width;
        return winding > 0 ? ratio : -ratio;
    }
};

/// Viscosity of one cell: all membranes in turn.
struct HexViscosity {
    BandView band;
    BandViscosity v;
    const Vec3d* centre;
    const double* half_width;
    std::size_t stride;
    double* nu;
    HEMOFLUX_FN void operator()(std::size_t c) const {
        double sum = v.nu_outside, membrane = 0;
        for (std::size_t i = 0; i < band.images; ++i) {
            const BandImage& m = band.image[i];
            const double ratio = band.distance(m, centre[c] + m.shift, half_width[c]);
            sum += (v.nu_inside[m.membrane] - v.nu_outside) * heaviside(ratio);
            sum = sum < v.low ? v.low : sum > v.high ? v.high : sum;
            membrane += v.surface_nu * heaviside_slope(ratio) / half_width[c];
        }
        nu[stride * c] = sum + membrane;
    }
};

class HexBand final : public MembraneBand {
  public:
    HexBand(const HexCells& cells, const BandSurfaces& s, HalfWidth half_width)
        : cells_(cells),
          triangles_(s.triangles),
          vertices_(s.vertices),
          membranes_(s.cells),
          lattice_(inside_test_lattice(cells.smallest())),
          band_triangles_(s.cells * s.triangles.size()) {
        std::vector<double> widths;
        for (std::uint32_t c = 0; c < cells.field_size(); ++c) {
            double longest = 0;
            for (const Vec3d& side : cells.sides(c)) longest = std::max(longest, norm(side));
            widths.push_back(half_width.fixed > 0 ? half_width.fixed : half_width.local_cells * longest);
        }
        const auto [least, most] = std::minmax_element(widths.begin(), widths.end());
        widest_ = *most;
        cell_half_width_ = exchange::Buffer<double>(widths);
        // the narrowest band anywhere: how far a node may move
        node_half_width_ = exchange::Buffer<double>(std::vector<double>(vertices_ * membranes_, *least));
        for (const Vec3d& r : cells.grid().nodes) include(low_, high_, r);
    }

    void prepare(const double* x, const double* y, const double* z, const std::vector<int>& moved) override;
    void viscosity(const BandViscosity& v, double* nu, std::size_t stride) override {
        const BandView band{image_.data(),  image_.size(),          start_.data(),
                            listed_.data(), band_triangles_.data(), lattice_};
        exchange::for_each_index(cells_.field_size(), HexViscosity{band, v, cells_.walk().centre,
                                                                   cell_half_width_.data(), stride, nu});
    }
    [[nodiscard]] const BandTriangle* triangles() const override { return band_triangles_.data(); }
    [[nodiscard]] const double* half_widths() const override { return node_half_width_.data(); }

  private:
    static void include(Vec3d& low, Vec3d& high, const Vec3d& r) {
        low = {std::min(low.x, r.x), std::min(low.y, r.y), std::min(low.z, r.z)};
        high = {std::max(high.x, r.x), std::max(high.y, r.y), std::max(high.z, r.z)};
    }
    /// Sorts the triangles of a membrane, from `first` on, into the columns of its band.
    void add_columns(BandImage& image, const std::vector<BandTriangle>& triangles, std::size_t first);
    /// The whole shifts that bring the grid to a membrane.
    [[nodiscard]] std::vector<Vec3d> shifts_to(const Vec3d& low, const Vec3d& high) const;

    const HexCells& cells_;
    std::vector<std::array<int, 3>> triangles_;
    std::size_t vertices_, membranes_;
    double lattice_, widest_ = 0;
    Vec3d low_{1e300, 1e300, 1e300}, high_{-1e300, -1e300, -1e300};
    std::vector<std::uint32_t> host_start_, host_listed_;
    exchange::Buffer<double> cell_half_width_, node_half_width_;
    exchange::Buffer<BandTriangle> band_triangles_;
    exchange::Buffer<BandImage> image_;
    exchange::Buffer<std::uint32_t> start_, listed_;
};

std::vector<Vec3d> HexBand::shifts_to(const Vec3d& low, const Vec3d& high) const {
    std::vector<Vec3d> shifts{{0, 0, 0}};
    for (const Vec3d& period : cells_.walk().period) {
        const double length2 = dot(period, period);
        if (!(length2 > 0)) continue;
        // shifts of a box [low_, high_] along the period that may meet [low, high]
        const Vec3d middle = 0.5 * (low + high) - 0.5 * (low_ + high_),
                    half = 0.5 * (high - low) + 0.5 * (high_ - low_);
        const double at = dot(middle, period) / length2,
                     reach = (std::abs(half.x * period.x) + std::abs(half.y * period.y) +
                              std::abs(half.z * period.z)) /
                             length2;
        std::vector<Vec3d> all;
        for (const Vec3d& s : shifts)
            for (double k = std::ceil(at - reach); k <= std::floor(at + reach); ++k)
                all.push_back(s + k * period);
        shifts = std::move(all);
    }
    return shifts;
}

void HexBand::add_columns(BandImage& image, const std::vector<BandTriangle>& triangles, std::size_t first) {
    const double length[2] = {image.high.y - image.low.y, image.high.z - image.low.z};
    for (std::size_t a = 0; a < 2; ++a)
        image.n[a] = static_cast<int>(std::clamp(std::floor(length[a] / (0.5 * widest_)), 1.0, 256.0));
    image.per_y = image.n[0] / length[0];
    image.per_z = image.n[1] / length[1];
    image.first_column = static_cast<std::uint32_t>(host_start_.size());
    std::vector<std::vector<std::uint32_t>> columns(static_cast<std::size_t>(image.n[0] * image.n[1]));
    const auto column = [](double at, double low, double per, int n) {
        return static_cast<std::size_t>(std::clamp(static_cast<int>(std::floor((at - low) * per)), 0, n - 1));
    };
    for (std::size_t t = first; t < first + triangles_.size(); ++t) {
        const BandTriangle& b = triangles[t];
        const double y0 = b.y_low / lattice_ - widest_, y1 = b.y_high / lattice_ + widest_,
                     z0 = b.z_low / lattice_ - widest_, z1 = b.z_high / lattice_ + widest_;
        for (std::size_t k = column(z0, image.low.z, image.per_z, image.n[1]);
             k <= column(z1, image.low.z, image.per_z, image.n[1]); ++k)
            for (std::size_t j = column(y0, image.low.y, image.per_y, image.n[0]);
                 j <= column(y1, image.low.y, image.per_y, image.n[0]); ++j)
                columns[k * static_cast<std::size_t>(image.n[0]) + j].push_back(
                    static_cast<std::uint32_t>(t));
    }
    for (const auto& list : columns) {
        host_start_.push_back(static_cast<std::uint32_t>(host_listed_.size()));
        host_listed_.insert(host_listed_.end(), list.begin(), list.end());
    }
    // the end of the last column; the next membrane's first column comes behind it
    host_start_.push_back(static_cast<std::uint32_t>(host_listed_.size()));
}

void HexBand::prepare(const double* x, const double* y, const double* z,
                      const std::vector<int>& /*moved: the columns are those of all*/) {
    const double* from[3] = {x, y, z};
    std::vector<double> r[3];
    for (std::size_t q = 0; q < 3; ++q) {
        r[q].resize(vertices_ * membranes_);
        exchange::copy_to_host(r[q].data(), from[q], r[q].size() * sizeof(double));
    }
    std::vector<BandTriangle> all;
    std::vector<BandImage> images;
    host_start_.clear();
    host_listed_.clear();
    for (std::uint32_t m = 0; m < membranes_; ++m) {
        BandImage image;
        image.membrane = m;
        image.low = {1e300, 1e300, 1e300};
        image.high = -image.low;
        const std::size_t first = all.size();
        for (const auto& t : triangles_) {
            Vec3d p[3];
            for (std::size_t k = 0; k < 3; ++k) {
                const std::size_t v = m * vertices_ + static_cast<std::size_t>(t[k]);
                p[k] = {r[0][v], r[1][v], r[2][v]};
                include(image.low, image.high, p[k]);
            }
            all.push_back(band_triangle(p[0], p[1], p[2], widest_, lattice_));
        }
        const Vec3d margin{widest_, widest_, widest_};
        image.low -= margin;
        image.high += margin;
        add_columns(image, all, first);
        for (const Vec3d& shift : shifts_to(image.low, image.high)) {
            image.shift = shift;
            images.push_back(image);
        }
    }
    band_triangles_.assign(all);
    image_ = exchange::Buffer<BandImage>(images);
    start_ = exchange::Buffer<std::uint32_t>(host_start_);
    listed_ = exchange::Buffer<std::uint32_t>(host_listed_);
}

}  // namespace

std::unique_ptr<MembraneBand> HexCells::band(const BandSurfaces& surfaces, HalfWidth half_width) const {
    return std::make_unique<HexBand>(*this, surfaces, half_width);
}

}  // namespace hemoflux::coupling
