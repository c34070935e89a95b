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

}  // namespace hemoflux::fluid
