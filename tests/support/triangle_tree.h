// The distance of two bodies over all pairs of triangles, with a hierarchy of boxes that skips distant pairs. It is
// slow, uses extended precision, and shares no code with the library's queries. For sampling, which can only refute.
#pragma once

#include "chasles/mesh/polyhedron.h"
#include "chasles/motion/pose.h"
#include "tests/support/surface_distance.h"

#include <limits>
#include <memory>
#include <span>
#include <vector>

namespace chasles::test {

using LongPoint = Point3<long double>;
using LongTriangle = Triangle3<long double>;

/// A pose in extended precision.
struct LongPose {
    Eigen::Matrix<long double, 3, 3> turn = Eigen::Matrix<long double, 3, 3>::Identity();
    LongPoint shift = LongPoint::Zero();
    Eigen::Matrix3d rough_turn = Eigen::Matrix3d::Identity(); ///< for the boxes
    Eigen::Vector3d rough_shift = Eigen::Vector3d::Zero();

    LongPose() = default;
    explicit LongPose(const Pose& pose)
        : turn(Eigen::Quaterniond(pose.rotation).cast<long double>().normalized().toRotationMatrix()),
          shift(pose.translation.cast<long double>()), rough_turn(turn.cast<double>()), rough_shift(pose.translation) {}

    [[nodiscard]] LongTriangle operator()(const LongTriangle& t) const {
        return {turn * t[0] + shift, turn * t[1] + shift, turn * t[2] + shift};
    }
};

/// A box, given by its centre and half its size.
struct MiddleBox {
    Eigen::Vector3d middle;
    Eigen::Vector3d half;

    static MiddleBox around(const LongTriangle& t) {
        const LongPoint lower = t[0].cwiseMin(t[1]).cwiseMin(t[2]);
        const LongPoint upper = t[0].cwiseMax(t[1]).cwiseMax(t[2]);
        return {(0.5 * (lower + upper)).cast<double>(), (0.5 * (upper - lower)).cast<double>()};
    }
    /// The axis-aligned box of the moved box.
    [[nodiscard]] MiddleBox moved(const LongPose& pose) const {
        return {pose.rough_turn * middle + pose.rough_shift, pose.rough_turn.cwiseAbs() * half};
    }
    [[nodiscard]] double distance(const MiddleBox& other) const {
        return ((middle - other.middle).cwiseAbs() - half - other.half).cwiseMax(0).norm();
    }
};

/// A tree over the triangles of a body, with at most two triangles per leaf.
class TriangleTree {
public:
    struct Node {
        MiddleBox box;
        std::uint32_t first, last; ///< of the triangles
        std::uint32_t child = 0;   ///< first child; the second child follows; 0 for a leaf
    };

    /// Keeps the body's vertices by reference.
    explicit TriangleTree(const Polyhedron& body) : vertices_(body.vertices()) {
        for (std::uint32_t f = 0; f < body.face_count(); ++f)
            add_face(body, f);
        nodes_.push_back(node_of(0, std::uint32_t(corners_.size())));
        for (std::uint32_t i = 0; i < nodes_.size(); ++i) // it grows
            split(i);
        for (const auto& c : corners_) {
            triangles_.push_back({at(c[0]), at(c[1]), at(c[2])});
            boxes_.push_back(MiddleBox::around(triangles_.back()));
        }
    }

    [[nodiscard]] const std::vector<Node>& nodes() const { return nodes_; }
    [[nodiscard]] const LongTriangle& triangle(std::uint32_t i) const { return triangles_[i]; }
    [[nodiscard]] const MiddleBox& box(std::uint32_t i) const { return boxes_[i]; }
    /// The vertex ids of a triangle in the body.
    [[nodiscard]] const std::array<std::uint32_t, 3>& corners(std::uint32_t i) const { return corners_[i]; }
    [[nodiscard]] std::size_t size() const { return triangles_.size(); }

private:
    void add_face(const Polyhedron& body, std::uint32_t f) {
        const auto face = body.face(f);
        const auto cut = body.face_triangles(f);
        for (std::size_t i = 0; i + 2 < cut.size(); i += 3)
            corners_.push_back({face[cut[i]], face[cut[i + 1]], face[cut[i + 2]]});
        for (std::size_t i = 1; cut.empty() && i + 1 < face.size(); ++i)
            corners_.push_back({face[0], face[i], face[i + 1]});
    }

    [[nodiscard]] LongPoint at(std::uint32_t vertex) const { return vertices_[vertex].cast<long double>(); }

    [[nodiscard]] Node node_of(std::uint32_t first, std::uint32_t last) const {
        Eigen::AlignedBox3d box;
        for (std::uint32_t i = first; i < last; ++i)
            for (const std::uint32_t vertex : corners_[i])
                box.extend(vertices_[vertex]);
        return {{box.center(), 0.5 * box.sizes()}, first, last};
    }

