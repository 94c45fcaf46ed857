#include "chasles/search/part_pairs.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace chasles::search {

namespace {

using algebra::Vector3;
using Distances = culling::FaceSeparation::Distances;
using culling::FacePair;
using culling::IntervalEnds;
using culling::point_of;
using culling::TimeRange;

/// A longer list is given up.
constexpr std::size_t most_listed_pairs = 1 << 15;
/// How far a body moves in the first part, as a multiple of the distance. Measured with slides_test.
constexpr double reaches_of_travel = 8;
/// The shortest first part is this power of two.
constexpr int least_exponent = -12;

/// For sums of positions, of which each is off by a bound of coefficients (note 31).
constexpr double part_roundings = 16;

constexpr double infinite = std::numeric_limits<double>::infinity();

/// The first part of a piece: a power of two. It proves nothing, so roundings do not matter. The whole piece where
/// touch is searched for, which needs no list.
TimeRange first_part(const PieceContext& context, const Distances& distances) {
    if (distances.near <= 0)
        return {};
    const IntervalEnds ends(context.maps());
    const Bvh& moving = context.moving().bvh();
    const double travel =
        motion::distance(ends.start, ends.end, motion::vector_in<double>(moving.centre()), moving.radius());
    int exponent = 0;
    std::frexp(reaches_of_travel * distances.far / travel, &exponent);
    return {0, std::ldexp(1.0, travel > 0 ? std::clamp(exponent, least_exponent, 0) : 0)};
}

/// The leaves of a traversal, which measures the distance of each pair.
class PartCollector {
public:
    PartCollector(const PieceContext& context, const culling::PieceParts& parts, const Distances& distances,
                  std::vector<PartPair>& found)
        : moving_(context.moving()), fixed_(context.fixed()), distances_(distances), maps_(parts),
          separation_(context.moving(), context.fixed()), found_(found),
          rounding_(2 * elementary::with_underflow<double>(part_roundings *
                                                           elementary::position_error<double>(parts.scale()))) {}

    // The functions that a traversal requires of its leaves.
    [[nodiscard]] static double best() { return 1; }
    [[nodiscard]] bool is_over() const { return found_.size() > most_listed_pairs; }
    [[nodiscard]] static bool is_kept_apart(const culling::NodePair&, double) { return false; }
    void test(const FacePair& pair) {
        if (maps_.set(pair.interval)) {
            ends_ = IntervalEnds(maps_.maps());
            separation_.use(ends_);
        }
        const bool begins_at_start = pair.interval.lower <= 0 && pair.when.lower <= 0;
        const auto direction = separation_.beyond(pair.moving, pair.fixed, 0.5 * (pair.when.lower + pair.when.upper),
                                                  {distances_.near + pair.deviation, distances_.far + pair.deviation});
        const Gap gap = direction ? gap_along(*direction, pair) : Gap{0, 0};
        if (const double least = std::min(gap.first, gap.last) - pair.deviation; !(least > distances_.far))
            found_.push_back({pair, begins_at_start ? gap.first : infinite, least});
    }

private:
    /// A bound of the distance of two faces at both ends of their window, on chords.
    struct Gap {
        double first;
        double last;
    };
    [[nodiscard]] Gap gap_along(const Vector3<double>& direction, const FacePair& pair) const {
        const Heights start(ends_.start, direction);
        const Heights end(ends_.end, direction);
        Gap gap{infinite, infinite};
        for (const std::uint32_t corner : moving_.face(pair.moving)) {
            const Vector3<double> point = point_of<double>(moving_, corner);
            const double height = start(point);
            const double rise = end(point) - height;
            gap = {std::min(gap.first, height + rise * double(pair.when.lower)),
                   std::min(gap.last, height + rise * double(pair.when.upper))};
        }
        double offset = -infinite;
        for (const std::uint32_t corner : fixed_.face(pair.fixed))
            offset = std::max(offset, dot(direction, point_of<double>(fixed_, corner)));
        return {gap.first - offset - rounding_, gap.last - offset - rounding_};
    }

    /// The heights of the moving body's points along a direction of the fixed body's frame.
    struct Heights {
        Vector3<double> along;
        double height;

        Heights(const motion::MatrixPose& pose, const Vector3<double>& direction)
            : along(pose.rotation.transposed() * direction), height(dot(pose.translation, direction)) {}
        [[nodiscard]] double operator()(const Vector3<double>& point) const { return dot(along, point) + height; }
    };

    const Body& moving_;
    const Body& fixed_;
    Distances distances_;
    culling::PartMaps maps_;
    IntervalEnds ends_;
    culling::FaceSeparation separation_;
    std::vector<PartPair>& found_;
    double rounding_; ///< of heights
};

} // namespace

PartPairs::PartPairs(PieceContext& context, const Distances& distances, const Memory& memory)
    : context_(context), distances_(distances), memory_(memory), is_complete_(!context.is_enclosed()) {
    if (!is_complete_)
        return;
    const auto near = memory.neighbours ? memory.neighbours->within(context, distances.far, work_) : std::nullopt;
    if (near) {
        take(*near);
    } else {
        part_ = first_part(context, distances);
        find();
    }
}

void PartPairs::take(std::span<const NeighbourList::Near> near) {
    const double deviation = context_.deviation(distances_.far, part_);
    for (const auto& [faces, least] : near)
        pairs_.push_back({{faces.moving, faces.fixed, part_, {}, 0, deviation}, least, least});
}

void PartPairs::find() {
    pairs_.clear();
    const double reach = distances_.far;
    const bool is_whole = part_ == TimeRange();
    const auto among = memory_.orbits && is_whole ? memory_.orbits->pairs(context_, reach, work_) : std::nullopt;
    const culling::PieceParts parts = context_.parts(reach);
    const culling::TimeTree times = context_.time_tree(reach, parts);
    PartCollector leaves(context_, parts, distances_, pairs_);
    culling::BvhTraversal traversal(context_.moving().bvh(), context_.fixed().bvh(), times, reach, true, leaves);
    work_.node_pairs += among ? traversal.run_among(*among, part_) : traversal.run(part_);
    if (memory_.orbits && is_whole && !among)
        memory_.orbits->add_cost(context_, work_);
    is_complete_ = !leaves.is_over();
}

bool PartPairs::go_on() {
    if (!is_complete_ || part_.upper >= 1)
        return false;
    part_ = {part_.upper, 2 * part_.upper};
    find();
    return true;
}

} // namespace chasles::search
