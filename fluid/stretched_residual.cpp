// The residual by tiles on grids whose cells are no cubes.
#include "fluid/launch_tiles.hpp"

namespace hemoflux::fluid {

template <bool Viscosity, bool Force, bool Preconditioned>
void launch_stretched_tiles(const Balance<Features<false, Viscosity, Force, Preconditioned>>& balance) {
    if constexpr (!exchange::on_gpu) launch_tiles(balance);
}

template void launch_stretched_tiles(const Balance<Features<false, false, false, false>>&);
template void launch_stretched_tiles(const Balance<Features<false, false, false, true>>&);
template void launch_stretched_tiles(const Balance<Features<false, false, true, false>>&);
template void launch_stretched_tiles(const Balance<Features<false, false, true, true>>&);
template void launch_stretched_tiles(const Balance<Features<false, true, false, false>>&);
template void launch_stretched_tiles(const Balance<Features<false, true, false, true>>&);
template void launch_stretched_tiles(const Balance<Features<false, true, true, false>>&);
template void launch_stretched_tiles(const Balance<Features<false, true, true, true>>&);

}  // namespace hemoflux::fluid
