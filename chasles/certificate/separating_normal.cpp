#include "chasles/certificate/separating_normal.h"

#include "chasles/culling/nearest_to_origin.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace chasles::certificate {

namespace {

/// Of all lengths that enter: what rounding may take, in double and in double-double. Nothing is proven by these: the
/// steps are checked in exact numbers.
constexpr double rounding = 1e-14;
constexpr double refined_rounding = 1e-28;

Integer nearest_integer(const DoubleDouble& value) {
    const double high = std::nearbyint(value.high());
    return Integer(high) + Integer(std::nearbyint((value.high() - high) + value.low()));
}

DoubleDouble as_number(Integer value) {
    const auto high = static_cast<double>(value);
    return DoubleDouble(high) + DoubleDouble(static_cast<double>(value - Integer(high)));
}

IntegerNormal in_integers(const Wide& direction, int bits) {
    double most = 0;
    for (int i = 0; i < 3; ++i)
        most = std::max(most, std::abs(direction[i].high()));
    const DoubleDouble factor = DoubleDouble(std::ldexp(1.0, bits)) / DoubleDouble(most);
    IntegerNormal normal;
    for (int i = 0; i < 3; ++i)
        normal[std::size_t(i)] = nearest_integer(direction[i] * factor);
    return normal;
}

std::string decimal(Integer value) {
    if (value == 0)
        return "0";
    std::string digits;
    for (Integer rest = value < 0 ? -value : value; rest > 0; rest /= 10)
        digits += char('0' + int(rest % 10));
    if (value < 0)
        digits += '-';
    std::ranges::reverse(digits);
    return digits;
}

} // namespace

std::string words_of(const IntegerNormal& normal) {
    return decimal(normal[0]) + " " + decimal(normal[1]) + " " + decimal(normal[2]);
}

PieceOfBodies::PieceOfBodies(const FaceTree& moving, const FaceTree& fixed, CertifiedPiece piece,
                             const DoubleDouble& reach)
    : moving_(moving), fixed_(fixed), piece_(std::move(piece)), reach_(reach), size_(reach.high() + piece_.size) {
    for (const FaceTree* const tree : {&moving, &fixed})
        size_ += length(tree->corner(0, 0)) + tree->node(0).extent;
}

namespace {

/// The corner of a node that is farthest along a direction.
Corner farthest(const FaceTree& tree, const FaceTree::Node& node, const Corner& direction) {
    struct Height {
        double height;
        Corner corner;
        explicit operator double() const { return height; }
        bool operator<(const Height& other) const { return height < other.height; }
    };
    const Corner sizes{std::abs(direction.x), std::abs(direction.y), std::abs(direction.z)};
    return tree
        .greatest(
            node, [&](const FaceTree::Node& n) { return dot(n.centre, direction) + dot(n.half, sizes); },
            [&](const Corner& c) {
                return Height{dot(c, direction), c};
            })
        .corner;
}

} // namespace

/// By Gilbert, Johnson and Keerthi's algorithm.
PieceOfBodies::Gap PieceOfBodies::gap_at(const Node& a, const Node& b, double tau) const {
    const Corner origin = piece_.rounded.place({}, tau);
    const Matrix3<double> columns{{piece_.rounded.turned({1, 0, 0}, tau), piece_.rounded.turned({0, 1, 0}, tau),
                                   piece_.rounded.turned({0, 0, 1}, tau)}}; // of the rotation
    const Matrix3<double> turn = columns.transposed();
    Corner way = turn * moving_.some_corner(a) + origin - fixed_.some_corner(b);
    Gap best{{1, 0, 0}, -std::numeric_limits<double>::infinity()};
    culling::Simplex simplex;
    for (int i = 0; i < 32; ++i) {
        const double distance = length(way);
        if (!(distance > rounding * size_))
            break;
        const Corner direction = scale(way, 1 / distance);
        const Corner back = scale(columns * direction, -1.0);
        const Corner support = turn * farthest(moving_, a, back) + origin - farthest(fixed_, b, direction);
        const double gap = dot(direction, support);
        if (gap > best.gap)
            best = {direction, gap};
        if (distance - gap <= 0.05 * (gap - reach_.high()))
            break;
        way = simplex.add(support);
    }
    return best;
}

