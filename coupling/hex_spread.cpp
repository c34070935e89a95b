// Forces of nodes gathered by the hexahedra around them.
#include "coupling/hex_link.hpp"
#include "exchange/parallel.hpp"

namespace hemoflux::coupling {
namespace {

using exchange::FieldView;

struct ClearHex {
    std::size_t stride;
    double* density[3];
    HEMOFLUX_FN void operator()(std::size_t c) const {
        for (int q = 0; q < 3; ++q) density[q][stride * c] = 0;
    }
};

/// Adds the forces of all nodes to one cell.
struct GatherHex {
    const std::uint32_t *target, *begin, *source, *place;
    const int *start, *order;
    const double* weights;
    std::size_t width, stride;
    const double* inverse_volume;
    const double* force[3];
    double factor;
    double* density[3];
    HEMOFLUX_FN void operator()(std::size_t i) const {
        double sum[3] = {0, 0, 0};
        for (std::uint32_t e = begin[i]; e < begin[i + 1]; ++e) {
            const std::uint32_t s = source[e], j = place[e];
            for (int k = start[s]; k < start[s + 1]; ++k) {
                const auto m = static_cast<std::size_t>(order[k]);
                const double w = weights[width * m + j];
                for (int q = 0; q < 3; ++q) sum[q] += w * force[q][m];
            }
        }
        const std::uint32_t c = target[i];
        for (int q = 0; q < 3; ++q) density[q][stride * c] += factor * inverse_volume[c] * sum[q];
    }
};

struct AccelerateHex {
    const std::uint32_t* target;
    double dt;
    std::size_t force_stride, stride, density_stride;
    const double* force[3];
    const double* rho;
    double* velocity[3];
    HEMOFLUX_FN void operator()(std::size_t i) const {
        const std::size_t c = target[i];
        for (int q = 0; q < 3; ++q)
            velocity[q][stride * c] += dt * force[q][force_stride * c] / rho[density_stride * c];
    }
};

}  // namespace

/// Spreads with the weights of a link.
class HexSpreader final : public ForceSpreader {
  public:
    HexSpreader(const HexLink& link, bool clears) : link_(link), clears_(clears) {}

    void spread(const FieldView& force, double factor, const FieldView& density) override {
        const auto& d = density.component;
        if (clears_)
            exchange::for_each_index(link_.cells_.field_size(), ClearHex{density.stride, {d[0], d[1], d[2]}},
                                     exchange::Cost::cheap);
        exchange::for_each_index(link_.target_.size(),
                                 GatherHex{link_.target_.data(),
                                           link_.begin_.data(),
                                           link_.source_.data(),
                                           link_.place_.data(),
                                           link_.start_.data(),
                                           link_.order_.data(),
                                           link_.weights_.data(),
                                           link_.width(),
                                           density.stride,
                                           link_.cells_.inverse_volume(),
                                           {force.component[0], force.component[1], force.component[2]},
                                           factor,
                                           {d[0], d[1], d[2]}});
    }
    void accelerate(double dt, const FieldView& density, const FluidFields& fluid) const override {
        const auto &f = density.component, &u = fluid.velocity.component;
        exchange::for_each_index(link_.target_.size(),
                                 AccelerateHex{link_.target_.data(),
                                               dt,
                                               density.stride,
                                               fluid.velocity.stride,
                                               fluid.density.stride,
                                               {f[0], f[1], f[2]},
                                               fluid.density.component[0],
                                               {u[0], u[1], u[2]}},
                                 exchange::Cost::cheap);
    }

  private:
    const HexLink& link_;
    bool clears_;
};

void HexLink::list_sources() {
    std::vector<int> slot(cells_.field_size(), -1);
    for (const HexStencil& s : stencils_.to_host()) {
        slot[s.place.cell] = 0;
        for (std::size_t f = 0; f < hex_faces_count; ++f) {
            const std::uint32_t other = cells_.steps()[hex_faces_count * s.place.cell + f].cell;
            if (other != no_cell) slot[other] = 0;
        }
    }
    sources_.clear();
    for (std::uint32_t c = 0; c < slot.size(); ++c)
        if (slot[c] == 0) {
            slot[c] = static_cast<int>(sources_.size());
            sources_.push_back(c);
        }
    const auto& first = around_.first();
    const auto& candidates = around_.candidates();
    std::vector<std::uint32_t> count(cells_.field_size() + 1, 0);
    for (const std::uint32_t c : sources_)
        for (std::uint32_t i = first[c]; i < first[c + 1]; ++i) ++count[candidates[i].cell];
    std::vector<std::uint32_t> target, begin, next(count.size());
    std::uint32_t total = 0;
    for (std::uint32_t c = 0; c < cells_.field_size(); ++c) {
        next[c] = total;
        if (count[c] == 0) continue;
        target.push_back(c);
        begin.push_back(total);
        total += count[c];
    }
    begin.push_back(total);
    std::vector<std::uint32_t> source(total), place(total);
    for (std::uint32_t s = 0; s < sources_.size(); ++s) {
        const std::uint32_t c = sources_[s];
        for (std::uint32_t i = first[c]; i < first[c + 1]; ++i) {
            const std::uint32_t at = next[candidates[i].cell]++;
            source[at] = s;
            place[at] = i - first[c];
        }
    }
    slot_.assign(slot);
    start_ = exchange::Buffer<int>(sources_.size() + 1);
    target_ = exchange::Buffer<std::uint32_t>(target);
    begin_ = exchange::Buffer<std::uint32_t>(begin);
    source_ = exchange::Buffer<std::uint32_t>(source);
    place_ = exchange::Buffer<std::uint32_t>(place);
}

std::unique_ptr<ForceSpreader> HexLink::spreader(ForceSpreader* first) const {
    return std::make_unique<HexSpreader>(*this, first == nullptr);
}

}  // namespace hemoflux::coupling
