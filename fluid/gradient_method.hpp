/// Operators for the gradients at cell centres (A.4).
#pragma once

namespace hemoflux::fluid {

/// Weighted least squares (A.33-A.35), Green-Gauss, or the hybrid of both that leans on Green-Gauss in flat cells
/// (A.29).
enum class GradientMethod { least_squares, green_gauss, hybrid };

}  // namespace hemoflux::fluid
