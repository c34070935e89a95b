/// Parallel loops and reductions on the device. Only kernel sources include this header (CMake: KERNELS).
/// Results never depend on the number of threads: loops write disjoint data, sums use chunks of a fixed size.
#pragma once

#include <thrust/execution_policy.h>
#include <thrust/for_each.h>
#include <thrust/iterator/counting_iterator.h>
#include <thrust/scan.h>
#include <thrust/sort.h>

#include <cstddef>
#include <vector>

#include "exchange/backend.hpp"
#include "exchange/buffer.hpp"
#include "exchange/macros.hpp"

namespace hemoflux::exchange {

/// How costly one index of a loop is; cheap loops below `serial_limit` stay on the calling thread, because
/// waking the OpenMP backend costs 20-50 us.
enum class Cost { cheap, heavy };
inline constexpr std::size_t serial_limit = 4096;

/// Calls f(i) for i = 0 .. n-1, in any order, each index once. f is copied to the device.
template <class Function>
void for_each_index(std::size_t n, Function f, Cost cost = Cost::heavy) {
    if (n == 0) return;
    if constexpr (!on_gpu) {
        if (n == 1 || (cost == Cost::cheap && n < serial_limit) || threads() == 1) {
            for (std::size_t i = 0; i < n; ++i) f(i);
            return;
        }
    }
    thrust::for_each_n(thrust::device, thrust::counting_iterator<std::size_t>(0), n, f);
}

namespace detail {

/// All packs of one row on the CPU; one pack (a single value) per CUDA thread.
template <class Function>
struct RowLoop {
    Function f;
    std::size_t packs;
    HEMOFLUX_FN void operator()(std::size_t i) const {
        if constexpr (on_gpu) {
            f(i / packs, i % packs);
        } else {
            for (std::size_t p = 0; p < packs; ++p) f(i, p);
        }
    }
};

/// Sums f over one chunk of one segment, sequentially.
template <class T, class Function>
struct ChunkSum {
    Function f;
    T* partial;
    std::size_t size, chunk, chunks;
    HEMOFLUX_FN void operator()(std::size_t c) const {
        const std::size_t segment = c / chunks, first = (c % chunks) * chunk;
        const std::size_t last = first + chunk < size ? first + chunk : size;
        T sum{};
        for (std::size_t i = first; i < last; ++i) sum += f(segment, i);
        partial[c] = sum;
    }
};

/// Adds the partial sums of one segment in chunk order.
template <class T>
struct SegmentSum {
    const T* partial;
    T* out;
    std::size_t chunks;
    HEMOFLUX_FN void operator()(std::size_t segment) const {
        T sum{};
        for (std::size_t c = 0; c < chunks; ++c) sum += partial[segment * chunks + c];
        out[segment] = sum;
    }
};

/// A function of i as one of (segment, i), whose segment is always the first.
template <class Function>
struct OneSegment {
    Function f;
    HEMOFLUX_FN auto operator()(std::size_t, std::size_t i) const { return f(i); }
};

/// Index of the first element of one chunk for which the predicate holds, or n.
template <class Predicate>
struct ChunkFind {
    Predicate predicate;
    std::size_t* partial;
    std::size_t n, chunk;
    HEMOFLUX_FN void operator()(std::size_t c) const {
        const std::size_t last = (c + 1) * chunk < n ? (c + 1) * chunk : n;
        std::size_t found = n;
        for (std::size_t i = c * chunk; i < last; ++i)
            if (predicate(i)) {
                found = i;
                break;
            }
        partial[c] = found;
    }
};

}  // namespace detail

/// Calls f(row, p) for every row and p = 0 .. packs-1, where a pack holds lanes<Pack> values. Rows are shared
/// out among threads and packs of a row run in order; on a GPU every pack is a thread of its own.
template <class Function>
void for_each_row(std::size_t rows, std::size_t packs, Function f, Cost cost = Cost::heavy) {
    const std::size_t n = on_gpu ? rows * packs : rows;
    if constexpr (!on_gpu)
        if (cost == Cost::cheap && rows * packs >= serial_limit) cost = Cost::heavy;
    for_each_index(n, detail::RowLoop<Function>{f, packs}, cost);
}

/// Items per partial sum; fixed, so that a sum is the same for any number of threads.
inline constexpr std::size_t reduction_chunk = on_gpu ? 32 : 512;

/// Scratch memory of a reduction; keep one per call site so that no step allocates.
template <class T>
class Reduction {
  public:
    /// out[s] (device) = sum over i < size of f(s, i), for s < segments. T needs +=; T{} is zero.
    template <class Function>
    void sum_segments(std::size_t segments, std::size_t size, Function f, T* out) {
        const std::size_t chunks = (size + reduction_chunk - 1) / reduction_chunk;
        if (partial_.size() < segments * chunks) partial_ = Buffer<T>(segments * chunks);
        for_each_index(segments * chunks,
                       detail::ChunkSum<T, Function>{f, partial_.data(), size, reduction_chunk, chunks});
        for_each_index(segments, detail::SegmentSum<T>{partial_.data(), out, chunks}, Cost::cheap);
    }

    /// Sum over i < n of f(i), returned to the host.
    template <class Function>
    T sum(std::size_t n, Function f) {
        if (total_.size() == 0) total_ = Buffer<T>(1);
        sum_segments(1, n, detail::OneSegment<Function>{f}, total_.data());
        T value;
        copy_to_host(&value, total_.data(), sizeof(T));
        return value;
    }

  private:
    Buffer<T> partial_, total_;
};

/// A maximum that can be summed: feed it to Reduction to get the largest value (NaN wins, so it is never
/// hidden).
struct Maximum {
    double value = -1.7976931348623157e308;
    HEMOFLUX_FN Maximum& operator+=(const Maximum& b) {
        if (!(b.value <= value) && value == value) value = b.value;
        return *this;
    }
};

/// Smallest i < n for which predicate(i) holds, or n. The same for any number of threads.
template <class Predicate>
std::size_t find_first(std::size_t n, Predicate predicate) {
    const std::size_t chunks = (n + reduction_chunk - 1) / reduction_chunk;
    Buffer<std::size_t> partial(chunks);
    for_each_index(chunks, detail::ChunkFind<Predicate>{predicate, partial.data(), n, reduction_chunk});
    for (const std::size_t i : partial.to_host())
        if (i < n) return i;
    return n;
}

/// out[i] = in[0] + ... + in[i-1]. in and out may be the same device array.
template <class T>
void exclusive_scan(std::size_t n, const T* in, T* out) {
    thrust::exclusive_scan(thrust::device, in, in + n, out);
}

/// Sorts keys ascending and moves values along; equal keys keep their order.
template <class Key, class T>
void stable_sort_by_key(std::size_t n, Key* keys, T* values) {
    thrust::stable_sort_by_key(thrust::device, keys, keys + n, values);
}

}  // namespace hemoflux::exchange
