#include "fluid/host_fields.hpp"

namespace hemoflux::fluid {

HostFields host_fields(const Solver& solver) {
    const StateView& view = solver.state().view();
    solver.boundary().fill(solver.grid().view(), view);
    HostFields fields{solver.grid().view().layout, {}};
    for (std::size_t c = 0; c < 4; ++c) {
        fields.q[c].resize(fields.layout.size);
        exchange::copy_to_host(fields.q[c].data(), view.q[c], fields.layout.size * sizeof(double));
    }
    return fields;
}

std::vector<double> ghosted_centres(const Grid& grid, std::size_t axis) {
    const auto& widths = grid.ghosted_widths(static_cast<int>(axis));
    double face = grid.rectilinear().axes[axis].lower();
    for (std::size_t g = 0; g < exchange::ghosts; ++g) face -= widths[g];
    std::vector<double> centres;
    for (const double w : widths) centres.push_back(face + w / 2), face += w;
    return centres;
}

}  // namespace hemoflux::fluid
