// The example case that the tests vary.
#pragma once

#include <string>

namespace hemoflux::apps {

inline const std::string example_case = R"(title = "Tank treading at 3 /s"
kind = "coupled"                       # coupled | fluid | membrane
[fluid]
density = "1000 kg/m^3"
viscosity = "22 mPa s"
[grid]
kind = "plateau"
length = ["12 um", "12 um", "12 um"]
cells = [30, 30, 30]
plateau = { a = 10, b = 0.2 }
[boundary]
"x" = "periodic"
"z" = "periodic"
"y-" = { velocity = "shear", density = "zero-gradient" }
"y+" = { velocity = "shear", density = "zero-gradient" }
[shear]
rate = "3 1/s"
[[cell]]
mesh = "icosphere"
nodes = 2562
shape = "discocyte"
reference = "uniform"
shear_modulus = "6.1 uN/m"
spring_length = "0.285 um"
cytosol_viscosity = "6 mPa s"
position = ["0 um", "0 um", "0 um"]
axis = [0, 1, 0]
[coupling]
kernel = "lagrange"
[time]
scheme = "factored"
strain = 25
[numerics]
lattice_viscosity = 0.5
reynolds = 2
[output]
interval_strain = 0.5
[[reference]]
observable = "inclination_deg"
low = 18.5
high = 21.5
source = "prototype of this method"
)";

/// The example with the first `from` replaced by `to`.
inline std::string example_with(const std::string& from, const std::string& to) {
    std::string text = example_case;
    return text.replace(text.find(from), from.size(), to);
}

/// The message of the error of type E that `call` throws; "" when it throws none.
template <class E, class Call>
std::string message_of(const Call& call) {
    try {
        call();
    } catch (const E& error) {
        return error.what();
    }
    return "";
}

}  // namespace hemoflux::apps
