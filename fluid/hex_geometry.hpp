/// Geometry of an unstructured hexahedral grid as kernels see it: per cell its neighbours with their gradient weights and
/// its faces, per face the two cells, the frame, and where the face's centre lies seen from either cell.
///
/// Values of cells are records of four (density, velocity) or, with gradients, of sixteen. Values of the ghost cells of the
/// border faces follow those of the cells; records with gradients have places of their own, see fluid/hex_sweep.hpp. Faces
/// are in the order of the sweep. Face data are kept in blocks of `face_block` faces, field after field, so that a pack of
/// faces is loaded from one short piece of memory.
#pragma once

#include <cstdint>
#include <vector>

#include "exchange/buffer.hpp"
#include "exchange/macros.hpp"
#include "exchange/pack.hpp"
#include "fluid/hex_gradient.hpp"
#include "fluid/hex_sweep.hpp"
#include "meshing/hex_grid.hpp"

namespace hemoflux::fluid {

/// Fields of a face, in their order within a block. The reaches lead from a cell's centre to the centre of the face.
enum FaceField : std::size_t {
    face_normal,                             ///< unit normal, from left to right, x y z
    face_tangent = face_normal + 3,          ///< first tangent, x y z; the second is n x t1
    face_area = face_tangent + 3,            ///< area
    face_reach_left = face_area + 1,         ///< from the left cell, x y z
    face_reach_right = face_reach_left + 3,  ///< from the right cell, x y z
    face_delta = face_reach_right + 3,       ///< streaming distance
    face_inverse_delta,                      ///< its reciprocal
    face_weight,                             ///< distance weight of the left cell
    face_fields
};

/// Everything kernels need of the grid; trivially copyable. Numbers of faces are padded to whole blocks: the faces beyond
/// `faces` have no area and lie between the cells 0 and 0.
struct HexView {
    std::size_t cells = 0;                     ///< cells; ghost cell b has the number cells + b
    std::size_t faces = 0;                     ///< all faces
    std::size_t border = 0;                    ///< border faces
    std::size_t cell_records = 0;              ///< cell c's record is the one of number c % cell_records
    std::size_t fluxes = 0;                    ///< face f's flux is the one of number f % fluxes
    const std::uint32_t* neighbour = nullptr;  ///< [cell][6] numbers of the neighbours
    const double* weight = nullptr;            ///< [cell][6][3] gradient weights
    /// [cell][6] twice the number of the flux, plus one where the face's area points into the cell.
    const std::uint32_t* side = nullptr;
    const double* inverse_volume = nullptr;       ///< [cell]
    const double* projection = nullptr;           ///< [cell][3] areas projected along x, y, z (2.58)
    const std::uint32_t* left = nullptr;          ///< [face] cell
    const std::uint32_t* right = nullptr;         ///< [face] cell or ghost cell
    const std::uint32_t* left_record = nullptr;   ///< [face] number of its record
    const std::uint32_t* right_record = nullptr;  ///< [face] number of its record
    const std::uint32_t* border_face = nullptr;   ///< [border] face
    const std::uint32_t* border_order = nullptr;  ///< [border] border faces in the order of the sweep
    const double* face = nullptr;                 ///< blocks of face data

    /// Field k of face f; consecutive faces of one block lie side by side.
    HEMOFLUX_INLINE const double* field(std::size_t f, std::size_t k) const {
        return face + (f / face_block * face_fields + k) * face_block + f % face_block;
    }
};

/// Owns the arrays behind a HexView.
class HexGeometry {
  public:
    /// delta_max: largest streaming distance allowed, in the grid's length unit. idle: see idle_faces() of
    /// fluid/hex_boundary.hpp; these faces are left out of the projected areas. stage_cells: cells a stage of the sweep
    /// completes; 0: as many as suit the machine. InputError where a cell is too distorted for its gradient.
    HexGeometry(const meshing::HexGrid& grid, GradientMethod method, double delta_max,
                const std::vector<char>& idle, std::size_t stage_cells = 0);

    /// With records and fluxes in the rings of the sweep; valid as long as this object lives.
    [[nodiscard]] const HexView& view() const { return view_; }
    /// The same with a place of its own for the record of every cell and ghost cell, by its number, and for the flux of
    /// every face; for gradients and fluxes alone, HexView::side does not fit.
    [[nodiscard]] HexView whole_view() const;
    /// The stages of the sweep in their order.
    [[nodiscard]] const std::vector<HexStage>& stages() const { return stages_; }
    /// Records and fluxes the sweep has places for.
    [[nodiscard]] std::size_t records() const { return records_; }
    [[nodiscard]] std::size_t fluxes() const { return view_.fluxes; }

  private:
    void set_cells(const meshing::HexGrid& grid, GradientMethod method, const std::vector<char>& idle,
                   const std::vector<std::uint32_t>& number);
    void set_faces(const meshing::HexGrid& grid, double delta_max, const HexSweep& sweep);
    void set_border(const HexSweep& sweep, const std::vector<std::uint32_t>& number);

    std::size_t padded_faces_ = 0, records_ = 0;
    std::vector<HexStage> stages_;
    exchange::Buffer<double> weight_, inverse_volume_, projection_, face_;
    exchange::Buffer<std::uint32_t> neighbour_, side_, left_, right_, left_record_, right_record_,
        border_face_, border_order_;
    HexView view_;
};

}  // namespace hemoflux::fluid
