/// A typed array in device memory. Kernels see data(); the host sees copies.
#pragma once

#include <cstddef>
#include <stdexcept>
#include <type_traits>
#include <utility>
#include <vector>

#include "exchange/memory.hpp"

namespace hemoflux::exchange {

/// Owns `size` values of a trivially copyable T on the device; new elements are zero. Movable, not copyable.
template <class T>
class Buffer {
    static_assert(std::is_trivially_copyable_v<T>);

  public:
    Buffer() = default;
    /// `size` zeros.
    explicit Buffer(std::size_t size) : data_(static_cast<T*>(allocate(size * sizeof(T)))), size_(size) {}
    /// A copy of values of the host.
    explicit Buffer(const std::vector<T>& host) : Buffer(host.size()) { assign(host); }
    Buffer(Buffer&& other) noexcept
        : data_(std::exchange(other.data_, nullptr)), size_(std::exchange(other.size_, 0)) {}
    Buffer& operator=(Buffer&& other) noexcept {
        std::swap(data_, other.data_);
        std::swap(size_, other.size_);
        return *this;
    }
    Buffer(const Buffer&) = delete;
    Buffer& operator=(const Buffer&) = delete;
    ~Buffer() { release(data_); }

    /// Device pointer to the first element; dereferenced in kernels only.
    [[nodiscard]] T* data() noexcept { return data_; }
    [[nodiscard]] const T* data() const noexcept { return data_; }
    /// Number of elements.
    [[nodiscard]] std::size_t size() const noexcept { return size_; }

    /// Replaces all values; host.size() must equal size(), else std::length_error.
    void assign(const std::vector<T>& host) {
        if (host.size() != size_) throw std::length_error("Buffer::assign: sizes differ");
        copy_to_device(data_, host.data(), size_ * sizeof(T));
    }
    /// A copy of all values on the host.
    [[nodiscard]] std::vector<T> to_host() const {
        std::vector<T> host(size_);
        copy_to_host(host.data(), data_, size_ * sizeof(T));
        return host;
    }
    /// Sets every element to `value`.
    void fill(const T& value) { assign(std::vector<T>(size_, value)); }

  private:
    T* data_ = nullptr;
    std::size_t size_ = 0;
};

}  // namespace hemoflux::exchange
