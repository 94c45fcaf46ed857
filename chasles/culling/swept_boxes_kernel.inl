// The test of two nodes of one body against two nodes of the other body: the innermost loop of every query.
// swept_boxes.cpp includes this file once for each instruction set, each time in a separate namespace. All functions
// are in one translation unit and can be inlined. Source: docs/derivations/14-node-pairs.md.

// Legend: a0 and a1 are the nodes of body a, b0 and b1 the nodes of body b.

/// The boxes of the nodes, relative to the centre of their body.
struct Boxes {
    Vectors centre;
    Vectors half; ///< half of the side lengths
};

/// Centres and half sides. Halving before the sum is exact.
template <class Order>
[[gnu::always_inline]] inline Boxes boxes_of(const TwoNodes& nodes) {
    const auto& [a, b] = nodes;
    const auto half_of = [](const float& of_a, const float& of_b) {
        return broadcast(0.5F) * distribute<Order>(of_a, of_b);
    };
    const Vectors lower{half_of(a->lower[0], b->lower[0]), half_of(a->lower[1], b->lower[1]),
                        half_of(a->lower[2], b->lower[2])};
    const Vectors upper{half_of(a->upper[0], b->upper[0]), half_of(a->upper[1], b->upper[1]),
                        half_of(a->upper[2], b->upper[2])};
    return {lower + upper, upper - lower};
}

/// The slabs of the nodes: normal . y is between middle - half and middle + half, for y relative to the box centre.
struct Slabs {
    Vectors normal;
    Lanes inverse_square; ///< 1 / |normal|^2
    Lanes middle;
    Lanes half;
};

/// Unpacks the slabs as `PackedSlab` does.
template <class Order>
[[gnu::always_inline]] inline Slabs slabs_of(const TwoNodes& nodes, const Vectors& box_half) {
    const std::uint32_t a = nodes[0]->slab.bytes();
    const std::uint32_t b = nodes[1]->slab.bytes();
    const Lanes u = distribute_byte<Order, 0>(a, b);
    const Lanes v = distribute_byte<Order, 1>(a, b);
    const Lanes lower = distribute_byte<Order, 2>(a, b);
    const Lanes upper = distribute_byte<Order, 3>(a, b);
    const Lanes x = u + v;
    const Lanes y = u - v;
    const Lanes z = broadcast(254) - magnitude(x) - magnitude(y);
    Slabs slabs;
    slabs.normal = scale(Vectors{x, y, z}, broadcast(PackedSlab::normal_unit));
    slabs.inverse_square = broadcast(1) / dot(slabs.normal, slabs.normal);
    const Lanes half_unit = broadcast(0.5F * PackedSlab::height_unit) * dot(magnitude(slabs.normal), box_half);
    slabs.middle = half_unit * (upper + lower);
    slabs.half = half_unit * (upper - lower);
    return slabs;
}

/// A direction of gaps, in the frame of body b: from the patch of b to the patch of a.
struct Direction {
    Vectors vector;
    Lanes length; ///< or more
};

/// The part of the interval in which no tested direction separates a pair. A gap is linear in time; it is open where it
/// is positive.
class OverlapWindow {
public:
    explicit OverlapWindow(const Window& when) : lower_(broadcast(when.lower)), upper_(broadcast(when.upper)) {}

    /// Excludes the times at which gap a or gap b is open. Without branches: which gaps are open cannot be foretold.
    void add(const Direction& /*along*/, Lanes a, Lanes b) { add(a, b); }
    void add_along_one(const Direction& along, Lanes a, Lanes b) { add(along, a, b); }

    /// Whether each pair has a gap that is open during the whole interval.
    [[nodiscard]] bool are_apart() const { return open_pairs() == 0xf; }

    /// The windows of the four pairs. The intersection of the lanes of gap a and gap b gives each window.
    [[nodiscard]] SweptBoxes::Windows windows() const {
        const Bits open = open_ | halves_swapped(open_);
        const Lanes lower = select(open, broadcast(never.lower), max(lower_, halves_swapped(lower_)));
        const Lanes upper = select(open, broadcast(never.upper), min(upper_, halves_swapped(upper_)));
        const Lanes in_turn = __builtin_shufflevector(lower, upper, 0, 8, 1, 9, 2, 10, 3, 11);
        std::array<float, 8> ends;
        std::memcpy(ends.data(), &in_turn, sizeof ends);
        return std::bit_cast<SweptBoxes::Windows>(ends);
    }

private:
    void add(Lanes a, Lanes b) {
        const Lanes start = starts(a, b);
        const Lanes end = ends(a, b);
        const Bits start_open = start > 0.0F;
        const Bits end_open = end > 0.0F;
        open_ |= start_open & end_open;
        const Lanes crossing = start / (start - end);
        lower_ = max(lower_, Lanes(Bits(crossing - broadcast(window_slack)) & start_open));
        upper_ = min(select(end_open, crossing + broadcast(window_slack), broadcast(1)), upper_);
    }

