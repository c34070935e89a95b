/// Small vectors of three components, the same on host and device.
#pragma once

#include <cmath>
#include <cstddef>

#include "exchange/macros.hpp"

namespace hemoflux::exchange {

/// Three components of a Cartesian vector; T is double, float or a SIMD pack.
template <class T>
struct Vec3 {
    T x, y, z;

    HEMOFLUX_INLINE Vec3& operator+=(const Vec3& b) {
        x += b.x, y += b.y, z += b.z;
        return *this;
    }
    HEMOFLUX_INLINE Vec3& operator-=(const Vec3& b) {
        x -= b.x, y -= b.y, z -= b.z;
        return *this;
    }
};

template <class T>
HEMOFLUX_INLINE Vec3<T> operator+(const Vec3<T>& a, const Vec3<T>& b) {
    return {a.x + b.x, a.y + b.y, a.z + b.z};
}
template <class T>
HEMOFLUX_INLINE Vec3<T> operator-(const Vec3<T>& a, const Vec3<T>& b) {
    return {a.x - b.x, a.y - b.y, a.z - b.z};
}
template <class T>
HEMOFLUX_INLINE Vec3<T> operator-(const Vec3<T>& a) {
    return {-a.x, -a.y, -a.z};
}
template <class T, class S>
HEMOFLUX_INLINE Vec3<T> operator*(const S& s, const Vec3<T>& a) {
    return {s * a.x, s * a.y, s * a.z};
}
template <class T>
HEMOFLUX_INLINE T dot(const Vec3<T>& a, const Vec3<T>& b) {
    return a.x * b.x + a.y * b.y + a.z * b.z;
}
template <class T>
HEMOFLUX_INLINE Vec3<T> cross(const Vec3<T>& a, const Vec3<T>& b) {
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
template <class T>
HEMOFLUX_INLINE T norm(const Vec3<T>& a) {
    using std::sqrt;
    return sqrt(dot(a, a));
}

/// The component along axis 0, 1 or 2.
template <class T>
HEMOFLUX_INLINE T component(const Vec3<T>& v, std::size_t axis) {
    return axis == 0 ? v.x : axis == 1 ? v.y : v.z;
}
template <class T>
HEMOFLUX_INLINE T& component(Vec3<T>& v, std::size_t axis) {
    return axis == 0 ? v.x : axis == 1 ? v.y : v.z;
}

using Vec3d = Vec3<double>;

}  // namespace hemoflux::exchange

namespace hemoflux {
using exchange::component;
using exchange::cross;
using exchange::dot;
using exchange::norm;
using exchange::Vec3;
using exchange::Vec3d;
}  // namespace hemoflux