template <class S>
S PieceOfBodies::least_of(const PieceMotion<S>& motion, const Wide& normal, const Node& a, const Node& b,
                          const Cell& cell) const {
    const Vector3<S> n{S(normal.x), S(normal.y), S(normal.z)};
    const Corner direction = chasles::motion::in_double(normal);
    const Corner sizes{std::abs(direction.x), std::abs(direction.y), std::abs(direction.z)};
    const double slack = rounding * size_ * length(direction); // of the bounds
    S offset = fixed_.greatest(
        b, [&](const Node& node) { return dot(node.centre, direction) + dot(node.half, sizes) + slack; },
        [&](const Corner& c) { return S(n.x * S(c.x) + n.y * S(c.y) + n.z * S(c.z)); });
    if (reach_ > DoubleDouble(0))
        offset =
            offset + (length(n) + S(1)) * S(reach_); // the least integer that is no less than the length is below that
    const PlaneForm<S> form = motion.against(n, offset, cell, {a.centre, length(a.half)});
    return S(0) - moving_.greatest(
                      a, [&](const Node& node) { return slack - form.least_in(node.centre, node.half); },
                      [&](const Corner& c) { return S(S(0) - form.least(c)); });
}

std::optional<IntegerNormal> PieceOfBodies::along(const Wide& direction, double gap, const Node& a, const Node& b,
                                                  const Cell& cell, double& least) const {
    const double lengths = a.extent + b.extent + reach_.high();
    const int bits = std::clamp(int(std::ceil(std::log2(lengths / gap))) + 4, 6, 100);
    const IntegerNormal normal = in_integers(direction, bits);
    const Wide wide{as_number(normal[0]), as_number(normal[1]), as_number(normal[2])};
    const double size = length(motion::in_double(wide));
    double slack = rounding * size_;
    if (bits <= 50) {
        least = least_of(piece_.rounded, wide, a, b, cell) / size;
        if (least > slack)
            return normal;
        if (least < -slack)
            return std::nullopt;
    }
    least = least_of(piece_.refined, wide, a, b, cell).high() / size;
    return least > refined_rounding * size_ ? std::optional(normal) : std::nullopt;
}

std::optional<IntegerNormal> PieceOfBodies::separate(const Node& a, const Node& b, const Cell& cell, const Corner& hint,
                                                     NotSeparated& why) const {
    double least = 0;
    if (dot(hint, hint) > 0)
        if (const auto normal = along(widened(hint), 0.1 * (a.extent + b.extent), a, b, cell, least))
            return normal;
    why = {};
    const double lower = double(cell.lower), upper = double(cell.upper);
    const double reach = reach_.high();
    for (const double tau : {upper, 0.5 * (lower + upper), lower}) {
        const auto [direction, gap] = gap_at(a, b, tau);
        if (gap - reach <= 1e-12 * size_)
            continue;
        if (const auto normal = along(widened(direction), gap - reach, a, b, cell, least))
            return normal;
        const double loss = gap - reach - least;
        why.loss = why.overlap ? loss : std::min(why.loss, loss);
        why.overlap = false;
    }
    return why.overlap && a.is_leaf() && b.is_leaf() ? by_features(a, b, cell) : std::nullopt;
}

