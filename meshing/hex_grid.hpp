/// Face-based grid of hexahedra for the finite-volume solver. Area vector of a face through the nodes p0 .. p3
/// (bilinear, warped or not), volume and centre of a cell:
///
///   S   = 1/2 (p2 - p0) x (p3 - p1)              outward S of a cell sum to zero
///   V   = 1/3 sum_faces int r . dS               divergence theorem, exact for bilinear faces
///
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "exchange/vec3.hpp"
#include "meshing/face_frame.hpp"
#include "meshing/hex_mesh.hpp"

namespace hemoflux::meshing {

/// Cells, faces and their geometry. Cells are numbered by reverse Cuthill-McKee; faces come in the order:
/// interior faces (periodic ones among them) sorted by (left, right), then the border faces patch by patch in
/// the order of their cells. left < right on interior faces, save where a cell is its own periodic neighbour.
struct HexGrid {
    /// Range of faces of one patch.
    struct Patch {
        std::string name;
        std::size_t first, count;
    };

    /// Per cell: volume (um^3), centre of volume (um), number of the cell in the mesh it came from.
    std::vector<double> volume;
    std::vector<Vec3d> centre;
    std::vector<std::size_t> original;
    /// Per cell: aspect ratio, its largest over its smallest extent, an extent being the volume over the mean area of
    /// two opposite faces. A direction in which the cell is the only one across the domain is left out.
    std::vector<double> aspect;

    /// The nodes of the mesh (um), and per cell its eight in the order of VTK_HEXAHEDRON.
    std::vector<Vec3d> nodes;
    std::vector<std::array<std::uint32_t, 8>> corners;

    /// Per face: the cells on its two sides. On the border right = cells() + (face - interior_faces()).
    std::vector<std::uint32_t> left, right;
    /// Per face: area vector from left to right (um^2), centre of area (um; that of the left cell's side where
    /// the face is periodic).
    std::vector<Vec3d> area, face_centre;
    /// Per face: what to add to centre[right] to find the right cell beside this face. Empty when no face is
    /// periodic.
    std::vector<Vec3d> shift;
    /// Per face: largest streaming distance (um) that keeps all nodes r - e delta of the D3Q15 lattice in the
    /// frame of the face inside its two cells; see hex_spacing.hpp.
    std::vector<double> delta;

    /// Faces of cell c: face[first_face[c] .. first_face[c + 1]), with outward = +1 where area points out of c.
    /// A face by which a cell is its own neighbour is listed twice, +1 then -1.
    std::vector<std::uint32_t> first_face, face;
    std::vector<signed char> outward;
    /// Beside `face`: which of hex_faces of the cell it is; side ^ 1 is opposite.
    std::vector<unsigned char> side;

    /// Patches that are not glued, in the order of the mesh.
    std::vector<Patch> patches;

    /// Numbers of cells, faces and border faces.
    [[nodiscard]] std::size_t cells() const { return volume.size(); }
    [[nodiscard]] std::size_t faces() const { return left.size(); }
    [[nodiscard]] std::size_t border_faces() const {
        return patches.empty() ? 0 : faces() - patches[0].first;
    }
    [[nodiscard]] std::size_t interior_faces() const { return faces() - border_faces(); }
};

/// Builds the grid. InputError for: a mesh without cells, a node number out of range, a cell of negative or
/// zero volume or turned inside out (named by its number in the mesh), a face shared by more than two cells, a
/// border face in no patch or in two, a patch face that is no border face, a periodic pair that names no patch
/// or whose faces do not match by one translation.
HexGrid make_hex_grid(const HexMesh& mesh, const std::vector<PeriodicPair>& periodic = {});

}  // namespace hemoflux::meshing
