#include "apps/cell_file.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "exchange/error.hpp"

namespace hemoflux::apps {
namespace {

using output::DataArray;

const DataArray* find(const std::vector<DataArray>& arrays, const std::string& name) {
    const auto found =
        std::find_if(arrays.begin(), arrays.end(), [&](const DataArray& a) { return a.name == name; });
    return found == arrays.end() ? nullptr : &*found;
}

const std::vector<double>& need(const std::vector<DataArray>& arrays, const std::string& name,
                                std::size_t size, const std::filesystem::path& path) {
    const DataArray* array = find(arrays, name);
    if (array == nullptr || array->values.size() != size)
        throw InputError(
            fmt::format("{}: {}", path.string(),
                        array == nullptr ? fmt::format("no array {}", name)
                                         : fmt::format("{} numbers in {}", array->values.size(), name)),
            fmt::format("the references of this mesh have {} there", size),
            "Use a file that hemoflux mesh rbc or hemoflux membrane has written, or choose another "
            "reference");
    return array->values;
}

std::vector<double> edge_vertices(const membrane::Topology& topology) {
    std::vector<double> ends;
    for (const membrane::Edge& e : topology.edges()) ends.insert(ends.end(), {1.0 * e.v1, 1.0 * e.v2});
    return ends;
}

}  // namespace

void write_cell(const std::filesystem::path& path, const membrane::Topology& topology,
                const membrane::Reference& reference, const std::vector<Vec3d>& positions, double time,
                std::vector<DataArray> point_data, std::vector<DataArray> triangle_data) {
    triangle_data.push_back({"rest_area_um2", 1, reference.triangle_areas});
    const std::vector<DataArray> fields{{"edge_vertices", 2, edge_vertices(topology)},
                                        {"rest_length_um", 1, reference.edge_lengths},
                                        {"rest_surface_um2", 1, {reference.area}},
                                        {"rest_volume_um3", 1, {reference.volume}},
                                        {"rest_curvature_per_um", 1, {reference.curvature}},
                                        {"rest_total_curvature_um", 1, {reference.total_curvature}},
                                        {"stretch_ratio", 1, {reference.stretch_ratio}}};
    output::write_cells(path, {{positions, topology.triangles()}}, point_data, time, triangle_data, fields);
}

bool has_reference(const std::filesystem::path& path) {
    return find(output::read_arrays(path).field, "rest_length_um") != nullptr;
}

membrane::Reference read_reference(const std::filesystem::path& path, const membrane::Topology& topology) {
    const output::SurfaceArrays arrays = output::read_arrays(path);
    const auto scalar = [&](const char* name) { return need(arrays.field, name, 1, path).front(); };
    const std::size_t edges = topology.edges().size();
    membrane::Reference r;
    r.edge_lengths = need(arrays.field, "rest_length_um", edges, path);
    r.triangle_areas = need(arrays.triangle, "rest_area_um2", topology.triangles().size(), path);
    r.area = scalar("rest_surface_um2");
    r.volume = scalar("rest_volume_um3");
    r.curvature = scalar("rest_curvature_per_um");
    r.total_curvature = scalar("rest_total_curvature_um");
    r.stretch_ratio = scalar("stretch_ratio");
    if (need(arrays.field, "edge_vertices", 2 * edges, path) != edge_vertices(topology))
        throw InputError(fmt::format("{}: its references", path.string()),
                         "their edges are not those of its triangles",
                         "Write the file anew with hemoflux mesh rbc");
    r.check(topology);
    return r;
}

}  // namespace hemoflux::apps
