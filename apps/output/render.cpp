#include "apps/output/render.hpp"

#include <fmt/format.h>
#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkErrorCode.h>
#include <vtkImageAppend.h>
#include <vtkImageData.h>
#include <vtkImageResize.h>
#include <vtkPNGWriter.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkRectilinearGrid.h>
#include <vtkUnsignedCharArray.h>
#include <vtkXMLPolyDataReader.h>
#include <vtkXMLRectilinearGridReader.h>

#include <algorithm>
#include <cmath>

#include "apps/output/atomic_file.hpp"
#include "apps/output/pvd_series.hpp"
#include "apps/output/scene.hpp"
#include "exchange/error.hpp"

namespace hemoflux::output {
namespace fs = std::filesystem;
namespace {

template <class Reader>
auto read(const fs::path& path) {
    vtkNew<Reader> reader;
    reader->SetFileName(path.c_str());
    reader->Update();
    if (reader->GetErrorCode() != vtkErrorCode::NoError || reader->GetOutput()->GetNumberOfPoints() == 0)
        throw FileError("cannot read " + path.string(),
                        vtkErrorCode::GetStringFromErrorCode(reader->GetErrorCode()), "Run the case anew");
    return vtkSmartPointer(reader->GetOutput());
}

/// At most count frames, evenly spread, the first and the last among them.
std::vector<Frame> choose(const std::vector<Frame>& frames, int count) {
    if (static_cast<int>(frames.size()) <= count) return frames;
    std::vector<Frame> chosen;
    for (int i = 0; i < count; ++i)
        chosen.push_back(frames[count == 1 ? frames.size() - 1 : i * (frames.size() - 1) / (count - 1)]);
    return chosen;
}

std::vector<FrameData> read_frames(const fs::path& folder, int count) {
    const auto series = [&](const char* name) {
        return fs::exists(folder / name) ? read_pvd(folder / name) : std::vector<Frame>{};
    };
    const auto cells = series("cells.pvd"), fluid = series("fluid.pvd");
    if (cells.empty() && fluid.empty())
        throw InputError("no frames in " + folder.string(), "neither cells.pvd nor fluid.pvd names a file",
                         "Set an output interval in the case");
    std::vector<FrameData> frames;
    for (const Frame& frame : choose(cells.empty() ? fluid : cells, count)) {
        FrameData& data = frames.emplace_back();
        data.time = frame.time;
        if (!cells.empty()) data.cells = read<vtkXMLPolyDataReader>(folder / frame.file);
        const auto same_time =
            std::find_if(fluid.begin(), fluid.end(), [&](const Frame& f) { return f.time == frame.time; });
        if (same_time != fluid.end())
            data.fluid = read<vtkXMLRectilinearGridReader>(folder / same_time->file);
    }
    return frames;
}

void include(std::array<double, 6>& bounds, const double* other) {
    for (int a = 0; a < 3; ++a) {
        bounds[2 * a] = std::min(bounds[2 * a], other[2 * a]);
        bounds[2 * a + 1] = std::max(bounds[2 * a + 1], other[2 * a + 1]);
    }
}

/// Camera box and colour scale over all frames, the same in every picture.
SceneSpec scene_spec(const std::vector<FrameData>& frames, const PictureSpec& spec) {
    SceneSpec scene{spec.width, spec.height, spec.time_label, {}, 0, {}, {}};
    scene.bounds = {INFINITY, -INFINITY, INFINITY, -INFINITY, INFINITY, -INFINITY};
    for (const FrameData& frame : frames) {
        if (!frame.fluid) {
            if (!frames.front().fluid) include(scene.bounds, frame.cells->GetBounds());
            continue;
        }
        include(scene.bounds, frame.fluid->GetBounds());
        vtkCellData* data = frame.fluid->GetCellData();
        for (int a = 0; a < data->GetNumberOfArrays(); ++a)
            if (std::string(data->GetArrayName(a)).starts_with(spec.slice)) {
                scene.array = data->GetArrayName(a);
                scene.maximum = std::max(scene.maximum, data->GetArray(a)->GetRange(-1)[1]);
                break;
            }
    }
    return scene;
}

/// The vertex of each cell that lies farthest towards x and the camera (z).
std::vector<long long> farthest_vertices(vtkPolyData* cells) {
    vtkDataArray* index = cells->GetPointData()->GetArray("cell");
    std::vector<long long> marked;
    for (vtkIdType p = 0; p < cells->GetNumberOfPoints(); ++p) {
        const auto c = static_cast<std::size_t>(index ? index->GetTuple1(p) : 0);
        if (c >= marked.size()) marked.resize(c + 1, p);
        const auto reach = [cells](vtkIdType q) { return cells->GetPoint(q)[0] + cells->GetPoint(q)[2]; };
        if (reach(p) > reach(marked[c])) marked[c] = p;
    }
    return marked;
}

/// All pictures side by side, three in a row, at half their size.
vtkSmartPointer<vtkImageData> montage(const std::vector<vtkSmartPointer<vtkImageData>>& images) {
    constexpr std::size_t across = 3;
    vtkNew<vtkImageAppend> rows;
    rows->SetAppendAxis(1);
    // VTK's images begin at the bottom
    for (std::size_t row = (images.size() + across - 1) / across; row-- > 0;) {
        vtkNew<vtkImageAppend> line;
        line->SetAppendAxis(0);
        for (std::size_t i = row * across; i < std::min(images.size(), (row + 1) * across); ++i) {
            vtkNew<vtkImageResize> half;
            half->SetInputData(images[i]);
            half->SetResizeMethodToMagnificationFactors();
            half->SetMagnificationFactors(0.5, 0.5, 1);
            half->Update();
            line->AddInputData(half->GetOutput());
        }
        line->Update();
        rows->AddInputData(line->GetOutput());
    }
    rows->Update();
    return rows->GetOutput();
}

}  // namespace

void write_png(const fs::path& path, vtkImageData* image) {
    vtkNew<vtkPNGWriter> writer;
    writer->SetInputData(image);
    writer->WriteToMemoryOn();
    writer->Write();
    vtkUnsignedCharArray* png = writer->GetResult();
    write_file(path, {reinterpret_cast<const char*>(png->GetPointer(0)),
                      static_cast<std::size_t>(png->GetNumberOfValues())});
}

void render_pictures(const fs::path& folder, const PictureSpec& spec) {
    const auto frames = read_frames(folder, std::max(spec.count, 1));
    SceneSpec scene = scene_spec(frames, spec);
    if (frames.front().cells) scene.marked_vertices = farthest_vertices(frames.front().cells);
    Scene window(scene);
    std::vector<vtkSmartPointer<vtkImageData>> images;
    for (const FrameData& frame : frames) {
        images.push_back(window.draw(frame));
        write_png(folder / fmt::format("picture_{:02}.png", images.size()), images.back());
    }
    if (images.size() > 1) write_png(folder / "picture_series.png", montage(images));
}

}  // namespace hemoflux::output
