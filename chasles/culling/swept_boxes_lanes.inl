// Numbers and vectors on eight lanes, for swept_boxes_kernel.inl. swept_boxes.cpp includes this file once for each
// instruction set, each time in a separate namespace.

// Legend: a0 and a1 are the nodes of body a, b0 and b1 the nodes of body b.

/// One number for each pair of nodes, in the order a0 b0, a0 b1, a1 b0, a1 b1: four at the start of the interval, then
/// four at the end.
typedef float Lanes __attribute__((vector_size(32)));
typedef std::int32_t Bits __attribute__((vector_size(32)));

/// The same number in all lanes.
inline Lanes broadcast(float value) {
    return Lanes{value, value, value, value, value, value, value, value};
}
inline Lanes loaded(const SweptBoxes::BothEnds& ends) {
    Lanes lanes;
    std::memcpy(&lanes, ends.lanes.data(), sizeof lanes);
    return lanes;
}
inline Lanes magnitude(Lanes a) {
    return Lanes(Bits(a) & 0x7fffffff);
}
/// a where the mask is set, otherwise b.
inline Lanes select(Bits mask, Lanes a, Lanes b) {
    return Lanes((Bits(a) & mask) | (Bits(b) & ~mask));
}
/// The smaller number; b if a or b is not a number.
inline Lanes min(Lanes a, Lanes b) {
    return select(a < b, a, b);
}
/// The greater number; a if a or b is not a number.
inline Lanes max(Lanes a, Lanes b) {
    return select(a < b, b, a);
}
/// The values of two gaps at the start of the interval.
inline Lanes starts(Lanes a, Lanes b) {
    return __builtin_shufflevector(a, b, 0, 1, 2, 3, 8, 9, 10, 11);
}
/// The values of two gaps at the end of the interval.
inline Lanes ends(Lanes a, Lanes b) {
    return __builtin_shufflevector(a, b, 4, 5, 6, 7, 12, 13, 14, 15);
}
/// The lanes with start and end exchanged.
inline Lanes halves_swapped(Lanes a) {
    return __builtin_shufflevector(a, a, 4, 5, 6, 7, 0, 1, 2, 3);
}
inline Bits halves_swapped(Bits a) {
    return __builtin_shufflevector(a, a, 4, 5, 6, 7, 0, 1, 2, 3);
}

/// One bit for each lane of a mask.
inline unsigned bits_of(Bits mask) {
#if defined(CHASLES_KERNEL_AVX2)
    return unsigned(_mm256_movemask_ps(__m256(mask)));
#elif defined(__SSE2__)
    const __m128 low = __m128(__builtin_shufflevector(mask, mask, 0, 1, 2, 3));
    const __m128 high = __m128(__builtin_shufflevector(mask, mask, 4, 5, 6, 7));
    return unsigned(_mm_movemask_ps(low)) | unsigned(_mm_movemask_ps(high)) << 4;
#else
    unsigned bits = 0;
    for (unsigned i = 0; i < 8; ++i)
        bits |= mask[i] != 0 ? 1U << i : 0U;
    return bits;
#endif
}

/// A vector for each lane.
struct Vectors {
    Lanes x, y, z;
};

inline Vectors operator+(const Vectors& a, const Vectors& b) {
    return {a.x + b.x, a.y + b.y, a.z + b.z};
}
inline Vectors operator-(const Vectors& a, const Vectors& b) {
    return {a.x - b.x, a.y - b.y, a.z - b.z};
}
inline Vectors scale(const Vectors& a, Lanes factor) {
    return {a.x * factor, a.y * factor, a.z * factor};
}
inline Vectors reversed(const Vectors& a) {
    return {-a.x, -a.y, -a.z};
}
inline Vectors magnitude(const Vectors& a) {
    return {magnitude(a.x), magnitude(a.y), magnitude(a.z)};
}
inline Vectors select(Bits mask, const Vectors& a, const Vectors& b) {
    return {select(mask, a.x, b.x), select(mask, a.y, b.y), select(mask, a.z, b.z)};
}
inline Lanes dot(const Vectors& a, const Vectors& b) {
    return a.x * b.x + a.y * b.y + a.z * b.z;
}
inline Vectors loaded(const SweptBoxes::BothEnds (&ends)[3]) {
    return {loaded(ends[0]), loaded(ends[1]), loaded(ends[2])};
}
/// Vectors of one body in the frame of the other body.
inline Vectors rotated(const SweptBoxes::View& view, const Vectors& v) {
    return {dot(loaded(view.rotation[0]), v), dot(loaded(view.rotation[1]), v), dot(loaded(view.rotation[2]), v)};
}
/// Bounds of the components after rotation, for all vectors whose components are at most v in magnitude.
inline Vectors rotated_extent(const SweptBoxes::View& view, const Vectors& v) {
    return {dot(magnitude(loaded(view.rotation[0])), v), dot(magnitude(loaded(view.rotation[1])), v),
            dot(magnitude(loaded(view.rotation[2])), v)};
}

/// The lanes of node 1 among the four pairs: the order of the nodes of one body.
struct Outer { ///< a0 a0 a1 a1
    static constexpr int second = 0b1100;
};
struct Inner { ///< b0 b1 b0 b1
    static constexpr int second = 0b1010;
};

/// One number of each of the two nodes, distributed over the lanes of their pairs.
template <class Order>
Lanes distribute(const float& a, const float& b) {
#if defined(CHASLES_KERNEL_AVX2)
    return _mm256_blend_ps(_mm256_broadcast_ss(&a), _mm256_broadcast_ss(&b), Order::second * 0x11);
#else
    const auto lane = [&](int i) { return (Order::second >> i & 1) != 0 ? b : a; };
    return Lanes{lane(0), lane(1), lane(2), lane(3), lane(0), lane(1), lane(2), lane(3)};
#endif
}

/// The signed byte at `place` (0 to 3) of two words, distributed over the lanes of the pairs.
template <class Order, int place>
Lanes distribute_byte(std::uint32_t a, std::uint32_t b) {
#if defined(CHASLES_KERNEL_AVX2)
    const auto from = [](int i) { return char(place + ((Order::second >> i & 1) != 0 ? 4 : 0)); };
    const __m128i order =
        _mm_setr_epi8(from(0), from(1), from(2), from(3), from(0), from(1), from(2), from(3), 0, 0, 0, 0, 0, 0, 0, 0);
    const __m128i words = _mm_cvtsi64_si128(std::int64_t(std::uint64_t(b) << 32 | a));
    return _mm256_cvtepi32_ps(_mm256_cvtepi8_epi32(_mm_shuffle_epi8(words, order)));
#else
    const auto byte = [](std::uint32_t word) { return float(std::int8_t(word >> (8 * place))); };
    return distribute<Order>(byte(a), byte(b));
#endif
}
