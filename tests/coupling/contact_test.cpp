#include "coupling/contact.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "exchange/backend.hpp"
#include "exchange/error.hpp"

namespace hemoflux::coupling {
namespace {

/// Cells as sets of nodes on the device, with forces.
struct Cells {
    std::size_t cells, vertices, stride;
    std::vector<Vec3d> at;
    exchange::Buffer<double> x, y, z, fx, fy, fz;

    Cells(const std::vector<std::vector<Vec3d>>& shapes, std::size_t padding = 3)
        : cells(shapes.size()), vertices(shapes.front().size()), stride(vertices + padding) {
        for (const auto& shape : shapes) {
            at.insert(at.end(), shape.begin(), shape.end());
            at.insert(at.end(), padding, shape.front());
        }
        load();
    }
    void load() {
        std::vector<double> a, b, c;
        for (const Vec3d& r : at) a.push_back(r.x), b.push_back(r.y), c.push_back(r.z);
        x = exchange::Buffer<double>(a), y = exchange::Buffer<double>(b), z = exchange::Buffer<double>(c);
        fx = exchange::Buffer<double>(at.size());
        fy = exchange::Buffer<double>(at.size());
        fz = exchange::Buffer<double>(at.size());
    }
    std::vector<Vec3d> forces(Contact& contact) {
        load();
        contact.add_forces(x.data(), y.data(), z.data(), fx.data(), fy.data(), fz.data());
        const auto a = fx.to_host(), b = fy.to_host(), c = fz.to_host();
        std::vector<Vec3d> f;
        for (std::size_t i = 0; i < a.size(); ++i) f.push_back({a[i], b[i], c[i]});
        return f;
    }
};

/// Clouds of nodes that reach into each other, across the sides of a periodic box and far beyond it.
std::vector<std::vector<Vec3d>> clouds(std::size_t cells, std::size_t nodes) {
    std::mt19937 random(5);
    std::uniform_real_distribution<double> centre(-2, 2), within(-1.5, 1.5);
    std::uniform_int_distribution<int> turns(-2, 2);
    std::vector<std::vector<Vec3d>> shapes(cells);
    for (auto& shape : shapes) {
        const Vec3d c{centre(random) + 5 * turns(random), centre(random), centre(random) + 4 * turns(random)};
        for (std::size_t v = 0; v < nodes; ++v)
            shape.push_back(c + Vec3d{within(random), within(random), within(random)});
    }
    return shapes;
}

NodeBox box() { return {{-2.5, -4, -2}, {5, 8, 4}, {true, false, true}}; }

ContactOptions both() {
    return {.pressure = 2, .range = 0.6, .adhesion = 0.3, .adhesion_distance = 0.5, .adhesion_scale = 8};
}

std::vector<double> uneven_areas(std::size_t n) {
    std::vector<double> areas;
    for (std::size_t i = 0; i < n; ++i) areas.push_back(0.1 + 0.01 * static_cast<double>(i % 7));
    return areas;
}

/// Contact forces against the sum over all pairs of nodes; returns how many pairs are within reach.
std::size_t compare_with_all_pairs(Cells& cells, std::size_t vertices, const NodeBox& b) {
    const auto areas = uneven_areas(vertices);
    Contact contact(b, both(), areas, cells.cells, cells.stride);
    const auto forces = cells.forces(contact);
    const ContactLaw law(both());
    const auto nearest = [](double d, double length, bool periodic) {
        return periodic ? d - length * std::round(d / length) : d;
    };
    std::size_t met = 0;
    for (std::size_t i = 0; i < cells.at.size(); ++i) {
        if (i % cells.stride >= vertices) {
            EXPECT_EQ(norm(forces[i]), 0);
            continue;
        }
        Vec3d f{0, 0, 0};
        for (std::size_t j = 0; j < cells.at.size(); ++j) {
            if (j % cells.stride >= vertices || i == j) continue;
            const Vec3d straight = cells.at[j] - cells.at[i];
            const Vec3d d{nearest(straight.x, b.length[0], b.periodic[0]),
                          nearest(straight.y, b.length[1], b.periodic[1]),
                          nearest(straight.z, b.length[2], b.periodic[2])};
            if (j / cells.stride == i / cells.stride && norm(d - straight) < 1e-9) continue;
            if (!(norm(d) < law.reach())) continue;
            ++met;
            f -= areas[i % cells.stride] * areas[j % cells.stride] * law.pair(norm(d)).force * d;
        }
        const double low = cells.at[i].y - b.lower[1], high = b.length[1] - low;
        if (!b.periodic[1])
            f.y += areas[i % cells.stride] * (law.wall_pressure(low) - law.wall_pressure(high));
        EXPECT_LT(norm(forces[i] - f), 1e-12 * (1 + norm(f))) << i;
    }
    return met;
}

}  // namespace

TEST(ContactLaw, ForceIsTheSlopeOfTheEnergyAndEndsSmoothly) {
    const ContactLaw law(both());
    for (const double r : {0.05, 0.3, 0.45, 0.55, 0.7, 0.8, 0.95}) {
        constexpr double h = 1e-6;
        const double slope = (law.pair(r + h).energy - law.pair(r - h).energy) / (2 * h);
        EXPECT_NEAR(law.pair(r).force, -slope / r, 1e-7 * (1 + std::abs(slope / r))) << r;
    }
    EXPECT_DOUBLE_EQ(law.reach(), 1.0);
    EXPECT_NEAR(law.pair(1 - 1e-9).energy, 0, 1e-12);
    EXPECT_NEAR(law.pair(1 - 1e-9).force, 0, 1e-6);
}

TEST(ContactLaw, WallEnergyIsTheIntegralOfThePressure) {
    const ContactLaw law(both());
    for (const double d : {-0.1, 0.1, 0.5}) {
        constexpr double h = 1e-6;
        EXPECT_NEAR(law.wall_pressure(d), -(law.wall_energy(d + h) - law.wall_energy(d - h)) / (2 * h), 1e-8);
    }
    EXPECT_EQ(law.wall_pressure(0.7), 0);
}

TEST(Contact, IsTheSumOverAllPairsOfNearestImages) {
    Cells cells(clouds(4, 40));
    EXPECT_GT(compare_with_all_pairs(cells, 40, box()), 100u);
}

// Nodes with only their own cell around them are left out: not so where a cell comes round to itself, nor across sides.
TEST(Contact, CellsMeetAcrossSidesAndTheirOwnImages) {
    const auto line = [](const Vec3d& from, const Vec3d& step) {
        std::vector<Vec3d> nodes;
        for (int i = 0; i < 40; ++i) nodes.push_back(from + static_cast<double>(i) * step);
        return nodes;
    };
    const NodeBox wide{{0, 0, 0}, {12, 12, 12}, {true, true, true}};
    Cells cells({line({24.1, 6, 6}, {0.3, 0, 0}),       // 11.7 long: its ends meet
                 line({3, 3, 11.9}, {0, 0.05, 0.01}),   // begins in one image, ends in the next
                 line({3.4, 15, -12.1}, {0, 0.05, 0}),  // beside it, one period further in y and two in z
                 line({6, 9, 1}, {0, 0, 0.05}),         // alone
                 line({5, 1, 9}, {0.4, 0.01, 0.01})});  // 15.6 long: lies beside itself
    EXPECT_GT(compare_with_all_pairs(cells, 40, wide), 100u);
}

TEST(Contact, ForcesBalanceToRounding) {
    Cells cells(clouds(5, 60));
    Contact contact(box(), both(), uneven_areas(60), cells.cells, cells.stride);
    Vec3d sum{0, 0, 0};
    double size = 0;
    for (const Vec3d& f : cells.forces(contact)) sum += f, size += norm(f);
    EXPECT_GT(size, 1);
    EXPECT_LT(norm(sum + contact.wall_force()), 1e-12 * size);
}

TEST(Contact, ForcesAreTheGradientOfTheEnergy) {
    Cells cells(clouds(3, 30));
    for (Vec3d& r : cells.at) r.y *= 1.8;  // some nodes near and beyond the walls
    Contact contact(box(), both(), uneven_areas(30), cells.cells, cells.stride);
    const auto forces = cells.forces(contact);
    const double scale = 1e-3 * norm(forces[1]) + 1;
    constexpr double h = 1e-6;
    for (const std::size_t i : {std::size_t{0}, std::size_t{7}, cells.stride + 3, 2 * cells.stride + 11}) {
        double slope[3];
        for (int q = 0; q < 3; ++q) {
            const Vec3d step{q == 0 ? h : 0, q == 1 ? h : 0, q == 2 ? h : 0}, at = cells.at[i];
            cells.at[i] = at + step;
            static_cast<void>(cells.forces(contact));
            const double up = contact.energy();
            cells.at[i] = at - step;
            static_cast<void>(cells.forces(contact));
            slope[q] = (up - contact.energy()) / (2 * h);
            cells.at[i] = at;
        }
        EXPECT_LT(norm(forces[i] + Vec3d{slope[0], slope[1], slope[2]}), 1e-6 * (scale + norm(forces[i])))
            << i;
    }
}

// The law is one of pressure between surfaces: two flat lattices meet with Pi(d) whatever their spacing is.
TEST(Contact, FlatSurfacesFeelThePressureOfTheLaw) {
    ContactOptions o{
        .pressure = 3, .range = 0.6, .adhesion = 0.2, .adhesion_distance = 0.4, .adhesion_scale = 8};
    o.walls = false;
    for (const int n : {24, 36}) {
        const double a = 3.0 / n;
        for (const double d : {0.25, 0.4}) {
            std::vector<std::vector<Vec3d>> plates(2);
            for (int i = 0; i < n; ++i)
                for (int j = 0; j < n; ++j) {
                    plates[0].push_back({a * i, 0, a * j});
                    plates[1].push_back({a * (i + 0.3), d, a * (j + 0.1)});
                }
            Cells cells(plates, 0);
            Contact contact({{0, -1, 0}, {3, 3, 3}, {true, false, true}}, o,
                            std::vector<double>(plates[0].size(), a * a), 2, cells.stride);
            double force = 0;
            const auto forces = cells.forces(contact);
            for (std::size_t i = 0; i < plates[0].size(); ++i) force -= forces[i].y;
            const ContactLaw law(o);
            EXPECT_NEAR(force / 9, law.pressure(d), 0.003 * o.pressure) << n << " " << d;
        }
    }
}

TEST(Contact, IsBitwiseTheSameForAnyNumberOfThreads) {
    Cells cells(clouds(20, 50));
    std::vector<std::vector<Vec3d>> results;
    for (const int threads : {1, 2, 3}) {
        exchange::set_threads(threads);
        Contact contact(box(), both(), uneven_areas(50), cells.cells, cells.stride);
        results.push_back(cells.forces(contact));
    }
    exchange::set_threads(0);
    for (const auto& r : results)
        for (std::size_t i = 0; i < r.size(); ++i) {
            EXPECT_EQ(r[i].x, results[0][i].x);
            EXPECT_EQ(r[i].y, results[0][i].y);
            EXPECT_EQ(r[i].z, results[0][i].z);
        }
}

TEST(Contact, NodeAreasShareTheTriangles) {
    EXPECT_EQ(node_areas({{0, 1, 2}, {0, 2, 3}}, {3, 6}, 4), (std::vector<double>{3, 1, 3, 2}));
}

TEST(Contact, RefusesWrongModuliAndSmallPeriodicBoxes) {
    ContactOptions o = both();
    o.range = 0;
    EXPECT_THROW(Contact(box(), o, {1.0}, 1, 1), InputError);
    o = both();
    o.pressure = -1;
    EXPECT_THROW(Contact(box(), o, {1.0}, 1, 1), InputError);
    o = both();
    o.range = 2.1;  // half the periodic side z
    EXPECT_THROW(Contact(box(), o, {1.0}, 1, 1), InputError);
}

}  // namespace hemoflux::coupling
