#include "exchange/memory.hpp"

#include <thrust/copy.h>
#include <thrust/device_ptr.h>
#include <thrust/fill.h>

#include <cstring>
#include <new>

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
constexpr std::size_t alignment = 64;
}

void* allocate(std::size_t bytes) {
    if (bytes == 0) return nullptr;
    void* p = ::operator new(bytes, std::align_val_t(alignment));
    // The first touch decides where a page lives, so the threads that will use it touch it.
    thrust::fill_n(thrust::device_ptr<char>(static_cast<char*>(p)), bytes, char(0));
    return p;
}
void release(void* device) noexcept { ::operator delete(device, std::align_val_t(alignment)); }
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
