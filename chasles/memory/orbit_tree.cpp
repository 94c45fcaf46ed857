#include "chasles/memory/orbit_tree.h"

#include "chasles/algebra/arc_tangent.h"
#include "chasles/base/sort.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

namespace chasles::memory {

namespace {

using algebra::Vector3;
using std::numbers::pi;

/// Faces are divided until their images are that near to triangles, as a share of their size.
constexpr double flatness = 0x1p-9;
constexpr int most_divisions = 8; ///< of an edge
/// How little a split around the axis counts: strips along helices have thin hulls.
constexpr double share_of_turns = 0x1p-8;

double cross(const OrbitPoint& a, const OrbitPoint& b, const OrbitPoint& c) {
    return (b.radius - a.radius) * (c.rise - a.rise) - (b.rise - a.rise) * (c.radius - a.radius);
}

/// The distance of b from the line between a and c.
double distance_from(const OrbitPoint& a, const OrbitPoint& b, const OrbitPoint& c) {
    const Eigen::Vector2d line(c.radius - a.radius, c.rise - a.rise);
    const Eigen::Vector2d arm(b.radius - a.radius, b.rise - a.rise);
    const double square = line.squaredNorm();
    const double share = square > 0 ? std::clamp(arm.dot(line) / square, 0.0, 1.0) : 0;
    return (arm - share * line).norm();
}

/// Replaces points by the corners of their convex hull, counter-clockwise.
void take_hull(std::vector<OrbitPoint>& points) {
    chasles::sort(points, {}, [](const OrbitPoint& point) { return std::pair(point.radius, point.rise); });
    std::vector<OrbitPoint> hull;
    const auto add = [&hull](const OrbitPoint& point, std::size_t base) {
        while (hull.size() >= base + 2 && cross(hull[hull.size() - 2], hull.back(), point) <= 0)
            hull.pop_back();
        hull.push_back(point);
    };
    for (const OrbitPoint& point : points)
        add(point, 0);
    const std::size_t base = hull.size() - 1;
    for (auto point = points.rbegin() + 1; point < points.rend(); ++point)
        add(*point, base);
    if (hull.size() > 1)
        hull.pop_back();
    points = std::move(hull);
}

/// Leaves out the corners that matter least. Returns a bound of the distance from the rest of what is lost: the part
/// that a corner makes with its neighbours is nowhere farther from the line between them than the corner.
double simplify(std::vector<OrbitPoint>& hull, std::size_t most) {
    double lost = 0;
    while (hull.size() > most) {
        const std::size_t n = hull.size();
        std::size_t flattest = 0;
        double least = std::numeric_limits<double>::infinity();
        for (std::size_t i = 0; i < n; ++i)
            if (const double lost_here = distance_from(hull[(i + n - 1) % n], hull[i], hull[(i + 1) % n]);
                lost_here < least) {
                least = lost_here;
                flattest = i;
            }
        hull.erase(hull.begin() + static_cast<std::ptrdiff_t>(flattest));
        lost += least;
    }
    return lost;
}

/// Of a point seen from the axis.
double radius_of(const Vector3<double>& point) {
    return std::sqrt(point.x * point.x + point.y * point.y);
}

/// A disc around points, seen along the axis.
struct Disc {
    Vector3<double> middle{};
    double radius = 0;
    double longest_edge = 0;

    explicit Disc(std::span<const Vector3<double>> corners) {
        for (const Vector3<double>& corner : corners)
            middle = middle + scale(corner, 1 / double(corners.size()));
        for (std::size_t i = 0; i < corners.size(); ++i) {
            const Vector3<double> edge = corners[(i + 1) % corners.size()] - corners[i];
            radius = std::max(radius, radius_of(corners[i] - middle));
            longest_edge = std::max(longest_edge, radius_of(edge));
        }
    }
};

} // namespace

class OrbitTree::Builder {
public:
    Builder(OrbitTree& tree, const Body& body, const motion::AxisFrame& axis, double pitch)
        : tree_(tree), body_(body), axis_(axis), pitch_(pitch) {}

    void build();

private:
    struct Leaf {
        OrbitNode node;
        std::vector<OrbitPoint> hull;
        std::array<double, 3> middle{}; ///< radius, rise, and the share that counts of the way around
    };

    Leaf leaf_of(std::uint32_t face, std::uint32_t index);
    void add_image(Leaf& leaf, std::span<const Vector3<double>> corners);
    void add_grid(Leaf& leaf, std::span<const Vector3<double>> corners, int n, double near_turn);
    void add_point(Leaf& leaf, const Vector3<double>& point, double near_turn);
    void add_everything_around(Leaf& leaf, std::span<const Vector3<double>> corners) const;
    [[nodiscard]] Vector3<double> seen_from_axis(std::uint32_t vertex) const;
    [[nodiscard]] std::size_t widest_extent(std::size_t first, std::size_t count) const;
    std::size_t halve(std::size_t first, std::size_t count);
    void split_all();
    void close(std::size_t node);
    void add_corners(OrbitNode& node, const std::vector<OrbitPoint>& hull);
    static void finish(OrbitNode& node, std::vector<OrbitPoint>& hull);

