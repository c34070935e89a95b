#include "meshing/hex_periodic.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "exchange/error.hpp"

namespace hemoflux::meshing {
namespace {

constexpr double agreement = 1e-4;  // of a face's size; files often carry six digits

/// A side with what is compared.
struct Candidate {
    std::uint32_t side;
    Vec3d centre;
    double place, size;  // place along `probe`, root of the area
};

/// A direction in which the faces of a usual mesh do not line up, so that few share a place along it.
constexpr Vec3d probe{0.6172, 0.5413, 0.5709};

std::vector<Candidate> candidates(const HexMesh& mesh, const std::vector<std::uint32_t>& sides) {
    std::vector<Candidate> out;
    out.reserve(sides.size());
    for (const std::uint32_t side : sides) {
        const auto n = side_nodes(mesh, side);
        Vec3d centre{0, 0, 0};
        for (const std::uint32_t k : n) centre += 0.25 * mesh.nodes[k];
        const Vec3d area = cross(mesh.nodes[n[2]] - mesh.nodes[n[0]], mesh.nodes[n[3]] - mesh.nodes[n[1]]);
        out.push_back({side, centre, dot(probe, centre), std::sqrt(0.5 * norm(area))});
    }
    return out;
}

Vec3d mean_centre(const std::vector<Candidate>& faces) {
    Vec3d sum{0, 0, 0};
    for (const Candidate& f : faces) sum += f.centre;
    return (1.0 / static_cast<double>(faces.size())) * sum;
}

/// Whether each node of a, moved, is a node of b and the two face each other.
bool same_face(const HexMesh& mesh, const Candidate& a, const Candidate& b, const Vec3d& move) {
    const auto na = side_nodes(mesh, a.side), nb = side_nodes(mesh, b.side);
    for (std::size_t i = 0; i < 4; ++i) {
        bool found = false;
        for (std::size_t k = 0; k < 4 && !found; ++k)
            found = norm(mesh.nodes[na[i]] + move - mesh.nodes[nb[k]]) <= agreement * a.size;
        if (!found) return false;
    }
    const auto area = [&mesh](const std::array<std::uint32_t, 4>& n) {
        return cross(mesh.nodes[n[2]] - mesh.nodes[n[0]], mesh.nodes[n[3]] - mesh.nodes[n[1]]);
    };
    return dot(area(na), area(nb)) < 0;
}

std::size_t find_patch_number(const HexTopology& topology, const std::string& name) {
    std::string known;
    for (std::size_t p = 0; p < topology.patches.size(); ++p) {
        if (topology.patches[p].name == name) return p;
        known += (p == 0 ? "" : ", ") + topology.patches[p].name;
    }
    throw InputError(fmt::format("periodic patch \"{}\"", name),
                     "the mesh has no patch of this name that is not glued already",
                     known.empty() ? "Remove this periodic pair" : fmt::format("Its patches are {}", known));
}

[[noreturn]] void refuse(const PeriodicPair& pair, const std::string& why) {
    throw InputError(fmt::format("periodic patches \"{}\" and \"{}\"", pair.low, pair.high), why,
                     "Mesh the two surfaces alike, one being the other moved by a translation, or give them "
                     "conditions of their own");
}

}  // namespace

void glue(const HexMesh& mesh, const PeriodicPair& pair, HexTopology& topology) {
    const std::size_t low_patch = find_patch_number(topology, pair.low);
    const std::size_t high_patch = find_patch_number(topology, pair.high);
    if (low_patch == high_patch) refuse(pair, "a patch cannot be its own opposite");
    std::vector<Candidate> low = candidates(mesh, topology.patches[low_patch].sides);
    std::vector<Candidate> high = candidates(mesh, topology.patches[high_patch].sides);
    if (low.size() != high.size() || low.empty())
        refuse(pair, fmt::format("they have {} and {} faces", low.size(), high.size()));
    const Vec3d move = mean_centre(high) - mean_centre(low);
    std::sort(high.begin(), high.end(), [](const Candidate& a, const Candidate& b) {
        return a.place != b.place ? a.place < b.place : a.side < b.side;
    });
    const auto number = static_cast<std::uint32_t>(topology.translation.size());
    for (const Candidate& face : low) {
        const double place = face.place + dot(probe, move), reach = agreement * face.size;
        auto match = std::lower_bound(high.begin(), high.end(), place - reach,
                                      [](const Candidate& c, double value) { return c.place < value; });
        while (match != high.end() && match->place <= place + reach &&
               !(topology.partner[match->side] == HexTopology::none && same_face(mesh, face, *match, move))) {
            ++match;
        }
        if (match == high.end() || match->place > place + reach)
            refuse(pair,
                   fmt::format("the face of {} has no opposite at the distance ({:.6g}, {:.6g}, {:.6g})",
                               describe_cell(mesh, face.side / 6), move.x, move.y, move.z));
        topology.partner[face.side] = match->side;
        topology.partner[match->side] = face.side;
        topology.links.push_back({face.side, match->side, number});
    }
    topology.translation.push_back(move);
    const auto later = static_cast<std::ptrdiff_t>(std::max(low_patch, high_patch));
    const auto earlier = static_cast<std::ptrdiff_t>(std::min(low_patch, high_patch));
    topology.patches.erase(topology.patches.begin() + later);
    topology.patches.erase(topology.patches.begin() + earlier);
}

}  // namespace hemoflux::meshing
