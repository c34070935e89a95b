#include "membrane/topology.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "exchange/error.hpp"
#include "meshing/icosphere.hpp"

namespace hemoflux::membrane {
namespace {

using Triangles = std::vector<meshing::Triangle>;

const Triangles tetrahedron{{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {0, 3, 2}};

/// Two tetrahedra that share vertex `shared` of the first, the second numbered from 4 on.
Triangles two_tetrahedra(bool touching) {
    Triangles t = tetrahedron;
    for (auto triangle : tetrahedron) {
        for (int& c : triangle) c = touching ? (c == 0 ? 0 : c + 3) : c + 4;
        t.push_back(triangle);
    }
    return t;
}

std::string message(std::size_t vertices, const Triangles& triangles) {
    try {
        const Topology topology(vertices, triangles);
    } catch (const InputError& error) {
        return error.what();
    }
    return "accepted";
}

TEST(Topology, CountsOfTheIcosphere) {
    const Topology t(meshing::icosphere(2, 1.0));
    EXPECT_EQ(t.vertices(), 162u);
    EXPECT_EQ(t.edges().size(), 480u);
    EXPECT_EQ(t.max_degree(), 6u);
    std::size_t five = 0;
    for (std::size_t v = 0; v < t.vertices(); ++v) five += t.degree(v) == 5;
    EXPECT_EQ(five, 12u);
}

TEST(Topology, EdgesRunAsTheirLeftTriangleDoes) {
    const Topology t(meshing::icosphere(1, 1.0));
    const auto runs = [&t](int triangle, int from, int to, int last) {
        auto corner = t.triangles()[static_cast<std::size_t>(triangle)];
        std::rotate(corner.begin(), std::find(corner.begin(), corner.end(), from), corner.end());
        return corner == meshing::Triangle{from, to, last};
    };
    for (const Edge& e : t.edges()) {
        EXPECT_TRUE(runs(e.a, e.v1, e.v2, e.v3));
        EXPECT_TRUE(runs(e.b, e.v2, e.v1, e.v4));
    }
}

TEST(Topology, RingsAreOrderedAndNameTheirTrianglesAndEdges) {
    const Topology t(meshing::icosphere(1, 1.0));
    for (std::size_t v = 0; v < t.vertices(); ++v) {
        const auto n = t.neighbours(v);
        for (std::size_t i = 0; i < n.size(); ++i) {
            auto corner = t.triangles()[static_cast<std::size_t>(t.ring_triangles(v)[i])];
            std::rotate(corner.begin(), std::find(corner.begin(), corner.end(), static_cast<int>(v)),
                        corner.end());
            EXPECT_EQ(corner, (meshing::Triangle{static_cast<int>(v), n[i], n[(i + 1) % n.size()]}));
            const Edge& e = t.edges()[static_cast<std::size_t>(t.ring_edges(v)[i])];
            EXPECT_EQ(std::minmax(e.v1, e.v2), std::minmax(static_cast<int>(v), n[i]));
        }
    }
}

TEST(Topology, TetrahedronIsTheSmallestSurface) {
    EXPECT_EQ(message(4, tetrahedron), "accepted");
    EXPECT_EQ(Topology(4, tetrahedron).edges().size(), 6u);
}

TEST(Topology, RefusesWhatIsNoClosedSurfaceAndNamesThePlace) {
    Triangles open = Topology(meshing::icosphere(1, 1.0)).triangles();
    open.pop_back();
    EXPECT_NE(message(42, open).find("has no neighbour across it"), std::string::npos) << message(42, open);

    Triangles flipped = Topology(meshing::icosphere(1, 1.0)).triangles();
    std::swap(flipped[7][0], flipped[7][1]);
    EXPECT_NE(message(42, flipped).find("triangles 6 and 7 both run"), std::string::npos)
        << message(42, flipped);

    Triangles wrong = tetrahedron;
    wrong[1] = {0, 1, 9};
    EXPECT_NE(message(4, wrong).find("no vertex 9"), std::string::npos) << message(4, wrong);
    wrong[1] = {0, 1, 1};
    EXPECT_NE(message(4, wrong).find("corners are the same"), std::string::npos) << message(4, wrong);

    EXPECT_NE(message(5, tetrahedron).find("vertex 4"), std::string::npos) << message(5, tetrahedron);
    EXPECT_NE(message(7, two_tetrahedra(true)).find("fans"), std::string::npos)
        << message(7, two_tetrahedra(true));
    EXPECT_NE(message(8, two_tetrahedra(false)).find("not connected"), std::string::npos)
        << message(8, two_tetrahedra(false));
}

}  // namespace
}  // namespace hemoflux::membrane
