#include "apps/cell_observer.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <span>

#include "coupling/cell_motion.hpp"
#include "membrane/diagnostics.hpp"

namespace hemoflux::apps {
namespace {

constexpr double pi = 3.14159265358979323846, degrees = 180 / pi;

/// Slope of y(x) by least squares over the records of the window; NaN with fewer than two.
double slope(const std::vector<double>& x, const std::vector<double>& y) {
    double mx = 0, my = 0, xy = 0, xx = 0;
    const auto n = static_cast<double>(x.size());
    for (std::size_t i = 0; i < x.size(); ++i) mx += x[i] / n, my += y[i] / n;
    for (std::size_t i = 0; i < x.size(); ++i) {
        xy += (x[i] - mx) * (y[i] - my);
        xx += (x[i] - mx) * (x[i] - mx);
    }
    return xx > 0 ? xy / xx : NAN;
}

double mean(const std::vector<double>& y) {
    double sum = 0;
    for (const double v : y) sum += v;
    return y.empty() ? NAN : sum / static_cast<double>(y.size());
}

}  // namespace

const std::vector<std::string>& cell_columns() {
    static const std::vector<std::string> names{"x_um",
                                                "y_um",
                                                "z_um",
                                                "inclination_deg",
                                                "tank_treading_deg",
                                                "taylor_d",
                                                "axial_um",
                                                "transverse_um",
                                                "area_error",
                                                "volume_error",
                                                "energy_aJ",
                                                "deformation_index_pct",
                                                "taylor_d_volume",
                                                "taylor_d_extent",
                                                "deformation_index_ellipse_pct"};
    return names;
}

CellObserver::CellObserver(const membrane::Batch& cells) : cells_(cells.cells()), turned_(cells_, 0.0) {
    for (std::size_t c = 0; c < cells_; ++c) {
        const auto positions = cells.positions(c);
        const auto m = membrane::shape_moments(cells.topology().triangles(), positions);
        volume0_.push_back(m.volume);
        area0_.push_back(m.area);
        start_.insert(start_.end(), {m.centroid.x, m.centroid.y, m.centroid.z});
        for (const Vec3d& p : positions) labels_.push_back(membrane::angle_about(p, m.centroid));
    }
}

std::vector<double> CellObserver::observe(membrane::Batch& cells, double strain) {
    cells.compute_forces();
    std::vector<double> row;
    strain_.push_back(strain);
    for (std::size_t c = 0; c < cells_; ++c) {
        const auto positions = cells.positions(c);
        const auto m = membrane::shape_moments(cells.topology().triangles(), positions);
        const auto diameters = membrane::stretch_diameters(positions, m.centroid);
        if (c == 0) last_ = diameters;
        const double inclination = membrane::inclination(m), taylor = membrane::taylor_deformation(m);
        const double of_volume = membrane::taylor_deformation_volume(m),
                     of_extent = membrane::taylor_deformation_extent(positions, m.centroid);
        const double index = 100 * membrane::minimum_rectangle(positions).deformation_index(),
                     ellipse = 100 * membrane::shadow_ellipse(positions).deformation_index();
        const std::span<const double> labels(labels_.data() + c * positions.size(), positions.size());
        const double angle = membrane::membrane_turn(positions, labels, m.centroid, inclination / degrees);
        turned_[c] += std::remainder(angle - turned_[c], 2 * pi);
        const double area_error = m.area / area0_[c] - 1, volume_error = m.volume / volume0_[c] - 1;
        row.insert(row.end(), {m.centroid.x, m.centroid.y, m.centroid.z, inclination, turned_[c] * degrees,
                               taylor, diameters.axial, diameters.transverse, area_error, volume_error,
                               cells.energies(c).total() * membrane::attojoule_per_unit, index, of_volume,
                               of_extent, ellipse});
        inclination_.push_back(inclination);
        angle_.push_back(turned_[c]);
        taylor_.push_back(taylor);
        taylor_volume_.push_back(of_volume);
        taylor_extent_.push_back(of_extent);
        index_.push_back(index);
        ellipse_.push_back(ellipse);
        const Vec3d start{start_[3 * c], start_[3 * c + 1], start_[3 * c + 2]};
        volume_error_ = std::max(volume_error_, std::abs(volume_error));
        area_error_ = std::max(area_error_, std::abs(area_error));
        centroid_distance_ = std::max(centroid_distance_, norm(m.centroid - start));
    }
    return row;
}

std::vector<double> CellObserver::inclinations(std::size_t cell) const {
    std::vector<double> one;
    for (std::size_t i = 0; i < strain_.size(); ++i) one.push_back(inclination_[i * cells_ + cell]);
    return one;
}

coupling::CellMotion CellObserver::motion(std::size_t cell, double from, double to) const {
    coupling::MotionHistory history{strain_, inclinations(cell), {}};
    for (std::size_t i = 0; i < strain_.size(); ++i)
        history.material_deg.push_back(angle_[i * cells_ + cell] * degrees);
    return coupling::classify(history.window(from, to));
}

std::map<std::string, std::string> CellObserver::modes(double from, double to, bool sheared) const {
    constexpr double half_turn = 15;  // strain units, a slow one; a tank-treading membrane takes about 10
    std::map<std::string, std::string> names;
    for (std::size_t c = 0; c < cells_; ++c) {
        const coupling::MotionMode mode = motion(c, from, to).mode;
        const bool open = sheared && mode == coupling::MotionMode::steady && to - from < half_turn;
        names[cells_ == 1 ? "mode" : fmt::format("{}.mode", c)] =
            open ? "too short to tell" : coupling::name_of(mode);
    }
    return names;
}

std::map<std::string, double> CellObserver::observables(double from, double to) const {
    std::map<std::string, double> sum;
    for (std::size_t c = 0; c < cells_; ++c) {
        std::vector<double> x, inclination, angle, taylor, taylor_volume, taylor_extent, index, ellipse;
        for (std::size_t i = 0; i < strain_.size(); ++i) {
            if (!(strain_[i] >= from - 1e-9 && strain_[i] <= to + 1e-9)) continue;
            x.push_back(strain_[i]);
            inclination.push_back(inclination_[i * cells_ + c]);
            angle.push_back(angle_[i * cells_ + c]);
            taylor.push_back(taylor_[i * cells_ + c]);
            taylor_volume.push_back(taylor_volume_[i * cells_ + c]);
            taylor_extent.push_back(taylor_extent_[i * cells_ + c]);
            index.push_back(index_[i * cells_ + c]);
            ellipse.push_back(ellipse_[i * cells_ + c]);
        }
        std::map<std::string, double> one;
        one["inclination_deg"] = mean(inclination);
        const coupling::CellMotion m = motion(c, from, to);
        one["inclination_amplitude_deg"] = m.amplitude_deg;
        one["flips"] = m.flips;
        one["treads"] = m.treads;
        one["tumbling_period_strain"] = m.tumbling_period;
        one["tank_treading_period_strain"] = m.tank_treading_period;
        one["swing_period_strain"] = m.swing_period;
        one["deformation_index_pct"] = mean(index);
        one["deformation_index_ellipse_pct"] = mean(ellipse);
        one["taylor_d"] = mean(taylor);
        one["taylor_d_volume"] = mean(taylor_volume);
        one["taylor_d_extent"] = mean(taylor_extent);
        one["period_strain"] = m.period();
        // half turns are alike, parts of them are not: a rate is the mean one where no whole half turn was seen
        one["tank_treading_cycles_per_strain"] =
            std::isfinite(m.period()) ? 1 / m.period() : std::abs(slope(x, angle)) / (2 * pi);
        for (const auto& [name, value] : one) sum[name] += value / static_cast<double>(cells_);
    }
    return sum;
}

void CellObserver::save(output::Checkpoint& checkpoint) const {
    checkpoint.put("observer.volume0", volume0_);
    checkpoint.put("observer.area0", area0_);
    checkpoint.put("observer.start", start_);
    checkpoint.put("observer.labels", labels_);
    checkpoint.put("observer.turned", turned_);
    checkpoint.put("observer.worst", {volume_error_, area_error_, centroid_distance_});
    checkpoint.put("observer.strain", strain_);
    checkpoint.put("observer.inclination", inclination_);
    checkpoint.put("observer.angle", angle_);
    checkpoint.put("observer.taylor", taylor_);
    checkpoint.put("observer.taylor_volume", taylor_volume_);
    checkpoint.put("observer.taylor_extent", taylor_extent_);
    checkpoint.put("observer.index", index_);
    checkpoint.put("observer.ellipse", ellipse_);
}

void CellObserver::load(const output::Checkpoint& checkpoint) {
    volume0_ = checkpoint.array("observer.volume0", cells_);
    area0_ = checkpoint.array("observer.area0", cells_);
    start_ = checkpoint.array("observer.start", 3 * cells_);
    labels_ = checkpoint.array("observer.labels", labels_.size());
    turned_ = checkpoint.array("observer.turned", cells_);
    const auto& worst = checkpoint.array("observer.worst", 3);
    volume_error_ = worst[0], area_error_ = worst[1], centroid_distance_ = worst[2];
    strain_ = checkpoint.array("observer.strain");
    inclination_ = checkpoint.array("observer.inclination", strain_.size() * cells_);
    angle_ = checkpoint.array("observer.angle", strain_.size() * cells_);
    taylor_ = checkpoint.array("observer.taylor", strain_.size() * cells_);
    taylor_volume_ = checkpoint.array("observer.taylor_volume", strain_.size() * cells_);
    taylor_extent_ = checkpoint.array("observer.taylor_extent", strain_.size() * cells_);
    index_ = checkpoint.array("observer.index", strain_.size() * cells_);
    ellipse_ = checkpoint.array("observer.ellipse", strain_.size() * cells_);
}

}  // namespace hemoflux::apps
