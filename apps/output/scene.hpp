/// What one picture of a run is made of: actors for the cells, the velocity slice, arrows, colour scale and
/// texts.
#pragma once

#include <vtkNew.h>
#include <vtkSmartPointer.h>

#include <array>
#include <string>
#include <vector>

class vtkImageData;
class vtkLookupTable;
class vtkPolyData;
class vtkRectilinearGrid;
class vtkRenderWindow;
class vtkRenderer;

namespace hemoflux::output {

/// One frame as read from the files; either may be null.
struct FrameData {
    double time = 0;
    vtkSmartPointer<vtkPolyData> cells;
    vtkSmartPointer<vtkRectilinearGrid> fluid;
};

/// What stays the same over all pictures of a series.
struct SceneSpec {
    int width = 1200, height = 900;
    std::string time_label;
    std::string array;                       ///< full name of the array shown on the slice; empty: none
    double maximum = 0;                      ///< end of the colour scale
    std::array<double, 6> bounds{};          ///< box the camera shows: x0 x1 y0 y1 z0 z1
    std::vector<long long> marked_vertices;  ///< vertices shown by a small sphere
};

/// An off-screen window that draws frames.
class Scene {
  public:
    /// Opens the window; the process must have a display.
    explicit Scene(SceneSpec spec);
    ~Scene();
    Scene(const Scene&) = delete;
    Scene& operator=(const Scene&) = delete;

    /// Draws one frame as an RGB image.
    vtkSmartPointer<vtkImageData> draw(const FrameData& frame);

  private:
    /// Edges of the box, and the z of the slice: the middle, but behind the cells where there are several.
    void add_outline();
    [[nodiscard]] double slice_z() const;
    void add_slice(vtkRectilinearGrid* fluid);
    void add_arrows(vtkRectilinearGrid* fluid);
    void add_cells(vtkPolyData* cells);
    void add_scale();
    void add_texts(double time);
    void set_camera();

    SceneSpec spec_;
    bool several_ = false;  ///< cells in the frame
    vtkNew<vtkRenderWindow> window_;
    vtkNew<vtkRenderer> renderer_;
    vtkSmartPointer<vtkLookupTable> colours_;
};

}  // namespace hemoflux::output
