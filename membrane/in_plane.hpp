/// How pass 1 of the forces evaluates the in-plane laws of wlc.hpp and strain_energy.hpp, chosen at compile
/// time: `triangles` have a tension of their areas; `continuum` laws weigh the edges by cotangents of the rest
/// triangles, the others have springs along them.
#pragma once

#include "membrane/strain_energy.hpp"
#include "membrane/wlc.hpp"

namespace hemoflux::membrane {

/// Springs alone: WormLikeChain (shifted) or PowerChain.
template <class Chain>
struct SpringLaw {
    static constexpr bool triangles = false, continuum = false;
    Chain chain;
};

/// Springs and an area term.
struct HydrostaticLaw {
    static constexpr bool triangles = true, continuum = false;
    HydrostaticChain hydrostatic;
    WormLikeChain chain = hydrostatic.chain;
};

/// Triangles alone: NeoHookean or Skalak.
template <class Material>
struct ContinuumLaw {
    static constexpr bool triangles = true, continuum = true;
    Material material;
};

}  // namespace hemoflux::membrane
