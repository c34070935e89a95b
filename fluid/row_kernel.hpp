/// Loops over the interior rows of a padded layout, a pack of cells at a time.
#pragma once

#include "exchange/layout.hpp"
#include "exchange/pack.hpp"

namespace hemoflux::fluid {

/// Base of row kernels: position and number of valid cells of one pack. Row j + n[1] k.
struct RowKernel {
    exchange::Layout layout;
    /// Where a pack lies in a padded field.
    HEMOFLUX_INLINE std::size_t at(std::size_t row, std::size_t pack) const {
        return layout.origin + row % layout.n[1] * layout.row + row / layout.n[1] * layout.plane +
               pack * exchange::lanes<exchange::Pack>;
    }
    /// How many lanes of a pack are cells.
    HEMOFLUX_INLINE std::ptrdiff_t count(std::size_t pack) const {
        return static_cast<std::ptrdiff_t>(layout.n[0]) -
               static_cast<std::ptrdiff_t>(pack * exchange::lanes<exchange::Pack>);
    }
};

/// Packs that cover one interior row.
inline std::size_t packs_per_row(const exchange::Layout& layout) {
    return exchange::round_up(layout.n[0], exchange::lanes<exchange::Pack>) / exchange::lanes<exchange::Pack>;
}

}  // namespace hemoflux::fluid
