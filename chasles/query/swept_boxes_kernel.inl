// One node against two nodes of the other body: the innermost loop of every query, and nothing else. This file is
// included once for each instruction set, in a namespace of its own, so that the compiler sees all of it at once.
// Source: docs/derivations/14-node-pairs.md.

/// Two halves of four lanes: x, y, z and nothing of two nodes.
typedef float Lanes __attribute__((vector_size(32)));
typedef std::int32_t Bits __attribute__((vector_size(32)));

inline Lanes all(float value) {
    return Lanes{value, value, value, value, value, value, value, value};
}
inline Lanes loaded(const SweptBoxes::TwoRows& rows) {
    Lanes lanes;
    std::memcpy(&lanes, rows.lanes.data(), sizeof lanes);
    return lanes;
}
inline Lanes magnitude(Lanes a) {
    return Lanes(Bits(a) & 0x7fffffff);
}

/// Lanes of each half exchanged with the one beside them, or with the one after that.
inline Lanes swapped(Lanes a) {
    return __builtin_shufflevector(a, a, 1, 0, 3, 2, 5, 4, 7, 6);
}
inline Lanes crossed(Lanes a) {
    return __builtin_shufflevector(a, a, 2, 3, 0, 1, 6, 7, 4, 5);
}
/// Of each half, in all its lanes.
inline Lanes sum(Lanes a) {
    const Lanes pairs = a + swapped(a);
    return pairs + crossed(pairs);
}

/// A matrix, by its columns, times the vector in each half.
inline Lanes product(const SweptBoxes::TwoRows* columns, Lanes v) {
    const Lanes x = __builtin_shufflevector(v, v, 0, 0, 0, 0, 4, 4, 4, 4);
    const Lanes y = __builtin_shufflevector(v, v, 1, 1, 1, 1, 5, 5, 5, 5);
    const Lanes z = __builtin_shufflevector(v, v, 2, 2, 2, 2, 6, 6, 6, 6);
    return loaded(columns[0]) * x + loaded(columns[1]) * y + loaded(columns[2]) * z;
}

/// Two lanes of each, in each half.
inline Lanes mixed(Lanes a, Lanes b) {
    return __builtin_shufflevector(a, b, 0, 1, 10, 11, 4, 5, 14, 15);
}

/// Bits of the lanes that are set.
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

inline Lanes chosen(Bits mask, Lanes a, Lanes b) {
    return Lanes((Bits(a) & mask) | (Bits(b) & ~mask));
}
inline Lanes greater(Lanes a, Lanes b) {
    return chosen(a < b, b, a);
}
inline Lanes lesser(Lanes a, Lanes b) {
    return chosen(a < b, a, b);
}

/// Two nodes, each in its half.
struct Boxes {
    Lanes centre;
    Lanes half;

    Boxes(const BoxNode& a, const BoxNode& b) {
        const Lanes lower = all(0.5F) * load(a, b, 0);
        const Lanes upper = all(0.5F) * load(a, b, offsetof(BoxNode, upper));
        centre = lower + upper;
        half = upper - lower;
    }

private:
    /// Three numbers of each, and one that does not count.
    static Lanes load(const BoxNode& a, const BoxNode& b, std::size_t offset) {
        typedef float Half __attribute__((vector_size(16)));
        Half low, high;
        std::memcpy(&low, reinterpret_cast<const char*>(&a) + offset, sizeof low);
        std::memcpy(&high, reinterpret_cast<const char*>(&b) + offset, sizeof high);
        const Lanes both = __builtin_shufflevector(low, high, 0, 1, 2, 3, 4, 5, 6, 7);
        return Lanes(Bits(both) & Bits{-1, -1, -1, 0, -1, -1, -1, 0});
    }
};

/// Their slabs.
struct Slabs {
    Lanes normal;
    Lanes inverse_square; ///< of the normal's length
    Lanes middle;
    Lanes half;

    Slabs(const BoxNode& a, const BoxNode& b, Lanes box_half) {
        const Lanes bytes = loaded(a.slab.bytes(), b.slab.bytes());
        const Lanes u = __builtin_shufflevector(bytes, bytes, 0, 0, 0, 0, 4, 4, 4, 4);
        const Lanes v = __builtin_shufflevector(bytes, bytes, 1, 1, 1, 1, 5, 5, 5, 5);
        const Lanes lower = __builtin_shufflevector(bytes, bytes, 2, 2, 2, 2, 6, 6, 6, 6);
        const Lanes upper = __builtin_shufflevector(bytes, bytes, 3, 3, 3, 3, 7, 7, 7, 7);
        const Lanes x = u + v;
        const Lanes y = u - v;
        const Lanes z = all(254) - magnitude(x) - magnitude(y);
        const Lanes xy = __builtin_shufflevector(x, y, 0, 8, 0, 8, 4, 12, 4, 12);
        const Lanes z0 = Lanes(Bits(z) & Bits{-1, -1, -1, 0, -1, -1, -1, 0});
        normal = all(PackedSlab::normal_unit) * __builtin_shufflevector(xy, z0, 0, 1, 10, 11, 4, 5, 14, 15);
        inverse_square = all(1) / sum(normal * normal);
        const Lanes reach = all(0.5F * PackedSlab::height_unit) * sum(magnitude(normal) * box_half);
        middle = reach * (upper + lower);
        half = reach * (upper - lower);
    }

private:
    /// Four signed bytes for each half.
    static Lanes loaded(std::uint32_t a, std::uint32_t b) {
#if defined(CHASLES_KERNEL_AVX2)
        const std::uint64_t both = std::uint64_t(b) << 32 | a;
        return Lanes(_mm256_cvtepi32_ps(_mm256_cvtepi8_epi32(_mm_cvtsi64_si128(std::int64_t(both)))));
#else
        typedef std::int8_t Bytes __attribute__((vector_size(8)));
        const std::uint32_t both[2] = {a, b};
        Bytes bytes;
        std::memcpy(&bytes, both, sizeof bytes);
        return __builtin_convertvector(bytes, Lanes);
#endif
    }
};