    /// One bit for each pair that is separated during the whole interval.
    [[nodiscard]] unsigned open_pairs() const {
        const unsigned bits = bits_of(open_);
        return (bits | bits >> 4) & 0xf;
    }

    Lanes lower_; ///< of gap a in the first four lanes, of gap b in the last four
    Lanes upper_;
    Bits open_{}; ///< lanes with a gap that is open during the whole interval
};

/// An upper bound of the length of a vector of 1-norm one, at most 1e-4 above it. Two Newton steps for the square root
/// of a number in [1/3, 1] stay above the root.
[[gnu::always_inline]] inline Lanes length_above(const Vectors& normal) {
    const Lanes square = dot(normal, normal);
    Lanes length = broadcast(0.5F) * (square + broadcast(1));
    for (int step = 0; step < 2; ++step)
        length = broadcast(0.5F) * (length + square / length);
    return length;
}

/// The widest gaps of each pair.
class WidestGaps {
public:
    /// Gaps along a vector and along the opposite one.
    void add(const Direction& along, Lanes a, Lanes b) {
        const Lanes per_length = broadcast(1) / along.length;
        a = a * per_length;
        b = b * per_length;
        const Vectors unit = scale(along.vector, per_length);
        add(max(a, b), select(a > b, unit, reversed(unit)));
        on_way_ = max(on_way_, max(on_way(a), on_way(b)));
    }
    /// Two bounds of the gap along one vector.
    void add_along_one(const Direction& along, Lanes a, Lanes b) {
        const Lanes per_length = broadcast(1) / along.length;
        const Lanes gap = max(a, b) * per_length;
        add(gap, scale(along.vector, per_length));
        on_way_ = max(on_way_, on_way(gap));
    }

    [[nodiscard]] SweptBoxes::Gaps gaps() const {
        SweptBoxes::Gaps gaps;
        const auto store_starts = [](Lanes lanes, std::array<float, 4>& starts) {
            lanes = lanes * broadcast(direction_length);
            std::memcpy(starts.data(), &lanes, sizeof starts);
        };
        store_starts(widest_, gaps.start);
        store_starts(along_.x, gaps.along[0]);
        store_starts(along_.y, gaps.along[1]);
        store_starts(along_.z, gaps.along[2]);
        const Lanes on_way =
            min(on_way_, halves_swapped(on_way_)); // where one end is not a number, the other one tells
        std::memcpy(gaps.on_way.data(), &on_way, sizeof gaps.on_way);
        return gaps;
    }

private:
    void add(Lanes gap, const Vectors& along) {
        const Bits is_wider = gap > widest_;
        widest_ = select(is_wider, gap, widest_);
        along_ = select(is_wider, along, along_);
    }
    /// The gap that is open at both ends.
    static Lanes on_way(Lanes gap) { return min(gap, halves_swapped(gap)); }

    Lanes widest_{}; ///< 0 where nothing separates
    Vectors along_{};
    Lanes on_way_{};
};

/// The placement of each pair in both frames.
struct PairPlacement {
    const SweptBoxes::View& a_in_b; ///< points of body a in the frame of body b
    const SweptBoxes::View& b_in_a;
    Vectors a_from_b; ///< the centre of box a relative to the centre of box b, in the frame of b
    Vectors b_from_a; ///< the centre of box b relative to the centre of box a, in the frame of a
};

[[gnu::always_inline]] inline PairPlacement placement_of(const Boxes& a, const Boxes& b, const SweptBoxes::View& a_in_b,
                                                         const SweptBoxes::View& b_in_a) {
    return {a_in_b, b_in_a, rotated(a_in_b, a.centre) + loaded(a_in_b.offset) - b.centre,
            rotated(b_in_a, b.centre) + loaded(b_in_a.offset) - a.centre};
}

/// The axes of one frame, in the frame of body b.
struct Axes {
    Vectors x, y, z;
};

[[gnu::always_inline]] inline Axes axes_of_b() {
    const Lanes zero = broadcast(0), one = broadcast(1);
    return {{one, zero, zero}, {zero, one, zero}, {zero, zero, one}};
}

