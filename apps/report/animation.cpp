#include "apps/report/animation.hpp"

#include <fmt/format.h>
#include <json/json.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

#include "apps/output/vtk_writer.hpp"
#include "apps/report/html.hpp"
#include "meshing/surface_io.hpp"

namespace hemoflux::report {
namespace {

/// What orders the frames of cells.pvd.
struct FrameLabel {
    std::string name, unit;
};

FrameLabel label_of(const RunRecord& run) {
    if (run.kind == "coupled") return {"strain", ""};
    if (run.kind != "membrane") return {"time", "s"};
    const std::string task = run.text("membrane.task");
    if (task == "stretch") return {"force", "pN"};
    if (task == "relax-back") return {"time", "s"};
    return {"shape", ""};
}

template <class Integer>
std::string packed(const std::vector<Integer>& values) {
    return base64({reinterpret_cast<const char*>(values.data()), values.size() * sizeof(Integer)});
}

/// A mesh's triangles in the smallest integers that hold its vertex numbers.
template <class Integer>
std::string packed_triangles(const meshing::SurfaceMesh& mesh) {
    std::vector<Integer> corners;
    for (const auto& t : mesh.triangles)
        for (const int v : t) corners.push_back(static_cast<Integer>(v));
    return packed(corners);
}

/// First vertex of every cell in a file.
Json::Value starts_of(const output::SurfaceArrays& arrays) {
    Json::Value starts(Json::arrayValue);
    for (const output::DataArray& array : arrays.point) {
        if (array.name != "cell") continue;
        for (std::size_t i = 0; i < array.values.size(); ++i)
            if (i == 0 || array.values[i] != array.values[i - 1]) starts.append(static_cast<Json::UInt64>(i));
    }
    if (starts.empty()) starts.append(0);
    return starts;
}

struct Box {
    double low[3] = {INFINITY, INFINITY, INFINITY}, high[3] = {-INFINITY, -INFINITY, -INFINITY};
    void include(const Vec3d& v) {
        const double at[3] = {v.x, v.y, v.z};
        for (int q = 0; q < 3; ++q) {
            low[q] = std::min(low[q], at[q]);
            high[q] = std::max(high[q], at[q]);
        }
    }
    [[nodiscard]] double middle(int q) const { return (low[q] + high[q]) / 2; }
    [[nodiscard]] double extent() const {
        return std::max({high[0] - low[0], high[1] - low[1], high[2] - low[2], 1e-12});
    }
};

/// Evenly chosen frames, the first and the last among them, of which not more than `count` remain.
std::vector<output::Frame> chosen(const std::vector<output::Frame>& frames, std::size_t count) {
    if (frames.size() <= count) return frames;
    std::vector<output::Frame> out;
    for (std::size_t i = 0; i < count; ++i) out.push_back(frames[i * (frames.size() - 1) / (count - 1)]);
    return out;
}

struct Series {
    std::vector<output::Frame> frames;
    std::vector<meshing::SurfaceMesh> surfaces;
};

Series read_series(const RunRecord& run, std::size_t most_bytes) {
    const meshing::SurfaceMesh first = meshing::read_surface(run.folder / run.frames.front().file);
    const std::size_t bytes = std::max<std::size_t>(1, 6 * first.vertices.size());
    Series series{chosen(run.frames, std::max<std::size_t>(2, most_bytes / bytes)), {}};
    for (const output::Frame& frame : series.frames)
        series.surfaces.push_back(meshing::read_surface(run.folder / frame.file));
    return series;
}

Json::Value topology(const RunRecord& run, const Series& series, std::size_t i) {
    const meshing::SurfaceMesh& mesh = series.surfaces[i];
    Json::Value out(Json::objectValue);
    const bool wide = mesh.vertices.size() > std::numeric_limits<std::uint16_t>::max();
    out["wide"] = wide;
    out["triangles"] = wide ? packed_triangles<std::uint32_t>(mesh) : packed_triangles<std::uint16_t>(mesh);
    out["starts"] = starts_of(output::read_arrays(run.folder / series.frames[i].file));
    return out;
}

Json::Value pack(const RunRecord& run, const Series& series) {
    Box box;
    for (const auto& surface : series.surfaces)
        for (const Vec3d& v : surface.vertices) box.include(v);
    constexpr double steps = 32767;
    const double step = box.extent() / 2 / steps;
    Json::Value data(Json::objectValue);
    data["step"] = step;
    data["meshes"] = data["frames"] = data["mesh"] = data["at"] = Json::Value(Json::arrayValue);
    std::vector<std::size_t> kinds;  // the surface that stands for each topology
    for (std::size_t i = 0; i < series.surfaces.size(); ++i) {
        const auto& surface = series.surfaces[i];
        const auto known = std::find_if(kinds.begin(), kinds.end(), [&](std::size_t k) {
            return series.surfaces[k].vertices.size() == surface.vertices.size() &&
                   series.surfaces[k].triangles == surface.triangles;
        });
        data["mesh"].append(static_cast<Json::UInt64>(known - kinds.begin()));
        if (known == kinds.end()) {
            kinds.push_back(i);
            data["meshes"].append(topology(run, series, i));
        }
        std::vector<std::int16_t> positions;
        for (const Vec3d& v : surface.vertices)
            for (const double offset : {v.x - box.middle(0), v.y - box.middle(1), v.z - box.middle(2)})
                positions.push_back(
                    static_cast<std::int16_t>(std::lround(std::clamp(offset / step, -steps, steps))));
        data["frames"].append(packed(positions));
        data["at"].append(series.frames[i].time);
    }
    // a patch that shows how the membrane goes round
    data["mark"] = run.kind == "coupled";
    const FrameLabel label = label_of(run);
    data["label"] = label.name;
    data["unit"] = label.unit;
    return data;
}

}  // namespace

std::string animation(const RunRecord& run, std::size_t most_bytes) {
    if (run.frames.empty()) return "";
    const Series series = read_series(run, most_bytes);
    Json::StreamWriterBuilder writer;
    writer["indentation"] = "";
    writer["precision"] = 8;
    const std::size_t last = series.frames.size() - 1;
    std::string text = fmt::format(
        "<figure class=\"viewer\">\n<figcaption>{}</figcaption>\n"
        "<canvas tabindex=\"0\" role=\"img\" aria-label=\"Surface of the cells. Arrow keys turn the view, "
        "plus and minus "
        "change its size.\"></canvas>\n<div class=\"controls\"><button type=\"button\" class=\"play\" "
        "aria-label=\"Play\"></button><input type=\"range\" min=\"0\" max=\"{}\" value=\"0\" step=\"1\" "
        "aria-label=\"Frame\"><output></output></div>\n<p class=\"note\">Drag or use the arrow keys to turn "
        "the "
        "view.{}{}</p>\n<noscript><p class=\"note\">The animation needs JavaScript.</p></noscript>\n",
        escape(run.name), last,
        run.kind == "coupled" ? " The dark spot is a fixed patch of the membrane." : "",
        series.frames.size() < run.frames.size()
            ? fmt::format(" {} of {} frames, evenly chosen.", series.frames.size(), run.frames.size())
            : "");
    return text + "<script type=\"application/json\">" + Json::writeString(writer, pack(run, series)) +
           "</script>\n</figure>\n";
}

}  // namespace hemoflux::report
