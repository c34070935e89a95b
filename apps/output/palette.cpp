#include "apps/output/palette.hpp"

#include <vtkColorTransferFunction.h>
#include <vtkNew.h>

#include <algorithm>
#include <cmath>
#include <iterator>

namespace hemoflux::output {

namespace {

/// The colours of a scale between two of its values.
vtkSmartPointer<vtkLookupTable> table_of(vtkColorTransferFunction* scale, double low, double high) {
    auto table = vtkSmartPointer<vtkLookupTable>::New();
    constexpr int n = 256;
    table->SetNumberOfTableValues(n);
    table->SetRange(low, high);
    for (int i = 0; i < n; ++i) {
        double rgb[3];
        scale->GetColor(low + (high - low) * i / (n - 1), rgb);
        table->SetTableValue(i, rgb[0], rgb[1], rgb[2]);
    }
    return table;
}

}  // namespace

vtkSmartPointer<vtkLookupTable> blues(double maximum) {
    vtkNew<vtkColorTransferFunction> scale;
    scale->SetColorSpaceToLab();
    scale->AddRGBPoint(0.0, 0.97, 0.98, 1.0);
    scale->AddRGBPoint(0.5, 0.55, 0.77, 0.90);
    scale->AddRGBPoint(1.0, 0.13, 0.44, 0.71);
    auto table = table_of(scale, 0, 1);
    table->SetVectorModeToMagnitude();
    table->SetRange(0, maximum > 0 ? maximum : 1);
    return table;
}

vtkSmartPointer<vtkLookupTable> diverging(double low, double high) {
    vtkNew<vtkColorTransferFunction> scale;
    scale->SetColorSpaceToLab();
    const double limit = std::max({std::abs(low), std::abs(high), 1e-12});
    scale->AddRGBPoint(-limit, 0.10, 0.30, 0.65);
    scale->AddRGBPoint(0, 0.96, 0.94, 0.90);
    scale->AddRGBPoint(limit, 0.75, 0.10, 0.12);
    return table_of(scale, low < 0 ? -limit : 0, limit);
}

vtkSmartPointer<vtkLookupTable> reds() {
    constexpr double shades[][3] = {{0.78, 0.13, 0.12}, {0.93, 0.45, 0.32}, {0.55, 0.05, 0.16},
                                    {0.88, 0.28, 0.18}, {0.68, 0.25, 0.28}, {0.96, 0.60, 0.45}};
    auto table = vtkSmartPointer<vtkLookupTable>::New();
    constexpr int copies = 100, n = std::size(shades);
    table->SetNumberOfTableValues(copies * n);
    for (int i = 0; i < copies * n; ++i)
        table->SetTableValue(i, shades[i % n][0], shades[i % n][1], shades[i % n][2]);
    table->SetRange(-0.5, copies * n - 0.5);
    return table;
}

}  // namespace hemoflux::output