/// The parts of an interval in which no gap of a half is open. Gaps run evenly from start to end.
class Closed {
public:
    explicit Closed(const Window& when) : lower_(all(when.lower)), upper_(all(when.upper)) {}

    void see(Lanes start, Lanes end) {
        const Bits start_open = start > 0.0F;
        const Bits end_open = end > 0.0F;
        open_ |= start_open & end_open;
        if (bits_of(start_open | end_open) == 0)
            return;
        const Lanes crossing = start / (start - end);
        lower_ = greater(lower_, Lanes(Bits(crossing - all(window_slack)) & start_open));
        upper_ = lesser(upper_, chosen(end_open, crossing + all(window_slack), all(1)));
    }

    /// Each half has a gap that is open all along.
    [[nodiscard]] bool are_apart() const {
        const unsigned bits = bits_of(open_);
        return (bits & 0x0f) != 0 && (bits & 0xf0) != 0;
    }

    [[nodiscard]] SweptBoxes::Windows windows() const {
        Lanes lower = greater(lower_, swapped(lower_));
        lower = greater(lower, crossed(lower));
        Lanes upper = lesser(upper_, swapped(upper_));
        upper = lesser(upper, crossed(upper));
        const unsigned bits = bits_of(open_);
        return {(bits & 0x0f) != 0 ? never : Window{lower[0], upper[0]},
                (bits & 0xf0) != 0 ? never : Window{lower[4], upper[4]}};
    }

private:
    Lanes lower_;
    Lanes upper_;
    Bits open_{};
};

/// `there` shows the one node to the others, `here` shows them to the one.
inline SweptBoxes::Windows meetings(const BoxNode& node, const BoxNode* others, const SweptBoxes::View& there,
                                    const SweptBoxes::View& here, const Window& when) {
    const Boxes one(node, node);
    const Boxes two(others[0], others[1]);
    Closed closed(when);
    Lanes one_seen[2], reach[2]; // at the start and at the end; from the middle of the other box
    for (int end : {0, 1}) {
        one_seen[end] = product(there.turn[end], one.centre) + loaded(there.offset[end]) - two.centre;
        reach[end] = product(there.turn_size[end], one.half) + (two.half + all(there.slack));
    }
    closed.see(one_seen[0] - reach[0], one_seen[1] - reach[1]);
    closed.see(-one_seen[0] - reach[0], -one_seen[1] - reach[1]);
    if (closed.are_apart())
        return {never, never};
    // Along the normals of the slabs. What is left of a normal that the other body sees, without its part along the
    // other slab's normal, meets the other box.
    const Slabs one_slab(node, node, one.half);
    const Slabs two_slab(others[0], others[1], two.half);
    const Lanes sign{1, -1, 1, -1, 1, -1, 1, -1};
    Lanes gap[2];
    for (int end : {0, 1}) {
        const Lanes two_seen = product(here.turn[end], two.centre) + loaded(here.offset[end]) - one.centre;
        const Lanes one_normal = product(there.turn[end], one_slab.normal);
        const Lanes two_normal = product(here.turn[end], two_slab.normal);
        const Lanes along = sum(one_normal * two_slab.normal);
        const Lanes by_one = along * one_slab.inverse_square;
        const Lanes by_two = along * two_slab.inverse_square;
        const Lanes one_rest = magnitude(two_normal - by_one * one_slab.normal) * one.half;
        const Lanes two_rest = magnitude(one_normal - by_two * two_slab.normal) * two.half;
        const Lanes height = mixed(sum(one_slab.normal * two_seen) + (by_two * two_slab.middle - one_slab.middle),
                                   sum(two_slab.normal * one_seen[end]) + (by_one * one_slab.middle - two_slab.middle));
        const Lanes thick =
            mixed(sum(two_rest) + (magnitude(by_two) * two_slab.half + one_slab.half) + all(here.slack),
                  sum(one_rest) + (magnitude(by_one) * one_slab.half + two_slab.half) + all(there.slack));
        gap[end] = sign * height - thick;
    }
    closed.see(gap[0], gap[1]);
    return closed.windows();
}
