#include "coupling/contact.hpp"

#include <cmath>
#include <string>

#include "exchange/error.hpp"
#include "exchange/parallel.hpp"

namespace hemoflux::coupling {
namespace {

/// What one node meets.
struct Met {
    Vec3d force{0, 0, 0}, wall{0, 0, 0};
    double energy = 0;
    HEMOFLUX_FN Met& operator+=(const Met& b) {
        force += b.force;
        wall += b.wall;
        energy += b.energy;
        return *this;
    }
};

/// Contacts of sorted node s.
struct NodeContact {
    NodeBinsView bins;
    ContactLaw law;
    const double* area;
    std::size_t stride;
    bool walls;

    HEMOFLUX_INLINE double area_of(int s) const {
        return area[static_cast<std::size_t>(bins.node[s]) - static_cast<std::size_t>(bins.cell[s]) * stride];
    }

    struct Meet {
        const NodeContact& c;
        int cell;
        Vec3d at;
        double own_area;
        Met met{};
        HEMOFLUX_INLINE void operator()(int s) {
            bool itself;
            const Vec3d d = c.bins.box.nearest(at, c.bins.position(s), &itself);
            if (itself && c.bins.cell[s] == cell) return;
            const double r2 = dot(d, d);
            if (!(r2 < c.law.reach() * c.law.reach())) return;
            const double areas = own_area * c.area_of(s);
            const ContactPair p = c.law.pair(std::sqrt(r2));
            met.force -= (areas * p.force) * d;
            met.energy += 0.5 * areas * p.energy;  // the other node counts the other half
        }
    };

    HEMOFLUX_FN Met operator()(std::size_t s) const {
        const int i = static_cast<int>(s);
        Meet meet{*this, bins.cell[i], bins.position(i), area_of(i)};
        if (bins.meets[i]) bins.around(meet.at, meet);
        if (walls) add_walls(meet.at, meet.own_area, meet.met);
        return meet.met;
    }

  private:
    HEMOFLUX_INLINE void add_walls(const Vec3d& at, double own_area, Met& met) const {
        const double r[3] = {at.x, at.y, at.z};
        double f[3] = {0, 0, 0};
        for (int q = 0; q < 3; ++q) {
            if (bins.box.periodic[q]) continue;
            const double low = r[q] - bins.box.lower[q], high = bins.box.length[q] - low;
            f[q] = own_area * (law.wall_pressure(low) - law.wall_pressure(high));
            met.energy += own_area * (law.wall_energy(low) + law.wall_energy(high));
        }
        met.force += Vec3d{f[0], f[1], f[2]};
        met.wall -= Vec3d{f[0], f[1], f[2]};
    }
};

struct AddContact {
    NodeContact contact;
    double *fx, *fy, *fz;
    HEMOFLUX_FN void operator()(std::size_t s) const {
        const Vec3d f = contact(s).force;
        const auto i = static_cast<std::size_t>(contact.bins.node[s]);
        fx[i] += f.x;
        fy[i] += f.y;
        fz[i] += f.z;
    }
};

}  // namespace

void ContactOptions::check() const {
    const auto need = [](const char* name, double value, bool zero) {
        if (!(value > 0 || (zero && value == 0)) || std::isinf(value))
            throw InputError(std::string("contact ") + name + " " + std::to_string(value),
                             zero ? "it is a finite number that is not negative" : "it is a positive number",
                             "Correct its value");
    };
    need("pressure", pressure, true);
    need("adhesion", adhesion, true);
    need("range", range, false);
    need("adhesion distance", adhesion_distance, false);
    need("adhesion scale", adhesion_scale, false);
}

std::vector<double> node_areas(const std::vector<std::array<int, 3>>& triangles,
                               const std::vector<double>& areas, std::size_t vertices) {
    std::vector<double> result(vertices, 0.0);
    for (std::size_t t = 0; t < triangles.size(); ++t)
        for (const int v : triangles[t]) result[static_cast<std::size_t>(v)] += areas[t] / 3;
    return result;
}

struct Contact::Scratch {
    exchange::Reduction<Met> reduction;
};

Contact::Contact(const NodeBox& box, const ContactOptions& options, const std::vector<double>& node_areas,
                 std::size_t cells, std::size_t stride)
    : bins_(box, (options.check(), options.reach()), cells, node_areas.size(), stride),
      law_(options),
      walls_(options.walls),
      area_(node_areas),
      stride_(stride),
      scratch_(new Scratch) {}

Contact::~Contact() = default;

void Contact::add_forces(const double* x, const double* y, const double* z, double* fx, double* fy,
                         double* fz) {
    bins_.update(x, y, z);
    const NodeContact contact{bins_.view(), law_, area_.data(), stride_, walls_};
    exchange::for_each_index(bins_.nodes(), AddContact{contact, fx, fy, fz});
}

double Contact::energy() {
    return scratch_->reduction
        .sum(bins_.nodes(), NodeContact{bins_.view(), law_, area_.data(), stride_, walls_})
        .energy;
}

Vec3d Contact::wall_force() {
    return scratch_->reduction
        .sum(bins_.nodes(), NodeContact{bins_.view(), law_, area_.data(), stride_, walls_})
        .wall;
}

}  // namespace hemoflux::coupling
