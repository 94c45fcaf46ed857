// Goes through the pairs of nodes of two bodies at one configuration, in the frame of the fixed body.
// Source: docs/derivations/40-ranges.md, "Clear".
#pragma once

#include "chasles/base/limit_of_thread.h"
#include "chasles/contact/relative_configuration.h"
#include "chasles/robot/small_motions.h"

#include <optional>
#include <utility>
#include <vector>

namespace chasles::robot {

class PairWalk {
public:
    /// The sides of a box of the moving body are those of the moving frame.
    struct Box {
        Eigen::Vector3d centre;
        Eigen::Vector3d half;
    };

    /// The pair is kept by reference.
    explicit PairWalk(const PairAtRest& pair)
        : pair_(pair), turn_(pair.relative.linear()), absolute_turn_(turn_.cwiseAbs()) {}

    /// The first two faces for which `is_wanted` holds, among those of boxes for which `is_near` holds. Throws
    /// Cancelled.
    template <class Near, class Wanted>
    std::optional<NearFaces> find(const Near& is_near, const Wanted& is_wanted) {
        const Bvh &moving = pair_.moving.body().bvh(), &fixed = pair_.fixed.body().bvh();
        waiting_.assign(1, {0, 0});
        while (!waiting_.empty()) {
            const auto [first, second] = waiting_.back();
            waiting_.pop_back();
            if (watch_.is_over(1))
                throw Cancelled();
            const BvhNode &a = moving.nodes()[first], &b = fixed.nodes()[second];
            const Box own = box_of(moving, a), other = box_of(fixed, b);
            if (!is_near(Box{moved(own.centre), own.half}, other))
                continue;
            if (!a.is_leaf() || !b.is_leaf()) {
                add_parts({first, second}, a, b, own.half.squaredNorm() > other.half.squaredNorm());
                continue;
            }
            if (const NearFaces faces{std::uint32_t(a.first), std::uint32_t(b.first)}; is_wanted(faces))
                return faces;
        }
        return std::nullopt;
    }

    /// How far two boxes are apart along each axis of the fixed frame.
    [[nodiscard]] Eigen::Vector3d beside(const Box& moving, const Box& fixed) const {
        const Eigen::Vector3d apart = (moving.centre - fixed.centre).cwiseAbs();
        return (apart - absolute_turn_ * moving.half - fixed.half).cwiseMax(Eigen::Vector3d::Zero());
    }
    /// A triangle of the moving body in the frame of the fixed one.
    [[nodiscard]] Triangle placed(const Triangle& own) const { return {moved(own[0]), moved(own[1]), moved(own[2])}; }

private:
    static Box box_of(const Bvh& bvh, const BvhNode& node) {
        Box box;
        for (std::size_t i = 0; i < 3; ++i) {
            const double lower = node.lower[i], upper = node.upper[i];
            box.centre[Eigen::Index(i)] = bvh.centre()[Eigen::Index(i)] + 0.5 * (lower + upper);
            box.half[Eigen::Index(i)] = 0.5 * (upper - lower);
        }
        return box;
    }
    [[nodiscard]] Eigen::Vector3d moved(const Eigen::Vector3d& point) const {
        return contact::product(turn_, point) + pair_.relative.translation();
    }
    /// Of the larger box.
    void add_parts(std::pair<std::uint32_t, std::uint32_t> pair, const BvhNode& a, const BvhNode& b,
                   bool first_is_larger) {
        if (b.is_leaf() || (!a.is_leaf() && first_is_larger)) {
            waiting_.push_back({a.first, pair.second});
            waiting_.push_back({a.first + 1, pair.second});
        } else {
            waiting_.push_back({pair.first, b.first});
            waiting_.push_back({pair.first, b.first + 1});
        }
    }

    const PairAtRest& pair_;
    Eigen::Matrix3d turn_;
    Eigen::Matrix3d absolute_turn_;
    std::vector<std::pair<std::uint32_t, std::uint32_t>> waiting_;
    Watch watch_;
};

} // namespace chasles::robot