    void split(std::uint32_t index) {
        const Node node = nodes_[index];
        if (node.last - node.first <= 2)
            return;
        Eigen::Index axis = 0;
        node.box.half.maxCoeff(&axis);
        const auto middle_of = [&](const std::array<std::uint32_t, 3>& c) {
            return vertices_[c[0]][axis] + vertices_[c[1]][axis] + vertices_[c[2]][axis];
        };
        const std::uint32_t middle = (node.first + node.last) / 2;
        std::nth_element(corners_.begin() + node.first, corners_.begin() + middle, corners_.begin() + node.last,
                         [&](const auto& a, const auto& b) { return middle_of(a) < middle_of(b); });
        nodes_[index].child = std::uint32_t(nodes_.size());
        nodes_.push_back(node_of(node.first, middle));
        nodes_.push_back(node_of(middle, node.last));
    }

    std::span<const Eigen::Vector3d> vertices_; ///< of the body
    std::vector<std::array<std::uint32_t, 3>> corners_;
    std::vector<LongTriangle> triangles_;
    std::vector<MiddleBox> boxes_; ///< of the triangles
    std::vector<Node> nodes_;
};

/// A triangle of a moving body and a triangle of a fixed body at the origin.
struct TrianglePair {
    std::uint32_t moving = 0;
    std::uint32_t fixed = 0;
    long double distance = std::numeric_limits<long double>::infinity();
};

class TreePair {
public:
    /// Keeps the vertices of both bodies by reference.
    TreePair(const Polyhedron& moving, const Polyhedron& fixed)
        : moving_(std::make_shared<TriangleTree>(moving)), fixed_(std::make_shared<TriangleTree>(fixed)) {}

    /// The nearest pair of triangles at most `at_most` apart, if any. The distance is 0 for surfaces that cross.
    TrianglePair nearest(const Pose& at, double at_most) {
        const LongPose pose(at);
        TrianglePair best = last_; // almost unchanged from step to step
        best.distance = distance(pose, best.moving, best.fixed);
        visit(
            pose, 0, 0, [&] { return std::min(double(best.distance), at_most); },
            [&](const TrianglePair& pair) {
                if (pair.distance < best.distance)
                    best = pair;
            });
        return last_ = best;
    }
    double distance(const Pose& at, double at_most) { return double(nearest(at, at_most).distance); }

    [[nodiscard]] const TriangleTree& moving() const { return *moving_; }
    [[nodiscard]] const TriangleTree& fixed() const { return *fixed_; }

private:
    [[nodiscard]] long double distance(const LongPose& pose, std::uint32_t a, std::uint32_t b) const {
        return std::sqrt(squared_distance_of_triangles<long double>(pose(moving_->triangle(a)), fixed_->triangle(b)));
    }

    /// Calls `see` for the pairs whose boxes are at most `limit` apart. The limit may decrease meanwhile.
    template <class Limit, class See>
    void visit(const LongPose& pose, std::uint32_t a, std::uint32_t b, const Limit& limit, const See& see) const {
        const TriangleTree::Node& m = moving_->nodes()[a];
        const TriangleTree::Node& f = fixed_->nodes()[b];
        if (m.child == 0 && f.child == 0)
            return visit_leaves(pose, m, f, limit, see);
        const bool is_moving = f.child == 0 || (m.child != 0 && m.box.half.norm() >= f.box.half.norm());
        std::array<std::pair<double, std::uint32_t>, 2> children;
        for (std::uint32_t i = 0; i < 2; ++i) {
            const std::uint32_t child = (is_moving ? m.child : f.child) + i;
            const MiddleBox& moving = is_moving ? moving_->nodes()[child].box : m.box;
            const MiddleBox& fixed = is_moving ? f.box : fixed_->nodes()[child].box;
            children[i] = {moving.moved(pose).distance(fixed), child};
        }
        std::ranges::sort(children);
        for (const auto& [apart, child] : children)
            if (apart <= limit() * (1 + 1e-9))
                visit(pose, is_moving ? child : a, is_moving ? b : child, limit, see);
    }

    template <class Limit, class See>
    void visit_leaves(const LongPose& pose, const TriangleTree::Node& m, const TriangleTree::Node& f,
                      const Limit& limit, const See& see) const {
        for (std::uint32_t i = m.first; i < m.last; ++i) {
            const LongTriangle moved = pose(moving_->triangle(i));
            const MiddleBox box = MiddleBox::around(moved);
            for (std::uint32_t j = f.first; j < f.last; ++j)
                if (box.distance(fixed_->box(j)) <= limit() * (1 + 1e-9))
                    see({i, j, std::sqrt(squared_distance_of_triangles<long double>(moved, fixed_->triangle(j)))});
        }
    }

    std::shared_ptr<const TriangleTree> moving_;
    std::shared_ptr<const TriangleTree> fixed_;
    TrianglePair last_;
};

} // namespace chasles::test
