/// What all kernels over the rings of a batch share: how work is cut, and how positions are read. Only kernel
/// sources include this header.
#pragma once

#include <cstddef>

#include "exchange/pack.hpp"
#include "exchange/parallel.hpp"
#include "exchange/vec3.hpp"
#include "membrane/forces.hpp"

namespace hemoflux::membrane {

using exchange::load, exchange::select, exchange::square_root, exchange::store;

/// Vertices of one task: enough to share among threads, and one per CUDA thread.
inline constexpr std::size_t chunk_vertices = exchange::on_gpu ? 1 : 128;

/// Tasks that a cell of rows `stride` long is cut into.
constexpr std::size_t chunks_of(std::size_t stride) { return (stride + chunk_vertices - 1) / chunk_vertices; }

/// The vertices first .. last - 1 of one cell.
struct Chunk {
    std::size_t cell, first, last;
};

/// What task number `task` works on; tasks are numbered cell by cell.
HEMOFLUX_INLINE Chunk chunk_of(std::size_t task, std::size_t stride) {
    const std::size_t chunks = chunks_of(stride), first = task % chunks * chunk_vertices,
                      end = first + chunk_vertices;
    return {task / chunks, first, end < stride ? end : stride};
}

/// Positions of the vertices from place i of the batch on, a lane each.
template <class Value>
HEMOFLUX_INLINE Vec3<Value> load_position(const ForceView& w, std::size_t i) {
    return {load<Value>(w.x + i), load<Value>(w.y + i), load<Value>(w.z + i)};
}

/// Positions of the vertices of a cell that `index` lists, a lane each.
template <class Value>
HEMOFLUX_INLINE Vec3<Value> gather_position(const ForceView& w, std::size_t cell, const int* index) {
    const std::size_t base = cell * w.stride;
    return {exchange::gather<Value>(w.x + base, index), exchange::gather<Value>(w.y + base, index),
            exchange::gather<Value>(w.z + base, index)};
}

/// select() of exchange/pack.hpp on each component.
template <class Mask, class Value>
HEMOFLUX_INLINE Vec3<Value> select3(const Mask& m, const Vec3<Value>& yes, const Vec3<Value>& no) {
    return {select(m, yes.x, no.x), select(m, yes.y, no.y), select(m, yes.z, no.z)};
}

/// Batches of one small cell stay on one thread: waking the others takes longer than the work.
inline exchange::Cost cost_of(const ForceView& w) {
    constexpr std::size_t worth_sharing = 1024;
    return w.cells * w.stride < worth_sharing ? exchange::Cost::cheap : exchange::Cost::heavy;
}

/// Reads the partial sums of one cell.
struct PartialSum {
    const CellSums* partial;
    std::size_t chunks;
    HEMOFLUX_FN const CellSums& operator()(std::size_t cell, std::size_t chunk) const {
        return partial[cell * chunks + chunk];
    }
};

}  // namespace hemoflux::membrane
