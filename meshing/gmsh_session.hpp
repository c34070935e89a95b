/// The gmsh library between initialize and finalize. For sources that use gmsh only.
#pragma once

#include <gmsh.h>

#include <string>

#include "meshing/format_error.hpp"

namespace hemoflux::meshing {

/// Starts gmsh silent and without the user's configuration, so that a mesh depends on its input alone.
class GmshSession {
  public:
    GmshSession() {
        gmsh::initialize(0, nullptr, false);
        gmsh::option::setNumber("General.Terminal", 0);
        gmsh::option::setNumber("General.NoPopup", 1);
        gmsh::option::setNumber("General.NumThreads", 1);
    }
    ~GmshSession() { gmsh::finalize(); }
    GmshSession(const GmshSession&) = delete;
    GmshSession& operator=(const GmshSession&) = delete;
};

/// Runs work in a session of its own; errors of gmsh, which throws its messages as strings, become FormatError.
template <class Work>
auto with_gmsh(const Work& work) {
    const GmshSession session;
    try {
        return work();
    } catch (const std::string& message) {
        throw FormatError("gmsh says: " + message);
    }
}

}  // namespace hemoflux::meshing
