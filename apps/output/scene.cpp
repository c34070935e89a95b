#include "apps/output/scene.hpp"

#include <fmt/format.h>
#include <vtkActor.h>
#include <vtkArrowSource.h>
#include <vtkCamera.h>
#include <vtkCellDataToPointData.h>
#include <vtkCutter.h>
#include <vtkDataSetMapper.h>
#include <vtkGlyph3D.h>
#include <vtkImageData.h>
#include <vtkLightKit.h>
#include <vtkLookupTable.h>
#include <vtkOutlineSource.h>
#include <vtkPlane.h>
#include <vtkPlaneSource.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper.h>
#include <vtkPolyDataNormals.h>
#include <vtkProbeFilter.h>
#include <vtkProperty.h>
#include <vtkRectilinearGrid.h>
#include <vtkRenderWindow.h>
#include <vtkRenderer.h>
#include <vtkScalarBarActor.h>
#include <vtkSphereSource.h>
#include <vtkTextActor.h>
#include <vtkTextProperty.h>
#include <vtkWindowToImageFilter.h>

#include <algorithm>
#include <cmath>

#include "apps/output/palette.hpp"

namespace hemoflux::output {
namespace {

long long number_of_cells(vtkPolyData* cells) {
    vtkDataArray* index = cells->GetPointData()->GetArray("cell");
    return index && index->GetNumberOfTuples() > 0 ? 1 + static_cast<long long>(index->GetRange()[1]) : 1;
}

/// "velocity_um_per_s" as people write it: "velocity, um/s".
std::string caption(const std::string& name) {
    const auto unit = name.find('_');
    if (unit == std::string::npos) return name;
    std::string rest = name.substr(unit + 1);
    const auto per = rest.find("_per_");
    if (per != std::string::npos) rest = fmt::format("{}/{}", rest.substr(0, per), rest.substr(per + 5));
    std::replace(rest.begin(), rest.end(), '_', ' ');
    return fmt::format("{}, {}", name.substr(0, unit), rest);
}

double middle(const std::array<double, 6>& bounds, int axis) {
    return (bounds[2 * axis] + bounds[2 * axis + 1]) / 2;
}
double extent(const std::array<double, 6>& bounds, int axis) {
    return bounds[2 * axis + 1] - bounds[2 * axis];
}

void style(vtkTextProperty* text, int size) {
    text->SetColor(0.1, 0.1, 0.1);
    text->SetFontSize(size);
    text->SetFontFamilyToArial();
    text->BoldOff();
    text->ItalicOff();
    text->ShadowOff();
}

}  // namespace

Scene::Scene(SceneSpec spec) : spec_(std::move(spec)), colours_(blues(spec_.maximum)) {
    window_->SetOffScreenRendering(1);
    window_->SetSize(spec_.width, spec_.height);
    window_->SetMultiSamples(8);
    window_->AddRenderer(renderer_);
    renderer_->SetBackground(1, 1, 1);
    vtkNew<vtkLightKit> lights;
    lights->SetKeyLightIntensity(0.9);
    lights->AddLightsToRenderer(renderer_);
}

Scene::~Scene() = default;

vtkSmartPointer<vtkImageData> Scene::draw(const FrameData& frame) {
    renderer_->RemoveAllViewProps();
    several_ = frame.cells && number_of_cells(frame.cells) > 1;
    if (frame.fluid && !spec_.array.empty()) {
        if (several_) add_outline();
        add_slice(frame.fluid);
        add_arrows(frame.fluid);
        add_scale();
    }
    if (frame.cells) add_cells(frame.cells);
    add_texts(frame.time);
    set_camera();
    window_->Render();
    vtkNew<vtkWindowToImageFilter> image;
    image->SetInput(window_);
    image->ReadFrontBufferOff();
    image->Update();
    auto copy = vtkSmartPointer<vtkImageData>::New();
    copy->DeepCopy(image->GetOutput());
    return copy;
}

void Scene::add_outline() {
    vtkNew<vtkOutlineSource> box;
    box->SetBounds(spec_.bounds.data());
    vtkNew<vtkPolyDataMapper> mapper;
    mapper->SetInputConnection(box->GetOutputPort());
    vtkNew<vtkActor> actor;
    actor->SetMapper(mapper);
    actor->GetProperty()->SetColor(0.45, 0.45, 0.5);
    actor->GetProperty()->SetLineWidth(1.5);
    actor->GetProperty()->LightingOff();
    renderer_->AddActor(actor);
}

double Scene::slice_z() const {
    // just inside the box, so that the cut finds cells
    return several_ ? spec_.bounds[4] + 1e-3 * extent(spec_.bounds, 2) : middle(spec_.bounds, 2);
}

void Scene::add_slice(vtkRectilinearGrid* fluid) {
    vtkNew<vtkCellDataToPointData> points;
    points->SetInputData(fluid);
    vtkNew<vtkPlane> plane;
    plane->SetOrigin(middle(spec_.bounds, 0), middle(spec_.bounds, 1), slice_z());
    plane->SetNormal(0, 0, 1);
    vtkNew<vtkCutter> cut;
    cut->SetInputConnection(points->GetOutputPort());
    cut->SetCutFunction(plane);
    vtkNew<vtkPolyDataMapper> mapper;
    mapper->SetInputConnection(cut->GetOutputPort());
    mapper->SetScalarModeToUsePointFieldData();
    mapper->SelectColorArray(spec_.array.c_str());
    mapper->SetLookupTable(colours_);
    mapper->UseLookupTableScalarRangeOn();
    mapper->InterpolateScalarsBeforeMappingOn();
    vtkNew<vtkActor> actor;
    actor->SetMapper(mapper);
    actor->GetProperty()->LightingOff();
    renderer_->AddActor(actor);
}

void Scene::add_arrows(vtkRectilinearGrid* fluid) {
    vtkNew<vtkCellDataToPointData> points;
    points->SetInputData(fluid);
    points->Update();
    vtkDataArray* values = points->GetOutput()->GetPointData()->GetArray(spec_.array.c_str());
    if (!values || values->GetNumberOfComponents() != 3 || spec_.maximum <= 0) return;
    // a lattice of its own: the grid's cells are too many and crowd where it is fine
    constexpr int n = 11;
    const auto& b = spec_.bounds;
    const double mx = extent(b, 0) / (2 * n), my = extent(b, 1) / (2 * n), z = slice_z();
    vtkNew<vtkPlaneSource> lattice;
    lattice->SetOrigin(b[0] + mx, b[2] + my, z);
    lattice->SetPoint1(b[1] - mx, b[2] + my, z);
    lattice->SetPoint2(b[0] + mx, b[3] - my, z);
    lattice->SetResolution(n - 1, n - 1);
    vtkNew<vtkProbeFilter> probe;
    probe->SetInputConnection(lattice->GetOutputPort());
    probe->SetSourceConnection(points->GetOutputPort());
    probe->Update();
    vtkDataSet* probed = probe->GetOutput();
    probed->GetPointData()->SetActiveVectors(spec_.array.c_str());
    vtkNew<vtkArrowSource> arrow;
    arrow->SetArrowOriginToCenter();
    arrow->SetTipLength(0.3);
    arrow->SetTipRadius(0.1);
    arrow->SetShaftRadius(0.03);
    vtkNew<vtkGlyph3D> glyphs;
    glyphs->SetInputData(probed);
    glyphs->SetSourceConnection(arrow->GetOutputPort());
    glyphs->SetVectorModeToUseVector();
    glyphs->SetScaleModeToScaleByVector();
    glyphs->SetScaleFactor(0.9 * extent(b, 0) / n / spec_.maximum);
    vtkNew<vtkPolyDataMapper> mapper;
    mapper->SetInputConnection(glyphs->GetOutputPort());
    mapper->ScalarVisibilityOff();
    vtkNew<vtkActor> actor;
    actor->SetMapper(mapper);
    actor->GetProperty()->SetColor(0.25, 0.25, 0.28);
    actor->GetProperty()->LightingOff();
    renderer_->AddActor(actor);
}

void Scene::add_cells(vtkPolyData* cells) {
    vtkNew<vtkPolyDataNormals> normals;
    normals->SetInputData(cells);
    normals->SplittingOff();
    normals->ConsistencyOff();
    vtkNew<vtkPolyDataMapper> mapper;
    mapper->SetInputConnection(normals->GetOutputPort());
    if (several_) {
        mapper->SetScalarModeToUsePointFieldData();
        mapper->SelectColorArray("cell");
        mapper->SetLookupTable(reds());
        mapper->UseLookupTableScalarRangeOn();
    } else {
        mapper->ScalarVisibilityOff();
    }
    vtkNew<vtkActor> actor;
    actor->SetMapper(mapper);
    vtkProperty* look = actor->GetProperty();
    look->SetColor(0.78, 0.13, 0.12);
    look->SetAmbient(0.18);
    look->SetDiffuse(0.85);
    look->SetSpecular(0.15);
    look->SetSpecularPower(25);
    look->SetInterpolationToPhong();
    renderer_->AddActor(actor);

    for (const long long vertex : spec_.marked_vertices) {
        if (vertex >= cells->GetNumberOfPoints()) continue;
        vtkNew<vtkSphereSource> sphere;
        sphere->SetCenter(cells->GetPoint(vertex));
        sphere->SetRadius(0.22);
        sphere->SetThetaResolution(24);
        sphere->SetPhiResolution(24);
        vtkNew<vtkPolyDataMapper> dot;
        dot->SetInputConnection(sphere->GetOutputPort());
        vtkNew<vtkActor> mark;
        mark->SetMapper(dot);
        mark->GetProperty()->SetColor(1.0, 0.85, 0.1);
        mark->GetProperty()->SetAmbient(0.4);
        renderer_->AddActor(mark);
    }
}

void Scene::add_scale() {
    vtkNew<vtkScalarBarActor> bar;
    bar->SetLookupTable(colours_);
    bar->SetTitle(fmt::format("{}\n ", caption(spec_.array)).c_str());
    bar->SetNumberOfLabels(5);
    bar->SetLabelFormat("%.3g");
    bar->UnconstrainedFontSizeOn();
    style(bar->GetTitleTextProperty(), spec_.height / 45);
    style(bar->GetLabelTextProperty(), spec_.height / 50);
    bar->SetPosition(0.885, 0.22);
    bar->SetWidth(0.10);
    bar->SetHeight(0.56);
    bar->SetBarRatio(0.22);
    renderer_->AddActor2D(bar);
}

void Scene::add_texts(double time) {
    vtkNew<vtkTextActor> label;
    label->SetInput(fmt::format("{} {:.3g}", spec_.time_label, time).c_str());
    style(label->GetTextProperty(), spec_.height / 28);
    label->GetPositionCoordinate()->SetCoordinateSystemToNormalizedViewport();
    label->SetPosition(0.03, 0.945);
    renderer_->AddActor2D(label);
    vtkNew<vtkTextActor> size;
    size->SetInput(fmt::format("{:.3g} x {:.3g} x {:.3g} um", extent(spec_.bounds, 0),
                               extent(spec_.bounds, 1), extent(spec_.bounds, 2))
                       .c_str());
    style(size->GetTextProperty(), spec_.height / 45);
    size->GetPositionCoordinate()->SetCoordinateSystemToNormalizedViewport();
    size->SetPosition(0.03, 0.015);
    renderer_->AddActor2D(size);
}

void Scene::set_camera() {
    const auto& b = spec_.bounds;
    vtkCamera* camera = renderer_->GetActiveCamera();
    // outside everything drawn; with a parallel projection the distance changes nothing else
    const double distance = 2 * (extent(b, 0) + extent(b, 1) + extent(b, 2));
    camera->ParallelProjectionOn();
    camera->SetFocalPoint(middle(b, 0), middle(b, 1), middle(b, 2));
    camera->SetPosition(middle(b, 0), middle(b, 1), middle(b, 2) + distance);
    camera->SetViewUp(0, 1, 0);
    camera->Azimuth(-18);
    camera->Elevation(16);
    camera->OrthogonalizeViewUp();
    // of several cells the whole box is seen, obliquely
    const double depth = several_ ? 0.31 * extent(b, 2) : 0;
    camera->SetParallelScale(
        0.58 * std::max(extent(b, 1) + depth, 1.15 * (extent(b, 0) + depth) * spec_.height / spec_.width));
    // a little to the left, for the colour scale
    camera->SetWindowCenter(0.06, 0);
    renderer_->ResetCameraClippingRange();
}

}  // namespace hemoflux::output
