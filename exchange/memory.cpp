#include "exchange/memory.hpp"

#include <thrust/copy.h>
#include <thrust/device_ptr.h>
#include <thrust/fill.h>

#include <atomic>
#include <cstdlib>
#include <cstring>
#include <new>

#if defined(__linux__)
#include <sys/mman.h>
#endif

#if defined(HEMOFLUX_BACKEND_CUDA)
#include <thrust/device_free.h>
#include <thrust/device_malloc.h>
#endif

namespace hemoflux::exchange {
#if defined(HEMOFLUX_BACKEND_CUDA)
void* allocate(std::size_t bytes) {
    if (bytes == 0) return nullptr;
    const auto p = thrust::device_malloc<char>(bytes);
    thrust::fill_n(p, bytes, char(0));
    return p.get();
}
void release(void* device) noexcept {
    if (device) thrust::device_free(thrust::device_ptr<char>(static_cast<char*>(device)));
}
#else
namespace {
constexpr std::size_t line = 64, huge_page = std::size_t{1} << 21, large = std::size_t{1} << 16;

/// Large arrays begin at different places within a page, so that the same element of several arrays does not fall into
/// the same set of the first-level cache.
std::size_t stagger(std::size_t bytes) {
    static std::atomic<std::size_t> count{0};
    constexpr std::size_t step = 9, places = 64;
    return bytes < large ? 0 : step * count.fetch_add(1, std::memory_order_relaxed) % places * line;
}
}  // namespace

void* allocate(std::size_t bytes) {
    if (bytes == 0) return nullptr;
    const std::size_t offset = line + stagger(bytes);
    const std::size_t alignment = bytes < huge_page ? line : huge_page;
    const std::size_t whole = (bytes + offset + alignment - 1) / alignment * alignment;
    void* base = std::aligned_alloc(alignment, whole);
    if (!base) throw std::bad_alloc();
#if defined(MADV_HUGEPAGE)
    // Advice only: without it unstructured sweeps miss the translation buffer at every other record.
    if (alignment == huge_page) madvise(base, whole, MADV_HUGEPAGE);
#endif
    char* p = static_cast<char*>(base) + offset;
    std::memcpy(p - sizeof base, &base, sizeof base);  // for release()
    // The first touch decides where a page lives, so the threads that will use it touch it.
    thrust::fill_n(thrust::device_ptr<char>(p), bytes, char(0));
    return p;
}
void release(void* device) noexcept {
    if (!device) return;
    void* base = nullptr;
    std::memcpy(&base, static_cast<char*>(device) - sizeof base, sizeof base);
    std::free(base);
}
#endif

void copy_to_host(void* host, const void* device, std::size_t bytes) {
    if (bytes == 0) return;
    const thrust::device_ptr<const char> p(static_cast<const char*>(device));
    thrust::copy_n(p, bytes, static_cast<char*>(host));
}

void copy_to_device(void* device, const void* host, std::size_t bytes) {
    if (bytes == 0) return;
    thrust::copy_n(static_cast<const char*>(host), bytes,
                   thrust::device_ptr<char>(static_cast<char*>(device)));
}

void copy_on_device(void* to, const void* from, std::size_t bytes) {
    if (bytes == 0) return;
    const thrust::device_ptr<const char> p(static_cast<const char*>(from));
    thrust::copy_n(p, bytes, thrust::device_ptr<char>(static_cast<char*>(to)));
}

}  // namespace hemoflux::exchange
