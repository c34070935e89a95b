/// Raw memory of the device the parallel loops run on (the host itself unless the backend is CUDA).
#pragma once

#include <cstddef>

namespace hemoflux::exchange {

/// `bytes` of device memory, aligned to 64 bytes and filled with zero. Throws std::bad_alloc.
void* allocate(std::size_t bytes);
/// Returns memory obtained from allocate(); nullptr is allowed.
void release(void* device) noexcept;
/// Copies between host and device memory.
void copy_to_host(void* host, const void* device, std::size_t bytes);
/// From the host to the device.
void copy_to_device(void* device, const void* host, std::size_t bytes);
/// From one place of the device to another.
void copy_on_device(void* to, const void* from, std::size_t bytes);

}  // namespace hemoflux::exchange
