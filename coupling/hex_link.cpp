#include "coupling/hex_link.hpp"

#include <algorithm>
#include <string>

#include "exchange/error.hpp"
#include "exchange/memory.hpp"
#include "exchange/parallel.hpp"

namespace hemoflux::coupling {
namespace {

using exchange::FieldView;

/// Steps of a walk from the cell of the last time, and from the nearest cell.
constexpr int short_walk = 16, long_walk = 1000000;

/// Finds the cell of node m and its weights there.
template <class Phi, int N>
struct BuildHexStencil {
    HexWalkView walk;
    HexNeighbourhoodView around;
    std::size_t width;
    const double* position[3];
    int most_steps;
    HexStencil* stencils;
    double* weights;
    HEMOFLUX_FN void operator()(std::size_t m) const {
        HexStencil& s = stencils[m];
        const Vec3d x{position[0][m], position[1][m], position[2][m]};
        s.lost = !walk.walk(x, s.place, most_steps);
        double* w = weights + width * m;
        const std::uint32_t c = s.place.cell, count = around.first[c + 1] - around.first[c];
        if (s.lost)
            for (std::uint32_t j = 0; j < count; ++j) w[j] = 0;
        else
            hex_weights<Phi, N>(around, walk.centre, c, x - walk.offset(s.place), w);
    }
};

/// Whether a cell lacks neighbours for the first moments at its centre or, beside the border, at a corner.
template <class Phi, int N>
struct TooThin {
    HexWalkView walk;
    HexNeighbourhoodView around;
    HEMOFLUX_INLINE bool at(std::uint32_t c, const Vec3d& x) const {
        return hex_weights<Phi, N>(around, walk.centre, c, x, nullptr) < 4;
    }
    HEMOFLUX_FN bool operator()(std::size_t cell) const {
        const auto c = static_cast<std::uint32_t>(cell);
        bool border = false;
        for (std::size_t f = 0; f < hex_faces_count; ++f)
            border = border || walk.step[hex_faces_count * cell + f].cell == no_cell;
        for (std::size_t v = 0; v < 8 && border; ++v)
            if (at(c, walk.node[walk.corner[8 * cell + v]])) return true;
        return at(c, walk.centre[c]);
    }
};

/// Calls use(Phi{}, number of monomials) for a kernel.
template <class Use>
void with_kernel(Kernel kernel, const Use& use) {
    if (kernel == Kernel::phi3) return use(Phi3{}, std::integral_constant<int, 4>{});
    if (kernel == Kernel::phi4) return use(Phi4{}, std::integral_constant<int, 4>{});
    use(Phi4{}, std::integral_constant<int, 10>{});
}

struct HexLost {
    const HexStencil* stencils;
    HEMOFLUX_FN bool operator()(std::size_t m) const { return stencils[m].lost; }
};

/// Whether a node is not where it was located last.
struct HasMoved {
    const double *now[3], *then[3];
    HEMOFLUX_FN bool operator()(std::size_t m) const {
        return !(now[0][m] == then[0][m] && now[1][m] == then[1][m] && now[2][m] == then[2][m]);
    }
};

struct NoSource {
    const HexStencil* stencils;
    const int* slot;
    HEMOFLUX_FN bool operator()(std::size_t m) const { return slot[stencils[m].place.cell] < 0; }
};

struct SortKey {
    const HexStencil* stencils;
    const int* slot;
    int *key, *order;
    HEMOFLUX_FN void operator()(std::size_t m) const {
        key[m] = slot[stencils[m].place.cell];
        order[m] = static_cast<int>(m);
    }
};

/// First of the sorted nodes that belongs to source s or a later one.
struct SourceStart {
    const int* key;
    std::size_t nodes;
    int* start;
    HEMOFLUX_FN void operator()(std::size_t s) const {
        std::size_t low = 0, high = nodes;
        while (low < high) {
            const std::size_t middle = (low + high) / 2;
            if (key[middle] < static_cast<int>(s))
                low = middle + 1;
            else
                high = middle;
        }
        start[s] = static_cast<int>(low);
    }
};

struct InterpolateHex {
    HexNeighbourhoodView around;
    std::size_t width, stride;
    const HexStencil* stencils;
    const double* weights;
    const double* field[3];
    double* velocity[3];
    HEMOFLUX_FN void operator()(std::size_t m) const {
        const std::uint32_t c = stencils[m].place.cell, first = around.first[c],
                            count = around.first[c + 1] - first;
        const double* w = weights + width * m;
        double v[3] = {0, 0, 0};
        for (std::uint32_t j = 0; j < count; ++j) {
            const std::size_t at = stride * around.candidate[first + j].cell;
            for (int q = 0; q < 3; ++q) v[q] += w[j] * field[q][at];
        }
        for (int q = 0; q < 3; ++q) velocity[q][m] = v[q];
    }
};

}  // namespace

HexLink::HexLink(const HexCells& cells, Kernel kernel, std::size_t nodes)
    : cells_(cells),
      around_(cells.neighbourhood(kernel)),
      kernel_(kernel),
      stencils_(nodes),
      weights_(nodes * around_.width()),
      slot_(std::vector<int>(cells.field_size(), -1)),
      key_(nodes),
      order_(nodes) {
    for (auto& x : last_) x = exchange::Buffer<double>(nodes);
    refuse_thin_cells();
}

void HexLink::refuse_thin_cells() const {
    std::size_t thin = 0;
    with_kernel(kernel_, [&](auto phi, auto n) {
        thin = exchange::find_first(
            cells_.field_size(), TooThin<decltype(phi), decltype(n)::value>{cells_.walk(), around_.view()});
    });
    if (thin < cells_.field_size())
        throw InputError(
            "cell " + std::to_string(cells_.grid().original[thin]) + " of the mesh",
            "it has too few cells around it to interpolate linearly: the mesh is fewer than two cells "
            "thick there",
            "Refine the mesh");
}

void HexLink::build(const FieldView& positions, int most_steps) {
    const auto& x = positions.component;
    with_kernel(kernel_, [&](auto phi, auto n) {
        exchange::for_each_index(size(),
                                 BuildHexStencil<decltype(phi), decltype(n)::value>{cells_.walk(),
                                                                                    around_.view(),
                                                                                    width(),
                                                                                    {x[0], x[1], x[2]},
                                                                                    most_steps,
                                                                                    stencils_.data(),
                                                                                    weights_.data()});
    });
}

void HexLink::seek(const FieldView& positions) {
    std::vector<double> x[3];
    for (std::size_t q = 0; q < 3; ++q) {
        x[q].resize(size());
        exchange::copy_to_host(x[q].data(), positions.component[q], size() * sizeof(double));
    }
    std::vector<HexStencil> s = stencils_.to_host();
    for (std::size_t m = 0; m < size(); ++m) {
        const Vec3d at{x[0][m], x[1][m], x[2][m]};
        if (located_ && !s[m].lost) continue;
        s[m].place = {dot(at, at) < 1e200 ? cells_.nearest(at) : 0, {0, 0, 0}};
    }
    stencils_.assign(s);
    build(positions, long_walk);
}

void HexLink::locate(const FieldView& positions) {
    if (size() == 0) return;
    const auto& x = positions.component;
    const HasMoved moved{{x[0], x[1], x[2]}, {last_[0].data(), last_[1].data(), last_[2].data()}};
    if (located_ && exchange::find_first(size(), moved) == size()) return;
    for (int q = 0; q < 3; ++q) exchange::copy_on_device(last_[q].data(), x[q], size() * sizeof(double));
    if (located_) build(positions, short_walk);
    if (!located_ || first_lost() < size()) seek(positions);
    if (!located_ || exchange::find_first(size(), NoSource{stencils_.data(), slot_.data()}) < size())
        list_sources();
    located_ = true;
    exchange::for_each_index(size(), SortKey{stencils_.data(), slot_.data(), key_.data(), order_.data()},
                             exchange::Cost::cheap);
    exchange::stable_sort_by_key(size(), key_.data(), order_.data());
    exchange::for_each_index(start_.size(), SourceStart{key_.data(), size(), start_.data()},
                             exchange::Cost::cheap);
}

std::size_t HexLink::first_lost() const { return exchange::find_first(size(), HexLost{stencils_.data()}); }

void HexLink::interpolate(const FieldView& field, const FieldView& values) const {
    const auto &u = field.component, &v = values.component;
    exchange::for_each_index(size(), InterpolateHex{around_.view(),
                                                    width(),
                                                    field.stride,
                                                    stencils_.data(),
                                                    weights_.data(),
                                                    {u[0], u[1], u[2]},
                                                    {v[0], v[1], v[2]}});
}

std::unique_ptr<NodeLink> HexCells::link(Kernel kernel, std::size_t nodes) const {
    return std::make_unique<HexLink>(*this, kernel, nodes);
}

}  // namespace hemoflux::coupling