/// The axes of body a, reversed: its view of b is from a to b.
[[gnu::always_inline]] inline Axes reversed_axes_of_a(const SweptBoxes::View& a_in_b) {
    const auto axis = [&](int j) {
        return reversed({loaded(a_in_b.rotation[0][j]), loaded(a_in_b.rotation[1][j]), loaded(a_in_b.rotation[2][j])});
    };
    return {axis(0), axis(1), axis(2)};
}

/// Tests the axes of one frame. `centre` is the centre of one box relative to the other; `extent` is the sum of both
/// half sides.
template <class Test>
[[gnu::always_inline]] inline void test_axes(Test& window, const Axes& axes, const Vectors& centre,
                                             const Vectors& extent) {
    const Lanes one = broadcast(1);
    window.add({axes.x, one}, centre.x - extent.x, -centre.x - extent.x);
    window.add({axes.y, one}, centre.y - extent.y, -centre.y - extent.y);
    window.add({axes.z, one}, centre.z - extent.z, -centre.z - extent.z);
}

/// Tests the axes of both boxes.
template <class Test>
[[gnu::always_inline]] inline void test_box_axes(Test& window, const PairPlacement& pair, const Boxes& a,
                                                 const Boxes& b, float margin) {
    const Lanes a_slack = broadcast(pair.a_in_b.slack + margin);
    const Lanes b_slack = broadcast(pair.b_in_a.slack + margin);
    test_axes(window, axes_of_b(), pair.a_from_b,
              rotated_extent(pair.a_in_b, a.half) + (b.half + Vectors{a_slack, a_slack, a_slack}));
    test_axes(window, reversed_axes_of_a(pair.a_in_b), pair.b_from_a,
              rotated_extent(pair.b_in_a, b.half) + (a.half + Vectors{b_slack, b_slack, b_slack}));
}

/// The patches of the nodes of one body, enclosed in boxes and in slabs.
struct Patches {
    Boxes box;
    Slabs slab;
};

/// Tests the normals of both slabs. The height of a patch along the other slab's normal n' is bounded by its slab for
/// the part of n' along its own normal, and by its box for the rest of n'.
template <class Test>
[[gnu::always_inline]] inline void test_slab_normals(Test& window, const PairPlacement& pair, const Patches& a,
                                                     const Patches& b, float margin) {
    Lanes a_slack = broadcast(pair.a_in_b.slack + margin);
    Lanes b_slack = broadcast(pair.b_in_a.slack + margin);
    if (margin > 0) { // the margin counts by the length of the normal
        a_slack = broadcast(pair.a_in_b.slack) + broadcast(margin) * length_above(b.slab.normal);
        b_slack = broadcast(pair.b_in_a.slack) + broadcast(margin) * length_above(a.slab.normal);
    }
    const Vectors a_normal = rotated(pair.a_in_b, a.slab.normal);
    const Vectors b_normal = rotated(pair.b_in_a, b.slab.normal);
    const Lanes along = dot(a_normal, b.slab.normal);
    const Lanes by_a = along * a.slab.inverse_square;
    const Lanes by_b = along * b.slab.inverse_square;
    const Lanes a_rest = dot(magnitude(b_normal - scale(a.slab.normal, by_a)), a.box.half);
    const Lanes b_rest = dot(magnitude(a_normal - scale(b.slab.normal, by_b)), b.box.half);
    const Lanes a_height = dot(b.slab.normal, pair.a_from_b) + (by_a * a.slab.middle - b.slab.middle);
    const Lanes b_height = dot(a.slab.normal, pair.b_from_a) + (by_b * b.slab.middle - a.slab.middle);
    const Lanes a_thick = a_rest + (magnitude(by_a) * a.slab.half + b.slab.half) + a_slack;
    const Lanes b_thick = b_rest + (magnitude(by_b) * b.slab.half + a.slab.half) + b_slack;
    window.add({b.slab.normal, length_above(b.slab.normal)}, a_height - a_thick, -a_height - a_thick);
    window.add({reversed(a_normal), length_above(a.slab.normal)}, b_height - b_thick, -b_height - b_thick);
}

/// The support of a patch along a direction of its own frame, relative to the centre of its box.
struct Support {
    Lanes by_box;  ///< half of the width of the box
    Lanes middle;  ///< height of the middle of the slab
    Lanes by_slab; ///< half of the width that the slab and the box allow
};

