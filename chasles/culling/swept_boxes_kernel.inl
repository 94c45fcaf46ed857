// Two nodes of one body against two nodes of the other: the innermost loop of every query, and nothing else. This file
// is included once for each instruction set, in a namespace of its own, so that the compiler sees all of it at once.
// Source: docs/derivations/14-node-pairs.md.

/// One number for each of four pairs of nodes, at the start and at the end: a0 b0, a0 b1, a1 b0, a1 b1, twice.
typedef float Lanes __attribute__((vector_size(32)));
typedef std::int32_t Bits __attribute__((vector_size(32)));

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
inline Lanes select(Bits mask, Lanes a, Lanes b) {
    return Lanes((Bits(a) & mask) | (Bits(b) & ~mask));
}
/// The second one where one is not a number; `greater` the first.
inline Lanes min(Lanes a, Lanes b) {
    return select(a < b, a, b);
}
inline Lanes max(Lanes a, Lanes b) {
    return select(a < b, b, a);
}
/// The start of one and of another gap, and their ends.
inline Lanes starts(Lanes a, Lanes b) {
    return __builtin_shufflevector(a, b, 0, 1, 2, 3, 8, 9, 10, 11);
}
inline Lanes ends(Lanes a, Lanes b) {
    return __builtin_shufflevector(a, b, 4, 5, 6, 7, 12, 13, 14, 15);
}
inline Lanes halves_swapped(Lanes a) {
    return __builtin_shufflevector(a, a, 4, 5, 6, 7, 0, 1, 2, 3);
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
inline Vectors magnitude(const Vectors& a) {
    return {magnitude(a.x), magnitude(a.y), magnitude(a.z)};
}
inline Lanes dot(const Vectors& a, const Vectors& b) {
    return a.x * b.x + a.y * b.y + a.z * b.z;
}
inline Vectors loaded(const SweptBoxes::BothEnds (&ends)[3]) {
    return {loaded(ends[0]), loaded(ends[1]), loaded(ends[2])};
}
inline Vectors turned(const SweptBoxes::View& view, const Vectors& v) {
    return {dot(loaded(view.turn[0]), v), dot(loaded(view.turn[1]), v), dot(loaded(view.turn[2]), v)};
}
/// By as much as any vector with components up to these.
inline Vectors turned_size(const SweptBoxes::View& view, const Vectors& v) {
    return {dot(magnitude(loaded(view.turn[0])), v), dot(magnitude(loaded(view.turn[1])), v),
            dot(magnitude(loaded(view.turn[2])), v)};
}

/// How numbers of the two nodes of a body are spread over the pairs that they are in.
struct Outer { ///< a0 a0 a1 a1
    static constexpr int second = 0b1100;
};
struct Inner { ///< b0 b1 b0 b1
    static constexpr int second = 0b1010;
};

template <class Order>
Lanes spread(const float& a, const float& b) {
#if defined(CHASLES_KERNEL_AVX2)
    return _mm256_blend_ps(_mm256_broadcast_ss(&a), _mm256_broadcast_ss(&b), Order::second * 0x11);
#else
    const auto lane = [&](int i) { return (Order::second >> i & 1) != 0 ? b : a; };
    return Lanes{lane(0), lane(1), lane(2), lane(3), lane(0), lane(1), lane(2), lane(3)};
#endif
}

/// The same for one of the four signed bytes in two words.
template <class Order, int place>
Lanes spread_byte(std::uint32_t a, std::uint32_t b) {
#if defined(CHASLES_KERNEL_AVX2)
    const auto from = [](int i) { return char(place + ((Order::second >> i & 1) != 0 ? 4 : 0)); };
    const __m128i order =
        _mm_setr_epi8(from(0), from(1), from(2), from(3), from(0), from(1), from(2), from(3), 0, 0, 0, 0, 0, 0, 0, 0);
    const __m128i words = _mm_cvtsi64_si128(std::int64_t(std::uint64_t(b) << 32 | a));
    return _mm256_cvtepi32_ps(_mm256_cvtepi8_epi32(_mm_shuffle_epi8(words, order)));
#else
    const auto byte = [](std::uint32_t word) { return float(std::int8_t(word >> (8 * place))); };
    return spread<Order>(byte(a), byte(b));
#endif
}

struct Boxes {
    Vectors centre;
    Vectors half;
};

template <class Order>
Boxes boxes_of(const TwoNodes& nodes) {
    const auto& [a, b] = nodes;
    const auto half_of = [](const float& of_a, const float& of_b) {
        return broadcast(0.5F) * spread<Order>(of_a, of_b);
    };
    const Vectors lower{half_of(a->lower[0], b->lower[0]), half_of(a->lower[1], b->lower[1]),
                        half_of(a->lower[2], b->lower[2])};
    const Vectors upper{half_of(a->upper[0], b->upper[0]), half_of(a->upper[1], b->upper[1]),
                        half_of(a->upper[2], b->upper[2])};
    return {lower + upper, upper - lower};
}

struct Slabs {
    Vectors normal;
    Lanes inverse_square; ///< of the normal's length
    Lanes middle;
    Lanes half;
};

template <class Order>
Slabs slabs_of(const TwoNodes& nodes, const Vectors& box_half) {
    const std::uint32_t a = nodes[0]->slab.bytes();
    const std::uint32_t b = nodes[1]->slab.bytes();
    const Lanes u = spread_byte<Order, 0>(a, b);
    const Lanes v = spread_byte<Order, 1>(a, b);
    const Lanes lower = spread_byte<Order, 2>(a, b);
    const Lanes upper = spread_byte<Order, 3>(a, b);
    const Lanes x = u + v;
    const Lanes y = u - v;
    const Lanes z = broadcast(254) - magnitude(x) - magnitude(y);
    Slabs slabs;
    slabs.normal = scale(Vectors{x, y, z}, broadcast(PackedSlab::normal_unit));
    slabs.inverse_square = broadcast(1) / dot(slabs.normal, slabs.normal);
    const Lanes reach = broadcast(0.5F * PackedSlab::height_unit) * dot(magnitude(slabs.normal), box_half);
    slabs.middle = reach * (upper + lower);
    slabs.half = reach * (upper - lower);
    return slabs;
}

/// The parts of an interval in which no gap of a pair is open. Gaps run evenly from start to end.
class Closed {
public:
    explicit Closed(const Window& when) : lower_(broadcast(when.lower)), upper_(broadcast(when.upper)) {}

    void see(Lanes a, Lanes b) {
        const Lanes start = starts(a, b);
        const Lanes end = ends(a, b);
        const Bits start_open = start > 0.0F;
        const Bits end_open = end > 0.0F;
        open_ |= start_open & end_open;
        if (bits_of(start_open | end_open) == 0)
            return;
        const Lanes crossing = start / (start - end);
        lower_ = max(lower_, Lanes(Bits(crossing - broadcast(window_slack)) & start_open));
        upper_ = min(select(end_open, crossing + broadcast(window_slack), broadcast(1)), upper_);
    }

    /// Each pair has a gap that is open all along.
    [[nodiscard]] bool are_apart() const { return open_pairs() == 0xf; }

    [[nodiscard]] SweptBoxes::Windows windows() const {
        const Lanes lower = max(lower_, halves_swapped(lower_));
        const Lanes upper = min(upper_, halves_swapped(upper_));
        const unsigned open = open_pairs();
        SweptBoxes::Windows windows;
        for (unsigned i = 0; i < 4; ++i)
            windows[i] = (open >> i & 1U) != 0 ? never : Window{lower[i], upper[i]};
        return windows;
    }

private:
    [[nodiscard]] unsigned open_pairs() const {
        const unsigned bits = bits_of(open_);
        return (bits | bits >> 4) & 0xf;
    }

    Lanes lower_; ///< for two gaps of each pair
    Lanes upper_;
    Bits open_{};
};

/// Along the axes of the frame that both bodies are seen in: how far the middle of one box is from that of the other,
/// and what they reach together.
inline void see_axes(Closed& closed, const Vectors& apart, const Vectors& reach) {
    closed.see(apart.x - reach.x, -apart.x - reach.x);
    closed.see(apart.y - reach.y, -apart.y - reach.y);
    closed.see(apart.z - reach.z, -apart.z - reach.z);
}

/// The length of a slab's normal or a ten-thousandth more: Newton's steps for a root of [1/3, 1] stay above it.
inline Lanes length_above(const Vectors& normal) {
    const Lanes square = dot(normal, normal);
    Lanes length = broadcast(0.5F) * (square + broadcast(1));
    for (int step = 0; step < 2; ++step)
        length = broadcast(0.5F) * (length + square / length);
    return length;
}

/// How far a patch reaches along a direction of its own frame, from the middle of its box: by its box, and by its slab.
struct Reach {
    Lanes by_box;
    Lanes middle; ///< of the slab, along the direction
    Lanes by_slab;
};

inline Reach reach_along(const Vectors& direction, const Boxes& boxes, const Slabs& slabs) {
    const Lanes share = dot(direction, slabs.normal) * slabs.inverse_square;
    const Lanes rest = dot(magnitude(direction - scale(slabs.normal, share)), boxes.half);
    return {dot(magnitude(direction), boxes.half), share * slabs.middle, rest + magnitude(share) * slabs.half};
}

/// Along the way from the middle of one box to that of the other, at a time in the interval, where both are small
/// beside the margin.
inline void see_middles(Closed& closed, const Boxes& a, const Boxes& b, const Slabs& a_slab, const Slabs& b_slab,
                        const Vectors& a_seen, const SweptBoxes::View& b_in_a, Lanes slack, float margin, float time) {
    const Lanes share{1 - time, 1 - time, 1 - time, 1 - time, time, time, time, time};
    const Vectors part = scale(a_seen, share);
    const Vectors apart{part.x + halves_swapped(part.x), part.y + halves_swapped(part.y),
                        part.z + halves_swapped(part.z)};
    const Vectors size = magnitude(apart);
    const Vectors way = scale(apart, broadcast(1) / (size.x + size.y + size.z));
    const Reach of_a = reach_along(turned(b_in_a, way), a, a_slab);
    const Reach of_b = reach_along(way, b, b_slab);
    const Lanes gap = dot(way, a_seen) - slack - broadcast(margin) * length_above(way);
    const Lanes between_slabs = of_a.middle - of_b.middle - of_a.by_slab - of_b.by_slab;
    closed.see(gap - of_a.by_box - of_b.by_box, gap + between_slabs);
}

/// `a_in_b` shows the first two nodes to the others, `b_in_a` shows the others to them.
inline SweptBoxes::Windows overlap_windows(const TwoNodes& outer, const TwoNodes& inner, const SweptBoxes::View& a_in_b,
                                           const SweptBoxes::View& b_in_a, float margin, const Window& when) {
    const Boxes a = boxes_of<Outer>(outer);
    const Boxes b = boxes_of<Inner>(inner);
    Lanes a_slack = broadcast(a_in_b.slack + margin);
    Lanes b_slack = broadcast(b_in_a.slack + margin);
    const Vectors a_seen = turned(a_in_b, a.centre) + loaded(a_in_b.offset) - b.centre;
    const Vectors b_seen = turned(b_in_a, b.centre) + loaded(b_in_a.offset) - a.centre;
    Closed closed(when);
    see_axes(closed, a_seen, turned_size(a_in_b, a.half) + (b.half + Vectors{a_slack, a_slack, a_slack}));
    see_axes(closed, b_seen, turned_size(b_in_a, b.half) + (a.half + Vectors{b_slack, b_slack, b_slack}));
    if (closed.are_apart())
        return {never, never, never, never};
    // Along the normals of the slabs. What is left of a normal that the other body sees, without its part along the
    // other slab's normal, meets the other box.
    const Slabs a_slab = slabs_of<Outer>(outer, a.half);
    const Slabs b_slab = slabs_of<Inner>(inner, b.half);
    if (margin > 0) { // along a normal of the other one it counts by that one's length
        a_slack = broadcast(a_in_b.slack) + broadcast(margin) * length_above(b_slab.normal);
        b_slack = broadcast(b_in_a.slack) + broadcast(margin) * length_above(a_slab.normal);
    }
    const Vectors a_normal = turned(a_in_b, a_slab.normal);
    const Vectors b_normal = turned(b_in_a, b_slab.normal);
    const Lanes along = dot(a_normal, b_slab.normal);
    const Lanes by_a = along * a_slab.inverse_square;
    const Lanes by_b = along * b_slab.inverse_square;
    const Lanes a_rest = dot(magnitude(b_normal - scale(a_slab.normal, by_a)), a.half);
    const Lanes b_rest = dot(magnitude(a_normal - scale(b_slab.normal, by_b)), b.half);
    const Lanes a_height = dot(b_slab.normal, a_seen) + (by_a * a_slab.middle - b_slab.middle);
    const Lanes b_height = dot(a_slab.normal, b_seen) + (by_b * b_slab.middle - a_slab.middle);
    const Lanes a_thick = a_rest + (magnitude(by_a) * a_slab.half + b_slab.half) + a_slack;
    const Lanes b_thick = b_rest + (magnitude(by_b) * b_slab.half + a_slab.half) + b_slack;
    closed.see(a_height - a_thick, -a_height - a_thick);
    closed.see(b_height - b_thick, -b_height - b_thick);
    if (margin > 0 && !closed.are_apart())
        see_middles(closed, a, b, a_slab, b_slab, a_seen, b_in_a, broadcast(a_in_b.slack), margin, when.lower);
    return closed.windows();
}
