/// How pass 1 of the forces evaluates the in-plane laws of wlc.hpp and strain_energy.hpp, chosen at compile
/// time: `springs` have a tension along the edges, `triangles` one of the areas, and `continuum` laws weigh
/// the edges by cotangents of the rest triangles.
#pragma once

#include "membrane/strain_energy.hpp"
#include "membrane/wlc.hpp"

namespace hemoflux::membrane {

/// Springs alone: WormLikeChain (shifted) or PowerChain.
template <class Chain>
struct SpringLaw {
    static constexpr bool springs = true, triangles = false, continuum = false;
    Chain chain;
};

/// Springs and an area term.
struct HydrostaticLaw {
    static constexpr bool springs = true, triangles = true, continuum = false;
    HydrostaticChain hydrostatic;
    WormLikeChain chain = hydrostatic.chain;
};

/// Triangles alone: NeoHookean or Skalak.
template <class Material>
struct ContinuumLaw {
    static constexpr bool springs = false, triangles = true, continuum = true;
    Material material;
};

}  // namespace hemoflux::membrane
