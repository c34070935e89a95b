#include "fluid/hex_geometry.hpp"

#include <algorithm>
#include <cmath>

#include "meshing/face_frame.hpp"

namespace hemoflux::fluid {

HexGeometry::HexGeometry(const meshing::HexGrid& grid, GradientMethod method, double delta_max,
                         const std::vector<char>& idle) {
    view_.cells = grid.cells();
    view_.interior = grid.interior_faces();
    view_.faces = grid.faces();
    padded_faces_ = exchange::round_up(grid.faces(), face_block);
    set_cells(grid, method, idle);
    set_faces(grid, delta_max);
}

void HexGeometry::set_cells(const meshing::HexGrid& grid, GradientMethod method,
                            const std::vector<char>& idle) {
    const std::vector<HexNeighbour> neighbours = hex_neighbours(grid);
    weight_ = exchange::Buffer<double>(gradient_weights(grid, neighbours, method));
    std::vector<std::uint32_t> cells, sides;
    for (const HexNeighbour& n : neighbours) {
        cells.push_back(n.cell);
        sides.push_back(2 * n.face + (n.outward > 0 ? 0 : 1));
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

void HexGeometry::set_faces(const meshing::HexGrid& grid, double delta_max) {
    const std::vector<Vec3d> ghosts = ghost_centres(grid);
    std::vector<std::uint32_t> left(padded_faces_, 0), right(padded_faces_, 0);
    std::vector<double> face(padded_faces_ * face_fields, 0.0);
    const auto put = [&](std::size_t f, std::size_t k, const Vec3d& v) {
        const double values[3] = {v.x, v.y, v.z};
        for (std::size_t a = 0; a < 3; ++a)
            face[(f / face_block * face_fields + k + a) * face_block + f % face_block] = values[a];
    };
    const auto put_one = [&](std::size_t f, std::size_t k, double value) {
        face[(f / face_block * face_fields + k) * face_block + f % face_block] = value;
    };
    for (std::size_t f = 0; f < padded_faces_; ++f) {
        Vec3d area{0, 0, 0}, normal{1, 0, 0}, reach_left{1, 0, 0}, reach_right{-1, 0, 0};
        double delta = 1;
        if (f < grid.faces()) {
            left[f] = grid.left[f];
            right[f] = grid.right[f];
            area = grid.area[f];
            normal = (1 / norm(area)) * area;
            Vec3d far = right[f] < grid.cells() ? grid.centre[right[f]] : ghosts[right[f] - grid.cells()];
            if (!grid.shift.empty()) far += grid.shift[f];
            reach_left = grid.face_centre[f] - grid.centre[left[f]];
            reach_right = grid.face_centre[f] - far;
            delta = std::min(grid.delta[f], delta_max);
        }
        const meshing::FaceFrame frame = meshing::face_frame(normal);
        const auto in_frame = [&](const Vec3d& v) {
            return Vec3d{dot(v, frame.normal), dot(v, frame.tangent1), dot(v, frame.tangent2)};
        };
        put(f, face_normal, frame.normal);
        put(f, face_tangent, frame.tangent1);
        put_one(f, face_area, norm(area));
        put(f, face_reach_left, in_frame(reach_left));
        put(f, face_reach_right, in_frame(reach_right));
        put_one(f, face_delta, delta);
        put_one(f, face_inverse_delta, 1 / delta);
        const double to_left = dot(reach_left, frame.normal), to_right = -dot(reach_right, frame.normal);
        put_one(f, face_weight, to_right / (to_left + to_right));
    }
    left_ = exchange::Buffer<std::uint32_t>(left);
    right_ = exchange::Buffer<std::uint32_t>(right);
    face_ = exchange::Buffer<double>(face);
    view_.left = left_.data();
    view_.right = right_.data();
    view_.face = face_.data();
}

}  // namespace hemoflux::fluid