    OrbitTree& tree_;
    const Body& body_;
    const motion::AxisFrame& axis_;
    double pitch_;
    std::vector<Leaf> leaves_;
};

Vector3<double> OrbitTree::Builder::seen_from_axis(std::uint32_t vertex) const {
    const Eigen::Vector3d& v = body_.vertices()[vertex];
    const Vector3<double> from = Vector3<double>{v.x(), v.y(), v.z()} - axis_.origin;
    return {dot(from, axis_.across), dot(from, axis_.beside), dot(from, axis_.along)};
}

void OrbitTree::Builder::add_point(Leaf& leaf, const Vector3<double>& point, double near_turn) {
    double turn = algebra::arc_tangent(point.y, point.x);
    turn += turn < near_turn - pi ? 2 * pi : turn > near_turn + pi ? -2 * pi : 0;
    leaf.node.first_turn = std::min(leaf.node.first_turn, turn);
    leaf.node.last_turn = std::max(leaf.node.last_turn, turn);
    leaf.hull.push_back({radius_of(point), point.z - pitch_ * turn});
}

/// What surrounds the axis, or is near to it, may have any turn.
void OrbitTree::Builder::add_everything_around(Leaf& leaf, std::span<const Vector3<double>> corners) const {
    leaf.node.first_turn = -pi;
    leaf.node.last_turn = pi;
    leaf.node.nearest = 0;
    double farthest = 0;
    for (const Vector3<double>& corner : corners)
        farthest = std::max(farthest, radius_of(corner));
    for (const Vector3<double>& corner : corners)
        for (const double radius : {0.0, farthest})
            for (const double turn : {-pi, pi})
                leaf.hull.push_back({radius, corner.z - pitch_ * turn});
}

/// A triangle's points, each edge divided in n.
void OrbitTree::Builder::add_grid(Leaf& leaf, std::span<const Vector3<double>> corners, int n, double near_turn) {
    const Vector3<double> u = scale(corners[1] - corners[0], 1.0 / n);
    const Vector3<double> v = scale(corners[2] - corners[0], 1.0 / n);
    for (int i = 0; i <= n; ++i)
        for (int j = 0; i + j <= n; ++j)
            add_point(leaf, corners[0] + scale(u, double(i)) + scale(v, double(j)), near_turn);
}

/// The image of a triangle, or of the hull of the corners of any polygon.
void OrbitTree::Builder::add_image(Leaf& leaf, std::span<const Vector3<double>> corners) {
    const Disc disc(corners);
    const double nearest = radius_of(disc.middle) - disc.radius;
    if (!(nearest > disc.radius / 4))
        return add_everything_around(leaf, corners);
    const double bend = 1 / nearest;                             // of radii
    const double twist = std::abs(pitch_) / (nearest * nearest); // of rises
    const double near_turn = algebra::arc_tangent(disc.middle.y, disc.middle.x);
    double square = disc.radius * disc.radius; // of the radius of a disc around each part
    if (corners.size() == 3) {
        const double wanted = std::sqrt((bend + twist) * disc.longest_edge / (6 * flatness));
        const int n = int(std::clamp(std::ceil(wanted), 1.0, double(most_divisions)));
        add_grid(leaf, corners, n, near_turn);
        square = disc.longest_edge * disc.longest_edge / (3.0 * n * n);
    } else {
        for (const Vector3<double>& corner : corners)
            add_point(leaf, corner, near_turn);
    }
    leaf.node.nearest = nearest;
    leaf.node.inward = bend * square / 2;
    leaf.node.rising = twist * square / 2;
}

OrbitTree::Builder::Leaf OrbitTree::Builder::leaf_of(std::uint32_t face, std::uint32_t index) {
    Leaf leaf;
    leaf.node.is_leaf = true;
    leaf.node.first = index;
    leaf.node.first_turn = std::numeric_limits<double>::infinity();
    leaf.node.last_turn = -leaf.node.first_turn;
    std::vector<Vector3<double>> corners;
    for (const std::uint32_t vertex : body_.face(face))
        corners.push_back(seen_from_axis(vertex));
    add_image(leaf, corners);
    take_hull(leaf.hull);
    finish(leaf.node, leaf.hull);
    const OrbitNode& node = leaf.node;
    leaf.middle = {(node.lower.radius + node.upper.radius) / 2, (node.lower.rise + node.upper.rise) / 2,
                   share_of_turns * node.upper.radius * (node.first_turn + node.last_turn) / 2};
    return leaf;
}

/// Slacks that are known, and the hull: gives the node its corners and its box.
void OrbitTree::Builder::finish(OrbitNode& node, std::vector<OrbitPoint>& hull) {
    node.around += simplify(hull, most_corners);
    node.lower = node.upper = hull.front();
    for (const OrbitPoint& corner : hull) {
        node.lower.radius = std::min(node.lower.radius, corner.radius);
        node.upper.radius = std::max(node.upper.radius, corner.radius);
        node.lower.rise = std::min(node.lower.rise, corner.rise);
        node.upper.rise = std::max(node.upper.rise, corner.rise);
    }
    node.lower.radius -= node.inward + node.around;
    node.upper.radius += node.around;
    node.lower.rise -= node.rising + node.around;
    node.upper.rise += node.rising + node.around;
}

std::size_t OrbitTree::Builder::widest_extent(std::size_t first, std::size_t count) const {
    std::array<double, 3> lower = leaves_[first].middle;
    std::array<double, 3> upper = lower;
    for (std::size_t i = first; i < first + count; ++i)
        for (std::size_t axis = 0; axis < 3; ++axis) {
            lower[axis] = std::min(lower[axis], leaves_[i].middle[axis]);
            upper[axis] = std::max(upper[axis], leaves_[i].middle[axis]);
        }
    const std::array extents{upper[0] - lower[0], upper[1] - lower[1], upper[2] - lower[2]};
    return std::size_t(std::max_element(extents.begin(), extents.end()) - extents.begin());
}

/// Orders leaves along the greatest extent of their middles, and returns the number of the first half.
std::size_t OrbitTree::Builder::halve(std::size_t first, std::size_t count) {
    const std::size_t widest = widest_extent(first, count);
    const auto begin = leaves_.begin() + static_cast<std::ptrdiff_t>(first);
    const auto half = static_cast<std::ptrdiff_t>(count / 2);
    std::nth_element(begin, begin + half, begin + static_cast<std::ptrdiff_t>(count),
                     [widest](const Leaf& a, const Leaf& b) { // no two are equal, so the halves are the same everywhere
                         return std::pair(a.middle[widest], a.node.first) < std::pair(b.middle[widest], b.node.first);
                     });
    return count / 2;
}

/// An inner node, from its children.
void OrbitTree::Builder::close(std::size_t index) {
    OrbitNode& node = tree_.nodes_[index];
    const OrbitNode& left = tree_.nodes_[node.first];
    const OrbitNode& right = tree_.nodes_[node.first + 1];
    node.first_turn = std::min(left.first_turn, right.first_turn);
    node.last_turn = std::max(left.last_turn, right.last_turn);
    node.nearest = std::min(left.nearest, right.nearest);
    node.inward = std::max(left.inward, right.inward);
    node.rising = std::max(left.rising, right.rising);
    node.around = std::max(left.around, right.around);
    const auto more = tree_.corners(right);
    std::vector<OrbitPoint> hull(tree_.corners(left).begin(), tree_.corners(left).end());
    hull.insert(hull.end(), more.begin(), more.end());
    take_hull(hull);
    finish(node, hull);
    add_corners(node, hull);
}

void OrbitTree::Builder::add_corners(OrbitNode& node, const std::vector<OrbitPoint>& hull) {
    node.corner = std::uint32_t(tree_.corners_.size());
    node.corner_count = std::uint8_t(hull.size());
    tree_.corners_.insert(tree_.corners_.end(), hull.begin(), hull.end());
}

/// All nodes; children follow their parents.
void OrbitTree::Builder::split_all() {
    struct Range {
        std::size_t first;
        std::size_t count;
    };
    std::vector<Range> ranges{{0, leaves_.size()}};
    for (std::size_t i = 0; i < ranges.size(); ++i) {
        const auto [first, count] = ranges[i];
        OrbitNode& node = tree_.nodes_.emplace_back();
        if (count == 1) {
            node = leaves_[first].node;
            add_corners(node, leaves_[first].hull);
        } else {
            node.first = std::uint32_t(ranges.size());
            const std::size_t half = halve(first, count);
            ranges.push_back({first, half});
            ranges.push_back({first + half, count - half});
        }
    }
}

void OrbitTree::Builder::build() {
    const auto hierarchy = body_.bvh().nodes();
    for (std::uint32_t i = 0; i < hierarchy.size(); ++i)
        if (hierarchy[i].is_leaf())
            leaves_.push_back(leaf_of(hierarchy[i].first, i));
    split_all();
    for (std::size_t i = tree_.nodes_.size(); i-- > 0;)
        if (!tree_.nodes_[i].is_leaf)
            close(i);
}

OrbitTree::OrbitTree(const Body& body, const motion::AxisFrame& axis, double pitch) {
    Builder(*this, body, axis, pitch).build();
}

} // namespace chasles::memory
