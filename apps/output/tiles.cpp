#include "apps/output/tiles.hpp"

#include <fmt/format.h>
#include <vtkActor.h>
#include <vtkContourTriangulator.h>
#include <vtkCutter.h>
#include <vtkDataArray.h>
#include <vtkImageAppend.h>
#include <vtkImageData.h>
#include <vtkLightKit.h>
#include <vtkLineSource.h>
#include <vtkLookupTable.h>
#include <vtkNew.h>
#include <vtkPlane.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper.h>
#include <vtkPolyDataNormals.h>
#include <vtkProperty.h>
#include <vtkRenderer.h>
#include <vtkScalarBarActor.h>
#include <vtkStripper.h>
#include <vtkTextProperty.h>
#include <vtkXMLPolyDataReader.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "apps/output/palette.hpp"
#include "apps/output/render.hpp"
#include "apps/output/tile_window.hpp"
#include "exchange/error.hpp"

namespace hemoflux::output {
namespace {

constexpr int tile_width = 420;
constexpr int text_size = 19;

/// Surfaces and what all tiles share.
struct Show {
    std::vector<vtkSmartPointer<vtkPolyData>> surfaces;
    std::array<double, 3> half{};  ///< greatest half extents, um
    vtkSmartPointer<vtkLookupTable> colours;
    std::string array;
};

/// The range that holds all but the outermost hundredth of the values at either end.
std::array<double, 2> usual_range(const Show& show) {
    std::vector<double> values;
    for (const auto& surface : show.surfaces)
        if (vtkDataArray* a = surface->GetPointData()->GetArray(show.array.c_str()))
            for (vtkIdType i = 0; i < a->GetNumberOfTuples(); ++i) values.push_back(a->GetTuple1(i));
    if (values.empty()) return {0, 0};
    std::sort(values.begin(), values.end());
    return {values[values.size() / 100], values[values.size() - 1 - values.size() / 100]};
}

Show read_show(const GallerySpec& spec) {
    Show show;
    for (const GalleryItem& item : spec.items) {
        vtkNew<vtkXMLPolyDataReader> reader;
        reader->SetFileName(item.file.c_str());
        reader->Update();
        if (reader->GetOutput()->GetNumberOfPoints() == 0)
            throw FileError("cannot read " + item.file.string(), "it holds no surface", "Run the case anew");
        show.surfaces.emplace_back(reader->GetOutput());
        double b[6];
        show.surfaces.back()->GetBounds(b);
        for (std::size_t a = 0; a < 3; ++a)
            show.half[a] = std::max(show.half[a], 0.5 * (b[2 * a + 1] - b[2 * a]));
    }
    show.array = spec.colour;
    if (!show.array.empty()) {
        const auto [low, high] = usual_range(show);
        show.colours = diverging(low, high);
    }
    return show;
}

vtkNew<vtkActor> coloured_actor(vtkPolyDataMapper* mapper, double r, double g, double b) {
    mapper->ScalarVisibilityOff();
    vtkNew<vtkActor> actor;
    actor->SetMapper(mapper);
    actor->GetProperty()->SetColor(r, g, b);
    return actor;
}

Image draw_surface(vtkPolyData* surface, const Show& show, int height, double scale) {
    TileWindow w(tile_width, height);
    vtkNew<vtkLightKit> lights;
    lights->SetKeyLightIntensity(0.85);
    lights->AddLightsToRenderer(w.renderer());
    vtkNew<vtkPolyDataNormals> normals;
    normals->SetInputData(surface);
    normals->SplittingOff();
    normals->ConsistencyOff();
    vtkNew<vtkPolyDataMapper> mapper;
    mapper->SetInputConnection(normals->GetOutputPort());
    const vtkNew<vtkActor> actor = coloured_actor(mapper, 0.78, 0.13, 0.12);
    if (show.colours && surface->GetPointData()->GetArray(show.array.c_str())) {
        mapper->ScalarVisibilityOn();
        mapper->SetScalarModeToUsePointFieldData();
        mapper->SelectColorArray(show.array.c_str());
        mapper->SetLookupTable(show.colours);
        mapper->UseLookupTableScalarRangeOn();
        mapper->InterpolateScalarsBeforeMappingOn();
    }
    vtkProperty* look = actor->GetProperty();
    look->SetAmbient(0.2);
    look->SetDiffuse(0.8);
    look->SetSpecular(0.12);
    look->SetSpecularPower(25);
    look->SetInterpolationToPhong();
    w.renderer()->AddActor(actor);
    w.camera(surface, {0, -0.72, 0.69}, scale);
    return w.image();
}

Image draw_section(vtkPolyData* surface, int height, double scale, bool with_bar) {
    TileWindow w(tile_width, height);
    double b[6];
    surface->GetBounds(b);
    const double y = 0.5 * (b[2] + b[3]);
    vtkNew<vtkPlane> plane;
    plane->SetOrigin(0.5 * (b[0] + b[1]), y, 0.5 * (b[4] + b[5]));
    plane->SetNormal(0, 1, 0);
    vtkNew<vtkCutter> cut;
    cut->SetInputData(surface);
    cut->SetCutFunction(plane);
    vtkNew<vtkStripper> line;
    line->SetInputConnection(cut->GetOutputPort());
    line->JoinContiguousSegmentsOn();
    vtkNew<vtkContourTriangulator> area;
    area->SetInputConnection(cut->GetOutputPort());
    vtkNew<vtkPolyDataMapper> inside, outline;
    inside->SetInputConnection(area->GetOutputPort());
    outline->SetInputConnection(line->GetOutputPort());
    const vtkNew<vtkActor> fill = coloured_actor(inside, 0.97, 0.86, 0.85);
    fill->GetProperty()->LightingOff();
    fill->SetPosition(0, 0.01, 0);
    const vtkNew<vtkActor> edge = coloured_actor(outline, 0.55, 0.06, 0.06);
    edge->GetProperty()->LightingOff();
    edge->GetProperty()->SetLineWidth(2.5);
    w.renderer()->AddActor(fill);
    w.renderer()->AddActor(edge);
    if (with_bar) {
        const double left = 0.5 * (b[0] + b[1]) - 0.92 * scale * tile_width / height;
        const double low = 0.5 * (b[4] + b[5]) - 0.9 * scale;
        vtkNew<vtkLineSource> bar;
        bar->SetPoint1(left, y - 1, low);
        bar->SetPoint2(left + 2, y - 1, low);
        vtkNew<vtkPolyDataMapper> mapper;
        mapper->SetInputConnection(bar->GetOutputPort());
        const vtkNew<vtkActor> actor = coloured_actor(mapper, 0.1, 0.1, 0.1);
        actor->GetProperty()->SetLineWidth(3);
        actor->GetProperty()->LightingOff();
        w.renderer()->AddActor(actor);
        w.text("2 \xC2\xB5m", 0.04, 0.05 + 1.5 * text_size / height, text_size - 4, false);
    }
    w.camera(surface, {0, -1, 0}, scale);
    return w.image();
}

Image draw_text(const std::string& words, int width, int height, int size) {
    TileWindow w(width, height);
    w.text(words, 0.5, 0.9, size, true);
    return w.image();
}

Image draw_scale(const Show& show, const std::string& legend, int width) {
    constexpr int height = 96;
    TileWindow w(width, height);
    vtkNew<vtkScalarBarActor> bar;
    bar->SetLookupTable(show.colours);
    bar->SetOrientationToHorizontal();
    bar->SetNumberOfLabels(5);
    bar->SetLabelFormat("%.2g");
    bar->SetTitle("");
    bar->UnconstrainedFontSizeOn();
    bar->GetLabelTextProperty()->SetColor(0.1, 0.1, 0.1);
    bar->GetLabelTextProperty()->SetFontSize(text_size - 4);
    bar->GetLabelTextProperty()->ShadowOff();
    bar->GetLabelTextProperty()->ItalicOff();
    bar->GetLabelTextProperty()->BoldOff();
    bar->SetPosition(0.25, 0.02);
    bar->SetWidth(0.5);
    bar->SetHeight(0.6);
    bar->SetBarRatio(0.4);
    w.renderer()->AddActor2D(bar);
    w.text(legend, 0.5, 0.97, text_size - 1, true);
    return w.image();
}

/// Images side by side (axis 0) or, the first on top, below each other (axis 1).
Image joined(std::vector<Image> images, int axis) {
    if (axis == 1) std::reverse(images.begin(), images.end());  // VTK's images begin at the bottom
    vtkNew<vtkImageAppend> append;
    append->SetAppendAxis(axis);
    for (const Image& image : images) append->AddInputData(image);
    append->Update();
    return append->GetOutput();
}

int lines_of(const std::string& text) { return 1 + int(std::count(text.begin(), text.end(), '\n')); }

}  // namespace

void render_gallery(const GallerySpec& spec, const std::filesystem::path& png) {
    const Show show = read_show(spec);
    const auto columns = static_cast<std::size_t>(
        std::clamp(spec.columns, 1, std::max(1, static_cast<int>(spec.items.size()))));
    const auto [x, y, z] = show.half;
    // um per pixel from the width of the widest surface seen a little from the side; heights follow
    const double um = 2.25 * x / tile_width;
    const int above = std::max(120, static_cast<int>(2.3 * (0.69 * y + 0.72 * z) / um));
    const int below = std::max(90, static_cast<int>(2.5 * z / um));
    int lines = 1;
    for (const GalleryItem& item : spec.items) lines = std::max(lines, lines_of(item.caption));
    const int words = static_cast<int>(1.3 * text_size * lines) + 14;

    std::vector<Image> rows{draw_text(spec.title, tile_width * static_cast<int>(columns), 52, 26)};
    for (std::size_t first = 0; first < spec.items.size(); first += columns) {
        std::vector<Image> row;
        for (std::size_t i = first; i < first + columns; ++i) {
            if (i >= spec.items.size()) {
                row.push_back(draw_text("", tile_width, words + above + below, text_size));
                continue;
            }
            row.push_back(joined({draw_text(spec.items[i].caption, tile_width, words, text_size),
                                  draw_surface(show.surfaces[i], show, above, 0.5 * above * um),
                                  draw_section(show.surfaces[i], below, 0.5 * below * um, i == 0)},
                                 1));
        }
        rows.push_back(joined(row, 0));
    }
    if (show.colours) rows.push_back(draw_scale(show, spec.legend, tile_width * static_cast<int>(columns)));
    write_png(png, joined(rows, 1));
}

}  // namespace hemoflux::output
