/// Geometry of an unstructured hexahedral grid as kernels see it: per cell its neighbours with their gradient weights and
/// its faces, per face the two cells, the frame, and where the face's centre lies seen from either cell.
///
/// Values of cells are records of four (density, velocity) or, with gradients, of sixteen; the ghost cells of the border
/// faces follow the cells. Face data are kept in blocks of `face_block` faces, field after field, so that a pack of faces
/// is loaded from one short piece of memory.
#pragma once

#include <cstdint>
#include <vector>

#include "exchange/buffer.hpp"
#include "exchange/macros.hpp"
#include "exchange/pack.hpp"
#include "fluid/hex_gradient.hpp"
#include "meshing/hex_grid.hpp"

namespace hemoflux::fluid {

/// Faces a block of face data holds.
inline constexpr std::size_t face_block = exchange::on_gpu ? 32 : exchange::row_alignment;

/// Fields of a face, in their order within a block. The reaches lead from a cell's centre to the centre of the face.
enum FaceField : std::size_t {
    face_normal,                             ///< unit normal, from left to right, x y z
    face_tangent = face_normal + 3,          ///< first tangent, x y z; the second is n x t1
    face_area = face_tangent + 3,            ///< area
    face_reach_left = face_area + 1,         ///< from the left cell, along n, t1, t2
    face_reach_right = face_reach_left + 3,  ///< from the right cell, along n (negative), t1, t2
    face_delta = face_reach_right + 3,       ///< streaming distance
    face_inverse_delta,                      ///< its reciprocal
    face_weight,                             ///< distance weight of the left cell
    face_fields
};

/// Everything kernels need of the grid; trivially copyable. Numbers of faces are padded to whole blocks: the faces beyond
/// `faces` have no area and lie between the cells 0 and 0.
struct HexView {
    std::size_t cells = 0;                     ///< cells; ghost cell b has the number cells + b
    std::size_t interior = 0;                  ///< interior faces; border face b has the number interior + b
    std::size_t faces = 0;                     ///< all faces
    const std::uint32_t* neighbour = nullptr;  ///< [cell][6] numbers of the neighbours
    const double* weight = nullptr;            ///< [cell][6][3] gradient weights
    /// [cell][6] twice the number of the face, plus one where its area points into the cell.
    const std::uint32_t* side = nullptr;
    const double* inverse_volume = nullptr;  ///< [cell]
    const double* projection = nullptr;      ///< [cell][3] areas projected along x, y, z (2.58)
    const std::uint32_t* left = nullptr;     ///< [face]
    const std::uint32_t* right = nullptr;    ///< [face]
    const double* face = nullptr;            ///< blocks of face data

    /// Field k of face f; consecutive faces of one block lie side by side.
    HEMOFLUX_INLINE const double* field(std::size_t f, std::size_t k) const {
        return face + (f / face_block * face_fields + k) * face_block + f % face_block;
    }
};

/// Owns the arrays behind a HexView.
class HexGeometry {
  public:
    /// delta_max: largest streaming distance allowed, in the grid's length unit. idle: see idle_faces() of
    /// fluid/hex_boundary.hpp; these faces are left out of the projected areas. InputError where a cell is too distorted
    /// for its gradient.
    HexGeometry(const meshing::HexGrid& grid, GradientMethod method, double delta_max,
                const std::vector<char>& idle);

    [[nodiscard]] const HexView& view() const { return view_; }
    /// Number of faces rounded up to whole blocks.
    [[nodiscard]] std::size_t padded_faces() const { return padded_faces_; }

  private:
    void set_cells(const meshing::HexGrid& grid, GradientMethod method, const std::vector<char>& idle);
    void set_faces(const meshing::HexGrid& grid, double delta_max);

    std::size_t padded_faces_ = 0;
    exchange::Buffer<double> weight_, inverse_volume_, projection_, face_;
    exchange::Buffer<std::uint32_t> neighbour_, side_, left_, right_;
    HexView view_;
};

}  // namespace hemoflux::fluid
