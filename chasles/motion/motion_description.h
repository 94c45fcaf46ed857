// What a motion is made of, in the numbers that were given: for certificates. Source: docs/certificate.md, "Motion".
#pragma once

#include "chasles/motion/motion_ends.h"

#include <cstdint>
#include <utility>
#include <vector>

namespace chasles::motion {

/// A motion that carries what the next link moves. Between two knots its numbers change evenly.
struct ChainLink {
    enum class Kind : std::uint8_t { pose, slide, turn, velocity, twist };

    Kind kind = Kind::pose;
    bool is_inverse = false;
    Eigen::Vector3d vector = Eigen::Vector3d::Zero(); ///< along a slide, about a turn, or the centre of a velocity
    std::vector<Pose> poses{};                        ///< the pose; of a velocity and of a twist one at each knot
    std::vector<double> values{};                     ///< of a slide and of a turn one at each knot
};

/// The outermost link first.
class ChainLinks {
public:
    /// A link that stands still.
    void add(const Pose& pose, bool is_inverse) { links_.push_back({.is_inverse = is_inverse, .poses = {pose}}); }
    /// With knots at ascending times from 0 to 1. False if those of another link are at other times.
    [[nodiscard]] bool add(ChainLink link, const std::vector<double>& times) {
        if (times_.empty())
            times_ = times;
        links_.push_back(std::move(link));
        return times_ == times;
    }
    /// Other knots of the same links after these; false if the links differ, or the last knot is not their first one.
    [[nodiscard]] bool append(const ChainLinks& next);
    [[nodiscard]] const std::vector<ChainLink>& links() const { return links_; }
    [[nodiscard]] std::vector<double> times() const { return times_.empty() ? std::vector<double>{0, 1} : times_; }

private:
    std::vector<ChainLink> links_;
    std::vector<double> times_; ///< of the knots
};

struct MotionDescription {
    enum class Kind : std::uint8_t {
        other, ///< none of the others
        screw,
        sweep,
        chain
    };

    Kind kind = Kind::other;
    std::vector<MotionEnds> pieces;                   ///< of a screw and of a sweep
    Eigen::Vector3d centre = Eigen::Vector3d::Zero(); ///< of a sweep
    ChainLinks chain;

    /// Another one after this one; false if it is of another kind, or begins elsewhere.
    [[nodiscard]] bool append(const MotionDescription& next);

    /// Of the frame of the moving body as seen from the fixed one.
    template <class Frame>
    static MotionDescription of_frame(const Frame& frame) {
        MotionDescription description;
        if (frame.add_links(description.chain, false))
            description.kind = Kind::chain;
        return description;
    }
};

} // namespace chasles::motion