namespace {

/// The normal of an outline, from the sum of the products of its sides.
Wide normal_of(std::span<const Wide> corners) {
    Wide sum;
    for (std::size_t i = 1; i + 1 < corners.size(); ++i)
        sum = sum + cross(corners[i] - corners[0], corners[i + 1] - corners[0]);
    return sum;
}

std::vector<Wide> sides_of(std::span<const Wide> corners) {
    std::vector<Wide> sides;
    for (std::size_t i = 0; i < corners.size(); ++i)
        sides.push_back(corners[(i + 1) % corners.size()] - corners[i]);
    return sides;
}

/// The directions of the separating axis theorem.
std::vector<Wide> axes_of(std::span<const Wide> first, std::span<const Wide> second) {
    const Wide a = normal_of(first), b = normal_of(second);
    std::vector<Wide> axes{a, b};
    const std::vector<Wide> of_first = sides_of(first), of_second = sides_of(second);
    for (const Wide& side : of_first) {
        axes.push_back(cross(a, side));
        for (const Wide& other : of_second)
            axes.push_back(cross(side, other));
    }
    for (const Wide& other : of_second)
        axes.push_back(cross(b, other));
    return axes;
}

/// Directions between nearest points where one of them is a corner and the other one is on a side, or a corner, too.
std::vector<Wide> ways_between(std::span<const Wide> first, std::span<const Wide> second) {
    std::vector<Wide> ways;
    const auto add_ways = [&](std::span<const Wide> corners, std::span<const Wide> outline) {
        for (const Wide& corner : corners)
            for (std::size_t i = 0; i < outline.size(); ++i) {
                const Wide apart = corner - outline[i], side = outline[(i + 1) % outline.size()] - outline[i];
                ways.push_back(apart);
                if (const DoubleDouble square = dot(side, side); square.high() > 0)
                    ways.push_back(apart - scale(side, dot(apart, side) / square));
            }
    };
    add_ways(first, second);
    add_ways(second, first);
    return ways;
}

struct Axis {
    double gap;
    Wide direction; ///< of unit length, from the second one to the first one
};

/// Along which two faces are apart, the greatest gap first. It is their distance if the ways between them are looked
/// at.
std::vector<Axis> gaps_of(std::span<const Wide> first, std::span<const Wide> second, bool with_ways) {
    std::vector<Wide> axes = axes_of(first, second);
    if (with_ways) {
        const std::vector<Wide> ways = ways_between(first, second);
        axes.insert(axes.end(), ways.begin(), ways.end());
    }
    std::vector<Axis> gaps;
    for (const Wide& axis : axes) {
        const DoubleDouble size = length(axis);
        if (!(size.high() > 0))
            continue;
        const Wide unit = scale(axis, DoubleDouble(1) / size);
        const auto height = [&](const Wide& point) { return dot(unit, point); };
        const auto [a, b] = std::ranges::minmax(first, {}, height);
        const auto [c, d] = std::ranges::minmax(second, {}, height);
        const double above = (height(a) - height(d)).high(), below = (height(c) - height(b)).high();
        gaps.push_back(above > below ? Axis{above, unit} : Axis{below, Wide() - unit});
    }
    std::ranges::stable_sort(gaps, std::ranges::greater(), &Axis::gap);
    return gaps;
}

std::vector<Wide> outline_of(const FaceTree& tree, std::uint32_t face) {
    std::vector<Wide> corners;
    for (std::size_t i = 0; i < tree.body().face(face).size(); ++i)
        corners.push_back(widened(tree.corner(face, i)));
    return corners;
}

} // namespace

/// Of two faces that are too near to each other for double.
std::optional<IntegerNormal> PieceOfBodies::by_features(const Node& a, const Node& b, const Cell& cell) const {
    const std::vector<Wide> second = outline_of(fixed_, fixed_.first_face(b));
    for (const DoubleDouble& tau : {cell.upper, cell.lower}) {
        std::vector<Wide> first;
        const std::uint32_t face = moving_.first_face(a);
        for (std::size_t i = 0; i < moving_.body().face(face).size(); ++i)
            first.push_back(piece_.refined.place(moving_.corner(face, i), tau));
        std::size_t tries = 0;
        for (const Axis& axis : gaps_of(first, second, reach_ > DoubleDouble(0))) {
            const double gap = (DoubleDouble(axis.gap) - reach_).high();
            if (!(gap > refined_rounding * size_) || tries++ == 4)
                break;
            double least = 0;
            if (const auto normal = along(axis.direction, gap, a, b, cell, least))
                return normal;
        }
    }
    return std::nullopt;
}

} // namespace chasles::certificate
