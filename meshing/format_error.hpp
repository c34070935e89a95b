/// What the readers of mesh files throw among themselves.
#pragma once

#include <stdexcept>

namespace hemoflux::meshing {

/// Why a file does not hold what its format claims; the functions users call add the file's name.
struct FormatError : std::runtime_error {
    using std::runtime_error::runtime_error;
};

}  // namespace hemoflux::meshing
