#include "membrane/viscosity.hpp"

#include <stdexcept>
#include <string>

#include "exchange/error.hpp"
#include "membrane/ring_kernels.hpp"

namespace hemoflux::membrane {
namespace {

/// q <- keep q + gain (L - L_before) and L_before <- L, in every ring slot of one chunk of vertices.
template <class Value>
struct AdvanceTask {
    ForceView w;
    double keep, gain;
    double *tension, *length;

    HEMOFLUX_FN void operator()(std::size_t task) const {
        const Chunk chunk = chunk_of(task, w.stride);
        for (std::size_t v = chunk.first; v < chunk.last; v += exchange::lanes<Value>) {
            const Vec3<Value> r = load_position<Value>(w, chunk.cell * w.stride + v);
            const auto degrees = static_cast<std::size_t>(w.group_degree[v / exchange::row_alignment]);
            for (std::size_t i = 0; i < degrees; ++i) {
                const std::size_t at = (chunk.cell * w.slots + i) * w.stride + v;
                const Vec3<Value> d =
                    gather_position<Value>(w, chunk.cell, w.neighbour + i * w.stride + v) - r;
                const Value now = square_root(dot(d, d));
                const Value change = now - load<Value>(length + at);
                store(tension + at, keep * load<Value>(tension + at) + gain * change);
                store(length + at, now);
            }
        }
    }
};

/// Adds q e of every ring edge to the forces of one chunk of vertices.
template <class Value>
struct AddTask {
    ForceView w;
    const double* tension;

    HEMOFLUX_FN void operator()(std::size_t task) const {
        const Chunk chunk = chunk_of(task, w.stride);
        for (std::size_t v = chunk.first; v < chunk.last; v += exchange::lanes<Value>) {
            const std::size_t here = chunk.cell * w.stride + v;
            const Value degree = load<Value>(w.degree + v), zero(0.0);
            const Vec3<Value> r = load_position<Value>(w, here);
            Vec3<Value> force{zero, zero, zero};
            const auto degrees = static_cast<std::size_t>(w.group_degree[v / exchange::row_alignment]);
            for (std::size_t i = 0; i < degrees; ++i) {
                const auto inside = Value(static_cast<double>(i)) < degree;
                const std::size_t at = (chunk.cell * w.slots + i) * w.stride + v;
                const Vec3<Value> d =
                    gather_position<Value>(w, chunk.cell, w.neighbour + i * w.stride + v) - r;
                const Value pull = load<Value>(tension + at) / square_root(dot(d, d));
                force += select3(inside, pull * d, Vec3<Value>{zero, zero, zero});
            }
            store(w.fx + here, load<Value>(w.fx + here) + force.x);
            store(w.fy + here, load<Value>(w.fy + here) + force.y);
            store(w.fz + here, load<Value>(w.fz + here) + force.z);
        }
    }
};

/// Slot data of every edge of every cell, taken at its first vertex.
std::vector<double> by_edge(const Batch& batch, const exchange::Buffer<double>& slots) {
    const Topology& t = batch.topology();
    const std::size_t edges = t.edges().size();
    const std::vector<double> host = slots.to_host();
    std::vector<double> result(batch.cells() * edges);
    for (std::size_t c = 0; c < batch.cells(); ++c)
        for (std::size_t v = 0; v < t.vertices(); ++v)
            for (std::size_t i = 0; i < t.degree(v); ++i)
                result[c * edges + static_cast<std::size_t>(t.ring_edges(v)[i])] =
                    host[(c * t.max_degree() + i) * batch.stride() + v];
    return result;
}

exchange::Buffer<double> by_slot(const Batch& batch, const std::vector<double>& values) {
    const Topology& t = batch.topology();
    const std::size_t edges = t.edges().size();
    if (values.size() != batch.cells() * edges)
        throw std::length_error("MembraneViscosity::set_state: wrong number of edges");
    std::vector<double> host(batch.cells() * t.max_degree() * batch.stride(), 0.0);
    for (std::size_t c = 0; c < batch.cells(); ++c)
        for (std::size_t v = 0; v < t.vertices(); ++v)
            for (std::size_t i = 0; i < t.degree(v); ++i)
                host[(c * t.max_degree() + i) * batch.stride() + v] =
                    values[c * edges + static_cast<std::size_t>(t.ring_edges(v)[i])];
    return exchange::Buffer<double>(host);
}

void positive(const char* name, double value) {
    if (!(value > 0) || std::isinf(value))
        throw InputError(std::string(name) + " = " + std::to_string(value), "it must be positive and finite",
                         "Correct its value");
}

}  // namespace

MembraneViscosity::MembraneViscosity(Batch& batch, double stiffness)
    : stiffness_(stiffness),
      dashpot_(dashpot_coefficient(batch.parameters().network.viscosity)),
      tension_(batch.cells() * batch.topology().max_degree() * batch.stride()),
      length_(tension_.size()) {
    positive("stiffness of the membrane's Maxwell elements", stiffness);
    const ForceView w = batch.view();
    exchange::for_each_index(w.cells * chunks_of(w.stride),
                             AdvanceTask<exchange::Pack>{w, 0, 0, tension_.data(), length_.data()},
                             cost_of(w));
}

void MembraneViscosity::advance(Batch& batch, double dt) {
    positive("time step", dt);
    const ForceView w = batch.view();
    const double ratio = dashpot_ > 0 ? dt / relaxation_time() : INFINITY;
    const double keep = std::exp(-ratio), gain = -stiffness_ * std::expm1(-ratio) / ratio;
    exchange::for_each_index(w.cells * chunks_of(w.stride),
                             AdvanceTask<exchange::Pack>{w, keep, gain, tension_.data(), length_.data()},
                             cost_of(w));
}

void MembraneViscosity::add_forces(Batch& batch) const {
    const ForceView w = batch.view();
    exchange::for_each_index(w.cells * chunks_of(w.stride), AddTask<exchange::Pack>{w, tension_.data()},
                             cost_of(w));
}

ViscousState MembraneViscosity::state(const Batch& batch) const {
    return {.tension = by_edge(batch, tension_), .length = by_edge(batch, length_)};
}

void MembraneViscosity::set_state(const Batch& batch, const ViscousState& state) {
    tension_ = by_slot(batch, state.tension);
    length_ = by_slot(batch, state.length);
}

}  // namespace hemoflux::membrane
