/// A white picture on which one tile of a gallery is drawn.
#pragma once

#include <vtkNew.h>
#include <vtkSmartPointer.h>

#include <array>
#include <string>

class vtkImageData;
class vtkPolyData;
class vtkRenderWindow;
class vtkRenderer;

namespace hemoflux::output {

/// A picture in VTK's memory.
using Image = vtkSmartPointer<vtkImageData>;

/// Draws into an off-screen window that all tiles of the process share: displays have few to give.
class TileWindow {
  public:
    /// Size in pixels.
    TileWindow(int width, int height);
    ~TileWindow();
    TileWindow(const TileWindow&) = delete;
    TileWindow& operator=(const TileWindow&) = delete;

    /// What is drawn here is added to it.
    [[nodiscard]] vtkRenderer* renderer() const;
    /// Writes words with their upper edge at y (0 below, 1 on top) beginning at x, or around it.
    void text(const std::string& words, double x, double y, int size, bool centred);
    /// Looks at the middle of a surface from a direction, z upwards; scale: half the height of the picture, um.
    void camera(vtkPolyData* surface, const std::array<double, 3>& from, double scale);
    /// The picture as it is now.
    [[nodiscard]] Image image() const;

  private:
    static vtkRenderWindow* shared();

    vtkNew<vtkRenderer> renderer_;
};

}  // namespace hemoflux::output
