#include "apps/output/tile_window.hpp"

#include <vtkCamera.h>
#include <vtkImageData.h>
#include <vtkPolyData.h>
#include <vtkRenderWindow.h>
#include <vtkRenderer.h>
#include <vtkTextActor.h>
#include <vtkTextProperty.h>
#include <vtkWindowToImageFilter.h>

namespace hemoflux::output {

vtkRenderWindow* TileWindow::shared() {
    static const vtkSmartPointer<vtkRenderWindow> window = [] {
        auto made = vtkSmartPointer<vtkRenderWindow>::New();
        made->SetOffScreenRendering(1);
        made->SetMultiSamples(8);
        return made;
    }();
    return window;
}

TileWindow::TileWindow(int width, int height) {
    shared()->SetSize(width, height);
    shared()->AddRenderer(renderer_);
    renderer_->SetBackground(1, 1, 1);
}

TileWindow::~TileWindow() { shared()->RemoveRenderer(renderer_); }

vtkRenderer* TileWindow::renderer() const { return renderer_; }

void TileWindow::text(const std::string& words, double x, double y, int size, bool centred) {
    vtkNew<vtkTextActor> actor;
    actor->SetInput(words.c_str());
    vtkTextProperty* look = actor->GetTextProperty();
    look->SetColor(0.1, 0.1, 0.1);
    look->SetFontSize(size);
    look->SetFontFamilyToArial();
    look->SetLineSpacing(1.15);
    look->SetVerticalJustificationToTop();
    if (centred) look->SetJustificationToCentered();
    actor->GetPositionCoordinate()->SetCoordinateSystemToNormalizedViewport();
    actor->SetPosition(x, y);
    renderer_->AddActor2D(actor);
}

void TileWindow::camera(vtkPolyData* surface, const std::array<double, 3>& from, double scale) {
    double b[6];
    surface->GetBounds(b);
    const double x = 0.5 * (b[0] + b[1]), y = 0.5 * (b[2] + b[3]), z = 0.5 * (b[4] + b[5]);
    vtkCamera* camera = renderer_->GetActiveCamera();
    camera->ParallelProjectionOn();
    camera->SetFocalPoint(x, y, z);
    camera->SetPosition(x + 100 * from[0], y + 100 * from[1], z + 100 * from[2]);
    camera->SetViewUp(0, 0, 1);
    camera->SetParallelScale(scale);
    renderer_->ResetCameraClippingRange();
}

Image TileWindow::image() const {
    shared()->Render();
    vtkNew<vtkWindowToImageFilter> grab;
    grab->SetInput(shared());
    grab->ReadFrontBufferOff();
    grab->Update();
    auto copy = Image::New();
    copy->DeepCopy(grab->GetOutput());
    return copy;
}

}  // namespace hemoflux::output
