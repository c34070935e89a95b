#include "coupling/delta_kernel.hpp"

#include "exchange/error.hpp"

namespace hemoflux::coupling {

Kernel kernel_named(const std::string& name) {
    if (name == "phi2") return Kernel::phi2;
    if (name == "phi3") return Kernel::phi3;
    if (name == "phi4") return Kernel::phi4;
    if (name == "lagrange") return Kernel::lagrange;
    throw InputError("kernel \"" + name + "\"", "there is no such immersed boundary kernel",
                     "choose phi2, phi3, phi4 or lagrange");
}

}  // namespace hemoflux::coupling