[[gnu::always_inline]] inline Support support_along(const Vectors& direction, const Patches& patches) {
    const Boxes& boxes = patches.box;
    const Slabs& slabs = patches.slab;
    const Lanes share = dot(direction, slabs.normal) * slabs.inverse_square;
    const Lanes rest = dot(magnitude(direction - scale(slabs.normal, share)), boxes.half);
    return {dot(magnitude(direction), boxes.half), share * slabs.middle, rest + magnitude(share) * slabs.half};
}

/// The points of boxes around the origin with these half sides that are nearest to v.
inline Vectors clamped(const Vectors& v, const Vectors& half) {
    const auto clamp = [](Lanes x, Lanes most) { return max(min(x, most), -most); };
    return {clamp(v.x, half.x), clamp(v.y, half.y), clamp(v.z, half.z)};
}

/// The vectors between two points of the boxes that are near each other, in the frame of b: from the middle of box a
/// to box b, back to box a and again to box b. Zero if one of the points is in both boxes.
[[gnu::always_inline]] inline Vectors between_boxes(const PairPlacement& pair, const Boxes& a, const Boxes& b) {
    const Vectors on_b = clamped(pair.a_from_b, b.half);
    const Vectors on_a = clamped(rotated(pair.b_in_a, on_b - pair.a_from_b), a.half);
    const Vectors from_b = pair.a_from_b + rotated(pair.a_in_b, on_a);
    return from_b - clamped(from_b, b.half);
}

/// Tests the direction between near points of the boxes at one time of the interval. This
/// direction separates boxes that are small compared with the margin.
template <class Test>
[[gnu::always_inline]] inline void test_nearest_axis(Test& window, const PairPlacement& pair, const Patches& a,
                                                     const Patches& b, float margin, float time) {
    const Lanes share{1 - time, 1 - time, 1 - time, 1 - time, time, time, time, time};
    const auto at_time = [&](const Vectors& ends) {
        const Vectors part = scale(ends, share);
        return Vectors{part.x + halves_swapped(part.x), part.y + halves_swapped(part.y),
                       part.z + halves_swapped(part.z)};
    };
    const Vectors apart = at_time(between_boxes(pair, a.box, b.box));
    const Vectors size = magnitude(apart);
    const Vectors axis = scale(apart, broadcast(1) / (size.x + size.y + size.z));
    const Support of_a = support_along(rotated(pair.b_in_a, axis), a);
    const Support of_b = support_along(axis, b);
    const Lanes gap = dot(axis, pair.a_from_b) - broadcast(pair.a_in_b.slack) - broadcast(margin) * length_above(axis);
    const Lanes between_slabs = of_a.middle - of_b.middle - of_a.by_slab - of_b.by_slab;
    window.add_along_one({axis, length_above(axis)}, gap - of_a.by_box - of_b.by_box, gap + between_slabs);
}

/// The windows of the four pairs of the nodes `outer` of body a and the nodes `inner` of body b.
inline SweptBoxes::Windows overlap_windows(const TwoNodes& outer, const TwoNodes& inner, const SweptBoxes::View& a_in_b,
                                           const SweptBoxes::View& b_in_a, float margin, const Window& when) {
    const Boxes a_box = boxes_of<Outer>(outer);
    const Boxes b_box = boxes_of<Inner>(inner);
    const PairPlacement pair = placement_of(a_box, b_box, a_in_b, b_in_a);
    OverlapWindow window(when);
    test_box_axes(window, pair, a_box, b_box, margin);
    if (window.are_apart())
        return {never, never, never, never};
    const Patches a{a_box, slabs_of<Outer>(outer, a_box.half)};
    const Patches b{b_box, slabs_of<Inner>(inner, b_box.half)};
    test_slab_normals(window, pair, a, b, margin);
    if (margin > 0 && !window.are_apart())
        test_nearest_axis(window, pair, a, b, margin, when.lower);
    return window.windows();
}

/// The gaps of the four pairs.
inline SweptBoxes::Gaps widest_gaps(const TwoNodes& outer, const TwoNodes& inner, const SweptBoxes::View& a_in_b,
                                    const SweptBoxes::View& b_in_a) {
    const Boxes a_box = boxes_of<Outer>(outer);
    const Boxes b_box = boxes_of<Inner>(inner);
    const PairPlacement pair = placement_of(a_box, b_box, a_in_b, b_in_a);
    const Patches a{a_box, slabs_of<Outer>(outer, a_box.half)};
    const Patches b{b_box, slabs_of<Inner>(inner, b_box.half)};
    WidestGaps widest;
    test_box_axes(widest, pair, a_box, b_box, 0);
    test_slab_normals(widest, pair, a, b, 0);
    test_nearest_axis(widest, pair, a, b, 0, 0.5F);
    return widest.gaps();
}
