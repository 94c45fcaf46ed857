// Bounds of the distance of two surfaces over a part of a piece, linear in tau.
// Source: docs/derivations/39-profile.md.
#pragma once

#include "chasles/culling/face_separation.h"
#include "chasles/search/nearest_features.h"
#include "chasles/search/piece_context.h"

#include <algorithm>
#include <array>
#include <functional>
#include <optional>
#include <span>
#include <utility>
#include <vector>

namespace chasles::search {

/// A number at both ends of a part; between them it is linear in tau.
struct LinearBound {
    double start = 0;
    double end = 0;

    [[nodiscard]] double at(double share) const { return start + share * (end - start); }
    [[nodiscard]] double least() const { return std::min(start, end); }
    [[nodiscard]] double greatest() const { return std::max(start, end); }
};

/// Of the distance of two surfaces over a part.
struct DistanceBounds {
    LinearBound lower; ///< may be below 0
    LinearBound upper;
};

/// Two surfaces at one tau.
struct NearKnot {
    double tau = 0;
    double distance = 0;                          ///< of the points
    std::optional<contact::FeaturePair> features; ///< none where surfaces that pass through each other meet
    contact::NearestPoints points;                ///< in the frame of the fixed body; twice one where the surfaces meet
    motion::MatrixPose pose;                      ///< of the moving body in the frame of the fixed one
};

/// Bounds the distance of two surfaces over parts of one piece. The context is kept by reference. For one thread.
class ChordBounds {
public:
    explicit ChordBounds(const PieceContext& context)
        : context_(context), separation_(context.moving(), context.fixed()) {}

    /// How much nearer than the features that are found at a distance other ones may be.
    using Error = std::function<double(double distance)>;
    /// The nearest features at a tau, up to this error. `guesses` may be near each other there.
    NearKnot nearest_at(double tau, std::span<const contact::FeaturePair> guesses, const Error& error);
    /// The surfaces pass through each other there, in this point of the fixed body's frame.
    [[nodiscard]] NearKnot crossing_at(double tau, const Eigen::Vector3d& point) const;
    /// Where an edge and a face pass through each other at a tau. Faces have the ids of the library's bodies.
    [[nodiscard]] NearKnot crossing_at(double tau, const Overlap& overlap) const;
    /// Whether they are proven to do so all along between two knots.
    [[nodiscard]] bool crosses_between(const NearKnot& start, const NearKnot& end, const Overlap& overlap) const;

    /// The bounds between two knots. With `widths`, empty if they are farther apart than that at either end; without,
    /// as near as the knots allow.
    std::optional<DistanceBounds> between(const NearKnot& start, const NearKnot& end,
                                          const std::optional<LinearBound>& widths);
    /// The upper bound alone, for surfaces that meet.
    [[nodiscard]] LinearBound upper_between(const NearKnot& start, const NearKnot& end);

    /// Whether the surfaces are proven to be farther apart than a distance between two knots.
    bool are_beyond(const NearKnot& start, const NearKnot& end, double distance);
    /// Likewise the bodies from one tau to another, by balls.
    [[nodiscard]] bool are_balls_beyond(double from, double to, double distance) const;

    [[nodiscard]] const Work& work() const { return work_; }

private:
    using Direction = algebra::Vector3<double>;
    /// A unit direction, seen by both bodies.
    struct Sight {
        Direction along;                    ///< in the frame of the fixed body
        std::array<Direction, 2> of_moving; ///< in the frame of the moving body, at both ends
        std::array<double, 2> between{};    ///< of the centres of the hierarchies, at both ends
    };

    /// The boxes of the part between two knots, and how far bounds on chords may be from the true ones.
    struct Part {
        culling::TimeInterval interval;
        double slack;
    };
    [[nodiscard]] Part part_between(const NearKnot& start, const NearKnot& end) const;
    /// For points of both bodies that are no farther apart than that.
    [[nodiscard]] Part part_between(double from, double to, double farthest) const;
    bool are_beyond_at(const NearKnot& knot, double distance);
    [[nodiscard]] LinearBound upper(const NearKnot& start, const NearKnot& end);
    [[nodiscard]] double way_of_points(const NearKnot& from, const NearKnot& to);
    [[nodiscard]] double more_of_sliding(const NearKnot& start, const NearKnot& end) const;
    std::optional<LinearBound> lower(const culling::SweptBoxes& boxes, const LinearBound& most,
                                     const std::optional<LinearBound>& wanted);
    LinearBound widest_gaps(std::uint32_t moving_face, std::uint32_t fixed_face, const LinearBound& wanted);
    [[nodiscard]] LinearBound gaps(const Direction& along, std::uint32_t moving_face, std::uint32_t fixed_face) const;
    void use_directions(const NearKnot& start, const NearKnot& end);
    [[nodiscard]] Sight sight_along(const Direction& along) const;
    [[nodiscard]] bool are_beyond(const LinearBound& distance, const BvhNode& moving, const BvhNode& fixed) const;
    /// Likewise the faces below two nodes.
    [[nodiscard]] bool are_faces_beyond(const LinearBound& distance, std::uint32_t moving, std::uint32_t fixed);
    [[nodiscard]] Direction between_middles(const BvhNode& moving, const BvhNode& fixed) const;

    const PieceContext& context_;
    culling::FaceSeparation separation_;
    culling::IntervalEnds ends_;
    std::vector<Sight> sights_;                                  ///< between the nearest points of both knots
    std::vector<std::pair<std::uint32_t, std::uint32_t>> stack_; ///< pairs of nodes
    std::vector<std::uint32_t> nodes_;                           ///< of one hierarchy
    NearestAtRest nearest_;
    contact::LastFaceAtRest moving_face_;
    contact::LastFaceAtRest fixed_face_;
    Work work_;
};

} // namespace chasles::search
