#include "fluid/hex_geometry.hpp"

#include <algorithm>
#include <cmath>

#include "meshing/face_frame.hpp"

namespace hemoflux::fluid {

namespace {

/// Cells a stage completes on a CPU: few, so that what stages share stays in the cache.
constexpr std::size_t suitable_stage = 512;

}  // namespace

HexGeometry::HexGeometry(const meshing::HexGrid& grid, GradientMethod method, double delta_max,
                         const std::vector<char>& idle, std::size_t stage_cells) {
    if (stage_cells == 0) stage_cells = exchange::on_gpu ? grid.cells() : suitable_stage;
    const HexSweep sweep = plan_sweep(grid, stage_cells);
    stages_ = sweep.stages;
    records_ = sweep.cell_records + sweep.ghost_records;
    padded_faces_ = exchange::round_up(grid.faces(), face_block);
    view_.cells = grid.cells();
    view_.faces = grid.faces();
    view_.border = grid.border_faces();
    view_.cell_records = sweep.cell_records;
    view_.fluxes = sweep.fluxes;
    std::vector<std::uint32_t> number(grid.faces());
    for (std::size_t k = 0; k < sweep.faces.size(); ++k)
        number[sweep.faces[k]] = static_cast<std::uint32_t>(k);
    set_cells(grid, method, idle, number);
    set_faces(grid, delta_max, sweep);
    set_border(sweep, number);
}

HexView HexGeometry::whole_view() const {
    HexView whole = view_;
    whole.cell_records = exchange::round_up(view_.cells, gradient_block);
    whole.fluxes = padded_faces_;
    whole.left_record = view_.left;
    whole.right_record = view_.right;
    return whole;
}

void HexGeometry::set_cells(const meshing::HexGrid& grid, GradientMethod method,
                            const std::vector<char>& idle, const std::vector<std::uint32_t>& number) {
    const std::vector<HexNeighbour> neighbours = hex_neighbours(grid);
    weight_ = exchange::Buffer<double>(gradient_weights(grid, neighbours, method));
    std::vector<std::uint32_t> cells, sides;
    for (const HexNeighbour& n : neighbours) {
        cells.push_back(n.cell);
        const auto flux = static_cast<std::uint32_t>(number[n.face] % view_.fluxes);
        sides.push_back(2 * flux + (n.outward > 0 ? 0 : 1));
    }
    neighbour_ = exchange::Buffer<std::uint32_t>(cells);
    side_ = exchange::Buffer<std::uint32_t>(sides);
    std::vector<double> inverse, projection;
    for (std::size_t cell = 0; cell < grid.cells(); ++cell) {
        inverse.push_back(1 / grid.volume[cell]);
        Vec3d sum{0, 0, 0};
        for (std::size_t j = 0; j < hex_sides; ++j) {
            const HexNeighbour& n = neighbours[hex_sides * cell + j];
            if (idle[n.face]) continue;
            const Vec3d& s = grid.area[n.face];
            sum += 0.5 * Vec3d{std::abs(s.x), std::abs(s.y), std::abs(s.z)};
        }
        projection.insert(projection.end(), {sum.x, sum.y, sum.z});
    }
    inverse_volume_ = exchange::Buffer<double>(inverse);
    projection_ = exchange::Buffer<double>(projection);
    view_.neighbour = neighbour_.data();
    view_.side = side_.data();
    view_.weight = weight_.data();
    view_.inverse_volume = inverse_volume_.data();
    view_.projection = projection_.data();
}

void HexGeometry::set_border(const HexSweep& sweep, const std::vector<std::uint32_t>& number) {
    border_face_ = exchange::Buffer<std::uint32_t>(
        std::vector<std::uint32_t>(number.end() - static_cast<std::ptrdiff_t>(view_.border), number.end()));
    border_order_ = exchange::Buffer<std::uint32_t>(sweep.border);
    view_.border_face = border_face_.data();
    view_.border_order = border_order_.data();
}

void HexGeometry::set_faces(const meshing::HexGrid& grid, double delta_max, const HexSweep& sweep) {
    const std::vector<Vec3d> ghosts = ghost_centres(grid);
    std::vector<std::uint32_t> left(padded_faces_, 0), right(padded_faces_, 0), left_record(padded_faces_, 0),
        right_record(padded_faces_, 0);
    std::vector<double> face(padded_faces_ * face_fields, 0.0);
    const auto put = [&](std::size_t f, std::size_t k, const Vec3d& v) {
        const double values[3] = {v.x, v.y, v.z};
        for (std::size_t a = 0; a < 3; ++a)
            face[(f / face_block * face_fields + k + a) * face_block + f % face_block] = values[a];
    };
    const auto put_one = [&](std::size_t f, std::size_t k, double value) {
        face[(f / face_block * face_fields + k) * face_block + f % face_block] = value;
    };
    std::size_t ghost = 0;
    for (std::size_t f = 0; f < padded_faces_; ++f) {
        Vec3d area{0, 0, 0}, normal{1, 0, 0}, reach_left{1, 0, 0}, reach_right{-1, 0, 0};
        double delta = 1;
        if (f < grid.faces()) {
            const std::size_t g = sweep.faces[f];
            left[f] = grid.left[g];
            right[f] = grid.right[g];
            left_record[f] = static_cast<std::uint32_t>(left[f] % sweep.cell_records);
            right_record[f] = static_cast<std::uint32_t>(
                right[f] < grid.cells() ? right[f] % sweep.cell_records
                                        : sweep.cell_records + ghost++ % sweep.ghost_records);
            area = grid.area[g];
            normal = (1 / norm(area)) * area;
            Vec3d far = right[f] < grid.cells() ? grid.centre[right[f]] : ghosts[right[f] - grid.cells()];
            if (!grid.shift.empty()) far += grid.shift[g];
            reach_left = grid.face_centre[g] - grid.centre[left[f]];
            reach_right = grid.face_centre[g] - far;
            delta = std::min(grid.delta[g], delta_max);
        }
        const meshing::FaceFrame frame = meshing::face_frame(normal);
        put(f, face_normal, frame.normal);
        put(f, face_tangent, frame.tangent1);
        put_one(f, face_area, norm(area));
        put(f, face_reach_left, reach_left);
        put(f, face_reach_right, reach_right);
        put_one(f, face_delta, delta);
        put_one(f, face_inverse_delta, 1 / delta);
        const double to_left = dot(reach_left, frame.normal), to_right = -dot(reach_right, frame.normal);
        put_one(f, face_weight, to_right / (to_left + to_right));
    }
    left_ = exchange::Buffer<std::uint32_t>(left);
    right_ = exchange::Buffer<std::uint32_t>(right);
    left_record_ = exchange::Buffer<std::uint32_t>(left_record);
    right_record_ = exchange::Buffer<std::uint32_t>(right_record);
    face_ = exchange::Buffer<double>(face);
    view_.left = left_.data();
    view_.right = right_.data();
    view_.left_record = left_record_.data();
    view_.right_record = right_record_.data();
    view_.face = face_.data();
}

}  // namespace hemoflux::fluid
