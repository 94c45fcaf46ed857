// Vectors and matrices of dimension three over any ring: doubles, double-doubles, rationals, lanes, polynomials.
#pragma once

#include <cmath>
#include <type_traits>

namespace chasles::algebra {

/// Three components in a Cartesian frame.
template <class T>
struct Vector3 {
    T x{};
    T y{};
    T z{};

    const T& operator[](int i) const { return i == 0 ? x : i == 1 ? y : z; }
    T& operator[](int i) { return i == 0 ? x : i == 1 ? y : z; }

    friend Vector3 operator+(const Vector3& a, const Vector3& b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
    friend Vector3 operator-(const Vector3& a, const Vector3& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
};

/// The product with a factor of any type, for example a vector of numbers times a polynomial.
template <class T, class S>
auto scale(const Vector3<T>& a, const S& s) {
    using Product = decltype(a.x * s);
    return Vector3<Product>{a.x * s, a.y * s, a.z * s};
}

/// The scalar product.
template <class A, class B>
[[gnu::always_inline]] inline auto dot(const Vector3<A>& a, const Vector3<B>& b) {
    using Product = decltype(a.x * b.x);
    return Product(a.x * b.x + a.y * b.y + a.z * b.z);
}

/// The vector product.
template <class A, class B>
auto cross(const Vector3<A>& a, const Vector3<B>& b) {
    using Product = decltype(a.x * b.x);
    return Vector3<Product>{a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

/// The vector with components of another type.
template <class S, class T>
Vector3<S> cast(const Vector3<T>& a) {
    return {S(a.x), S(a.y), S(a.z)};
}

/// The Euclidean length; T needs a square root.
template <class T>
T length(const Vector3<T>& a) {
    using std::sqrt;
    return sqrt(dot(a, a));
}

/// The 1-norm: the sum of the magnitudes of the components.
template <class T>
T norm1(const Vector3<T>& a) {
    const auto magnitude_of = [](const T& value) {
        if constexpr (std::is_same_v<T, double>)
            return std::abs(value);
        else
            return value < T(0) ? T(-value) : value;
    };
    return magnitude_of(a.x) + magnitude_of(a.y) + magnitude_of(a.z);
}

/// A matrix of three rows.
template <class T>
struct Matrix3 { // NOLINT(bugprone-reserved-identifier,readability-identifier-naming): of the implicit copy
    Vector3<T> row[3];

    friend Matrix3 operator+(const Matrix3& a, const Matrix3& b) {
        return {a.row[0] + b.row[0], a.row[1] + b.row[1], a.row[2] + b.row[2]};
    }
    /// The transposed matrix.
    [[nodiscard]] Matrix3 transposed() const {
        return {{{row[0].x, row[1].x, row[2].x}, {row[0].y, row[1].y, row[2].y}, {row[0].z, row[1].z, row[2].z}}};
    }
};

/// The product of a matrix and a vector.
template <class T, class V>
auto operator*(const Matrix3<T>& m, const Vector3<V>& v) {
    using Product = decltype(m.row[0].x * v.x);
    return Vector3<Product>{dot(m.row[0], v), dot(m.row[1], v), dot(m.row[2], v)};
}

/// The product of two matrices.
template <class A, class B>
auto operator*(const Matrix3<A>& a, const Matrix3<B>& b) {
    using Product = decltype(a.row[0].x * b.row[0].x);
    const Matrix3<B> columns = b.transposed();
    return Matrix3<Product>{{columns * a.row[0], columns * a.row[1], columns * a.row[2]}};
}

/// Every entry times a factor of any type.
template <class T, class S>
auto scale(const Matrix3<T>& m, const S& s) {
    using Product = decltype(m.row[0].x * s);
    return Matrix3<Product>{{scale(m.row[0], s), scale(m.row[1], s), scale(m.row[2], s)}};
}

/// The matrix of the map v -> a x v.
template <class T>
Matrix3<T> cross_matrix(const Vector3<T>& a) {
    const T zero{};
    return {{{zero, T(zero - a.z), a.y}, {a.z, zero, T(zero - a.x)}, {T(zero - a.y), a.x, zero}}};
}

/// The matrix a b^T.
template <class T>
Matrix3<T> outer(const Vector3<T>& a, const Vector3<T>& b) {
    return {{scale(b, a.x), scale(b, a.y), scale(b, a.z)}};
}

/// The identity.
template <class T>
Matrix3<T> identity_matrix() {
    const T zero(0);
    const T one(1);
    return {{{one, zero, zero}, {zero, one, zero}, {zero, zero, one}}};
}

} // namespace chasles::algebra
