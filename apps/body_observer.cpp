#include "apps/body_observer.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "apps/output/history.hpp"
#include "exchange/error.hpp"
#include "fluid/profile.hpp"
#include "fluid/wall.hpp"

namespace hemoflux::apps {
namespace {

Vec3d vector(const std::array<double, 3>& v) { return {v[0], v[1], v[2]}; }
Vec3d unit(const std::array<double, 3>& v) { return (1 / norm(vector(v))) * vector(v); }

/// Middle of the extents of the patch.
Vec3d middle_of(const std::vector<fluid::WallFace>& faces) {
    Vec3d low = faces.front().centre, high = low;
    for (const auto& face : faces) {
        low = {std::min(low.x, face.centre.x), std::min(low.y, face.centre.y),
               std::min(low.z, face.centre.z)};
        high = {std::max(high.x, face.centre.x), std::max(high.y, face.centre.y),
                std::max(high.z, face.centre.z)};
    }
    return 0.5 * (low + high);
}

/// The area that the stream sees: every line along it meets a closed surface twice.
double frontal_area(const std::vector<fluid::WallFace>& faces, const Vec3d& stream) {
    double area = 0;
    for (const auto& face : faces) area += std::abs(dot(face.area, stream)) / 2;
    return area;
}

}  // namespace

void check_body(const BodyInput& body, const fluid::Flow& flow) {
    const auto patches = flow.patches();
    if (std::find(patches.begin(), patches.end(), body.patch) == patches.end())
        throw InputError(fmt::format("observables.body.patch = \"{}\"", body.patch),
                         fmt::format("the flow has the patches {}", fmt::join(patches, ", ")),
                         "Name one of these");
    const Vec3d stream = vector(body.direction), lift = vector(body.lift);
    if (!(norm(stream) > 0 && norm(lift) > 0) ||
        std::abs(dot(stream, lift)) > 1e-9 * norm(stream) * norm(lift))
        throw InputError("observables.body.direction and lift", "they are not normal to each other",
                         "Give two directions at a right angle");
}

Vec3d centre_of(const BodyInput& body, const std::vector<fluid::WallFace>& faces) {
    return body.centre ? vector(*body.centre) : middle_of(faces);
}

void observe_body_flow(const BodyCase& body, const fluid::Flow& flow, const fluid::Probe& probe,
                       output::Summary& summary, const output::OutputFolder& folder) {
    const auto faces = flow.wall_faces(body.input.patch);
    const Vec3d centre = centre_of(body.input, faces);
    const fluid::BodyFrame frame{centre, unit(body.input.direction), unit(body.input.lift)};
    const double area = body.input.area.value_or(frontal_area(faces, frame.stream));
    auto& o = summary.observables;
    const fluid::WallForce force = fluid::total_force(faces);
    const auto coefficient = [&](const std::string& name, const Vec3d& direction) {
        o[name] = fluid::force_coefficient(force.total(), direction, body.speed, area);
        o[name + "_pressure"] = fluid::force_coefficient(force.pressure, direction, body.speed, area);
        o[name + "_viscous"] = fluid::force_coefficient(force.viscous, direction, body.speed, area);
    };
    coefficient("drag_coefficient", frame.stream);
    coefficient("lift_coefficient", frame.lift);

    const auto points = fluid::wall_points(faces, frame);
    o["separation_angle_deg"] = fluid::separation_angle_deg(points).value_or(NAN);
    const double dynamic = body.speed * body.speed / 2;
    output::Table wall{{"angle_deg", "x_um", "y_um", "z_um", "pressure_coefficient", "friction_coefficient"},
                       {}};
    for (const auto& p : points)
        wall.rows.push_back(
            {p.angle_deg, p.centre.x, p.centre.y, p.centre.z, p.pressure / dynamic, p.shear / dynamic});
    output::write_table(folder.path() / "wall.csv", wall);

    const double radius = body.length / 2;
    const Vec3d front = body.input.front ? vector(*body.input.front) : centre - radius * frame.stream;
    const Vec3d rear = body.input.rear ? vector(*body.input.rear) : centre + radius * frame.stream;
    const double drop = body.gamma / 3 * (probe(front)[0] - probe(rear)[0]);
    o["pressure_difference"] = drop / (body.speed * body.speed);
    o["pressure_difference_pa"] = drop * body.scales.pressure_pa;

    const double reach = dot(body.box_end - rear, frame.stream);
    const auto along = [&](double s) {
        const auto q = probe(rear + s * frame.stream);
        return dot(Vec3d{q[1], q[2], q[3]}, frame.stream);
    };
    constexpr double first = 0.02;  // of a length: on the wall itself the velocity is zero
    const auto end =
        fluid::first_rise_through_zero(along, first * body.length, std::min(reach, 20 * body.length), 2001);
    o["recirculation_length"] = end ? *end / body.length : NAN;
}

}  // namespace hemoflux::apps
