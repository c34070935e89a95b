#include "meshing/surface_check.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <string>
#include <utility>

#include "exchange/error.hpp"
#include "meshing/evans_fung.hpp"
#include "meshing/icosphere.hpp"
#include "meshing/spheroid.hpp"

namespace hemoflux::meshing {
namespace {

// Expects the check to refuse the mesh with an InputError whose message contains every part.
void expect_refused(const SurfaceMesh& mesh, std::initializer_list<const char*> parts) {
    try {
        check_surface(mesh, "cell.ply");
        ADD_FAILURE() << "not refused";
    } catch (const InputError& error) {
        const std::string message = error.what();
        EXPECT_EQ(message.rfind("surface mesh cell.ply: ", 0), 0U) << message;
        for (const char* part : parts) EXPECT_NE(message.find(part), std::string::npos) << message;
    }
}

void append(SurfaceMesh& mesh, const SurfaceMesh& other) {
    const int first = static_cast<int>(mesh.vertices.size());
    mesh.vertices.insert(mesh.vertices.end(), other.vertices.begin(), other.vertices.end());
    for (const auto& [a, b, c] : other.triangles) mesh.triangles.push_back({a + first, b + first, c + first});
}

TEST(SurfaceCheck, SpheresDiscsAndSpheroidsPassAtEveryLevel) {
    for (int level = 1; level <= icosphere_max_level; ++level) {
        const SurfaceMesh sphere = icosphere(level, 3.27);
        EXPECT_NO_THROW(check_surface(sphere, "sphere"));
        EXPECT_NO_THROW(check_surface(evans_fung(sphere), "disc"));
        EXPECT_NO_THROW(check_surface(spheroid(sphere, oblate_axes(134, 0.644)), "spheroid"));
    }
    EXPECT_NO_THROW(check_surface(icosphere(0, 1), "body", 4));
}

TEST(SurfaceCheck, TooFewVertices) {
    expect_refused(icosphere(0, 1), {"12 vertices", "at least 42", "Refine"});
}

TEST(SurfaceCheck, OpenSurface) {
    SurfaceMesh mesh = icosphere(1, 1);
    const auto [a, b, c] = mesh.triangles.back();
    mesh.triangles.pop_back();
    const std::string edge = std::to_string(std::min(a, b)) + "-" + std::to_string(std::max(a, b));
    expect_refused(mesh, {"it is open, a triangle on one side only at edges ", edge.c_str(), " (triangles ",
                          "Close the holes"});
    mesh = icosphere(3, 1);
    std::erase_if(mesh.triangles, [&](const Triangle& t) { return t[0] == 4 || t[1] == 4 || t[2] == 4; });
    mesh.vertices[4] = mesh.vertices.back();
    for (Triangle& t : mesh.triangles)
        for (int& v : t)
            if (v == static_cast<int>(mesh.vertices.size()) - 1) v = 4;
    mesh.vertices.pop_back();
    expect_refused(mesh, {"it is open, a triangle on one side only at edges "});
}

TEST(SurfaceCheck, LongListsAreCut) {
    SurfaceMesh mesh = icosphere(3, 1);
    for (const int hole : {1200, 900, 600, 300}) mesh.triangles.erase(mesh.triangles.begin() + hole);
    expect_refused(mesh, {" and 7 more (", " and 7 more)"});
}

TEST(SurfaceCheck, InvertedSurface) {
    SurfaceMesh mesh = icosphere(1, 1);
    for (Triangle& t : mesh.triangles) std::swap(t[1], t[2]);
    expect_refused(mesh, {"it is inverted", "80 triangles", "volume of -", "counter-clockwise"});
}

TEST(SurfaceCheck, OneTurnedTriangle) {
    SurfaceMesh mesh = icosphere(1, 1);
    std::swap(mesh.triangles[7][0], mesh.triangles[7][1]);
    expect_refused(mesh, {"oriented against each other: pairs ", "7", "Orient"});
}

TEST(SurfaceCheck, NonManifoldEdge) {
    SurfaceMesh mesh = icosphere(1, 1);
    const auto [a, b, c] = mesh.triangles[0];
    mesh.vertices.push_back({2, 2, 2});
    mesh.triangles.push_back({a, b, 42});
    mesh.triangles.push_back({b, a, 42});
    const std::string edge = "edge " + std::to_string(std::min(a, b)) + "-" + std::to_string(std::max(a, b));
    expect_refused(mesh, {"not 2-manifold", edge.c_str(), "(triangles 0, ", "80, 81)"});
}

TEST(SurfaceCheck, NonManifoldVertex) {
    // two spheres that share one vertex
    SurfaceMesh mesh = icosphere(1, 1), other = icosphere(1, 1);
    const Vec3d at = mesh.vertices[0];
    for (Vec3d& p : other.vertices)
        p = 2 * at - p;  // a mirror image in the shared vertex, so orientation flips
    for (Triangle& t : other.triangles) std::swap(t[1], t[2]);
    const int first = static_cast<int>(mesh.vertices.size());
    append(mesh, other);
    for (Triangle& t : mesh.triangles)
        for (int& v : t) v = v == first ? 0 : (v > first ? v - 1 : v);
    mesh.vertices.erase(mesh.vertices.begin() + first);
    expect_refused(mesh, {"not 2-manifold", "touches itself in vertex 0", "Split"});
}

TEST(SurfaceCheck, SelfIntersection) {
    SurfaceMesh mesh = icosphere(2, 1);
    mesh.vertices[0] = -1.2 * mesh.vertices[0] + Vec3d{0.05, 0.02, -0.03};
    expect_refused(mesh, {"intersects itself: triangle pairs ", " more. Move the two sheets apart"});
}

TEST(SurfaceCheck, SeparateParts) {
    SurfaceMesh mesh = icosphere(1, 1), other = icosphere(1, 1);
    translate(other, {5, 0, 0});
    append(mesh, other);
    expect_refused(mesh, {"2 separate parts", "triangles 0, 80", "one part"});
}

TEST(SurfaceCheck, BrokenNumbers) {
    SurfaceMesh mesh = icosphere(1, 1);
    mesh.triangles[5][1] = 99;
    mesh.triangles[9][0] = mesh.triangles[9][2];
    mesh.triangles[11][0] = -1;
    expect_refused(mesh, {"repeated or unknown in triangles 5, 9, 11", "from 0 to 41"});
    mesh = icosphere(1, 1);
    mesh.vertices[17].y = std::nan("");
    expect_refused(mesh, {"not finite at vertex 17"});
    mesh = icosphere(1, 1);
    mesh.vertices.push_back({0, 0, 0});
    expect_refused(mesh, {"no triangle uses vertex 42"});
    mesh = icosphere(1, 1);
    const auto [a, b, c] = mesh.triangles[3];
    mesh.vertices[static_cast<std::size_t>(a)] = mesh.vertices[static_cast<std::size_t>(b)];
    expect_refused(mesh, {"no area in triangles ", "degenerate"});
    expect_refused(SurfaceMesh{}, {"no triangles"});
}

}  // namespace
}  // namespace hemoflux::meshing
