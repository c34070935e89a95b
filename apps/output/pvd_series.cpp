#include "apps/output/pvd_series.hpp"

#include <fmt/format.h>
#include <vtkSmartPointer.h>
#include <vtkXMLDataElement.h>
#include <vtkXMLUtilities.h>

#include <cmath>

#include "apps/output/atomic_file.hpp"
#include "exchange/error.hpp"
#include "meshing/vtk_listener.hpp"

namespace hemoflux::output {
namespace {

InputError malformed(const std::filesystem::path& path, const std::string& why) {
    return {"malformed series " + path.string(), why, "Restore the file, or run the case anew"};
}

}  // namespace

std::vector<Frame> read_pvd(const std::filesystem::path& path) {
    const std::string content = read_file(path);
    const meshing::VtkSilence silence;
    const auto root = vtkSmartPointer<vtkXMLDataElement>::Take(
        content.empty() ? nullptr : vtkXMLUtilities::ReadElementFromString(content.c_str()));
    vtkXMLDataElement* collection = root ? root->FindNestedElementWithName("Collection") : nullptr;
    if (!collection) throw malformed(path, "it is not a .pvd file");
    std::vector<Frame> frames;
    for (int i = 0; i < collection->GetNumberOfNestedElements(); ++i) {
        vtkXMLDataElement* element = collection->GetNestedElement(i);
        double time = NAN;
        const char* file = element->GetAttribute("file");
        if (!file || !element->GetScalarAttribute("timestep", time))
            throw malformed(path, fmt::format("entry {} has no file or no timestep", i + 1));
        frames.push_back({time, file});
    }
    return frames;
}

PvdSeries PvdSeries::resume(std::filesystem::path path, double last_time) {
    PvdSeries series(std::move(path));
    if (!std::filesystem::exists(series.path_)) return series;
    series.frames_ = read_pvd(series.path_);
    std::erase_if(series.frames_, [last_time](const Frame& frame) { return frame.time > last_time; });
    return series;
}

void PvdSeries::add(double time, const std::filesystem::path& file) {
    frames_.push_back({time, file.lexically_proximate(path_.parent_path()).generic_string()});
    std::string text =
        "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"0.1\" byte_order=\"LittleEndian\">\n"
        "  <Collection>\n";
    for (const Frame& frame : frames_)
        text +=
            fmt::format("    <DataSet timestep=\"{}\" part=\"0\" file=\"{}\"/>\n", frame.time, frame.file);
    write_file(path_, text + "  </Collection>\n</VTKFile>\n");
}

}  // namespace hemoflux::output
