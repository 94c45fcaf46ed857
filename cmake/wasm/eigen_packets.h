// Gives Eigen the vector registers of WebAssembly for doubles. Eigen then adds in the same order as with SSE2, and
// answers have the bits of the native library (docs/decisions/0082-which-bits-are-the-same.md). Every source includes
// this header first.
#pragma once

#define EIGEN_VECTORIZE
#define EIGEN_ARCH_DEFAULT_NUMBER_OF_REGISTERS 16
#define EIGEN_MAX_STATIC_ALIGN_BYTES 16
#include <Eigen/Geometry>

namespace Eigen::internal {

typedef double Packet2d __attribute__((vector_size(16)));

template <>
struct is_arithmetic<Packet2d> {
    enum { value = true };
};
template <>
struct packet_traits<double> : default_packet_traits {
    using type = Packet2d;
    using half = Packet2d;
    enum { Vectorizable = 1, AlignedOnScalar = 1, size = 2, HasHalfPacket = 0, HasDiv = 1, HasSqrt = 1 };
};
template <>
struct unpacket_traits<Packet2d> {
    using type = double;
    using half = Packet2d;
    enum {
        size = 2,
        alignment = Aligned16,
        vectorizable = true,
        masked_load_available = false,
        masked_store_available = false
    };
};

// Sums, differences, products and quotients are those of the compiler's vectors.
template <>
EIGEN_STRONG_INLINE Packet2d pset1<Packet2d>(const double& x) {
    return Packet2d{x, x};
}
template <>
EIGEN_STRONG_INLINE Packet2d plset<Packet2d>(const double& x) {
    return Packet2d{x, x + 1};
}
template <>
EIGEN_STRONG_INLINE Packet2d ploadu<Packet2d>(const double* from) {
    return Packet2d{from[0], from[1]};
}
template <>
EIGEN_STRONG_INLINE Packet2d pload<Packet2d>(const double* from) {
    return ploadu<Packet2d>(from);
}
template <>
EIGEN_STRONG_INLINE Packet2d ploaddup<Packet2d>(const double* from) {
    return pset1<Packet2d>(*from);
}
template <>
EIGEN_STRONG_INLINE void pstoreu<double>(double* to, const Packet2d& from) {
    to[0] = from[0];
    to[1] = from[1];
}
template <>
EIGEN_STRONG_INLINE void pstore<double>(double* to, const Packet2d& from) {
    pstoreu(to, from);
}
template <>
EIGEN_STRONG_INLINE Packet2d pgather<double, Packet2d>(const double* from, Index stride) {
    return Packet2d{from[0], from[stride]};
}
template <>
EIGEN_STRONG_INLINE void pscatter<double, Packet2d>(double* to, const Packet2d& from, Index stride) {
    to[0] = from[0];
    to[stride] = from[1];
}
template <>
EIGEN_STRONG_INLINE double pfirst<Packet2d>(const Packet2d& a) {
    return a[0];
}
template <>
EIGEN_STRONG_INLINE Packet2d pconj(const Packet2d& a) {
    return a;
}
template <>
EIGEN_STRONG_INLINE Packet2d pabs(const Packet2d& a) {
    return __builtin_elementwise_abs(a);
}
template <>
EIGEN_STRONG_INLINE Packet2d psqrt<Packet2d>(const Packet2d& a) {
    return __builtin_elementwise_sqrt(a);
}
template <>
EIGEN_STRONG_INLINE Packet2d pmin<Packet2d>(const Packet2d& a, const Packet2d& b) {
    return b < a ? b : a;
}
template <>
EIGEN_STRONG_INLINE Packet2d pmax<Packet2d>(const Packet2d& a, const Packet2d& b) {
    return a < b ? b : a;
}
template <>
EIGEN_STRONG_INLINE Packet2d preverse(const Packet2d& a) {
    return Packet2d{a[1], a[0]};
}
template <>
EIGEN_STRONG_INLINE double predux<Packet2d>(const Packet2d& a) {
    return a[0] + a[1];
}
template <>
EIGEN_STRONG_INLINE double predux_mul<Packet2d>(const Packet2d& a) {
    return a[0] * a[1];
}
template <>
EIGEN_STRONG_INLINE double predux_min<Packet2d>(const Packet2d& a) {
    return a[0] < a[1] ? a[0] : a[1];
}
template <>
EIGEN_STRONG_INLINE double predux_max<Packet2d>(const Packet2d& a) {
    return a[0] > a[1] ? a[0] : a[1];
}
EIGEN_STRONG_INLINE void ptranspose(PacketBlock<Packet2d, 2>& kernel) {
    const Packet2d first = kernel.packet[0], second = kernel.packet[1];
    kernel.packet[0] = Packet2d{first[0], second[0]};
    kernel.packet[1] = Packet2d{first[1], second[1]};
}

/// The product of quaternions in the order of the SSE2 version (Eigen/src/Geometry/arch/Geometry_SIMD.h).
template <class A, class B>
struct quat_product<Architecture::Target, A, B, double> {
    static EIGEN_STRONG_INLINE Quaternion<double> run(const QuaternionBase<A>& a, const QuaternionBase<B>& b) {
        return {(a.w() * b.w() - a.y() * b.y()) - (a.z() * b.z() + a.x() * b.x()),
                (a.w() * b.x() + a.y() * b.z()) - (a.z() * b.y() - a.x() * b.w()),
                (a.w() * b.y() + a.y() * b.w()) + (a.z() * b.x() - a.x() * b.z()),
                (a.w() * b.z() - a.y() * b.x()) + (a.z() * b.w() + a.x() * b.y())};
    }
};

} // namespace Eigen::internal
