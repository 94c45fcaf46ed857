// The separation test of two features by their shortest connection: pairs that it separates stay farther apart than the
// margin, and it separates most such pairs.
#include "chasles/elementary/distance_tests.h"

#include "tests/support/posed_motions.h"
#include "tests/support/segment_distance.h"

namespace chasles::elementary {
namespace {

using namespace test;
using DoublePoint = Vector3<double>;

/// Two edges, a part of the motion of one edge, and their least distance during this part, by sampling.
class Meeting {
public:
    explicit Meeting(Random& random) {
        const double reach = std::abs(random.scaled(-2, 2));
        const PosedMotion posed = random_posed_motion(random, reach);
        const double width = std::ldexp(1.0, -random.integer(2, 14));
        const double from = width * random.integer(0, int(1 / width) - 1);
        maps_ = motion::restricted(motion::double_maps(posed.made), from, from + width);
        for (DoublePoint* point : {&moving[0], &moving[1], &fixed[0], &fixed[1]})
            *point = random.vector(reach);
        scale = error_scale(maps_, reach + posed.made.reference_extent + motion::rounding_extent(posed.made), reach);
    }

    [[nodiscard]] const motion::ControlMaps<double>& maps() const { return maps_; }
    [[nodiscard]] Vector3<Bernstein<3, double>> path(const DoublePoint& point) const {
        return maps_.rotation * point + maps_.translation;
    }
    [[nodiscard]] double unit() const { return error_unit<double> * scale.length; }

    /// The least and the greatest distance between two ends, between an end and the other edge, or between the edges.
    template <class Distance>
    [[nodiscard]] std::pair<double, double> sampled(Distance distance) const {
        constexpr int samples = 40;
        std::pair<double, double> extremes{1e300, 0};
        for (int i = 0; i <= samples; ++i) {
            const auto at = [&](const DoublePoint& p) {
                return eigen(position_at(path(p), maps_.weight, double(i) / samples));
            };
            const double d =
                distance(Segment3{at(moving[0]), at(moving[1])}, Segment3{eigen(fixed[0]), eigen(fixed[1])});
            extremes = {std::min(extremes.first, d), std::max(extremes.second, d)};
        }
        return extremes;
    }

    std::array<DoublePoint, 2> moving;
    std::array<DoublePoint, 2> fixed;
    ErrorScale scale;

private:
    motion::ControlMaps<double> maps_;
};

/// `are_separated(meeting, distance)`.
template <class AreSeparated, class Distance>
void check(std::uint64_t seed, AreSeparated are_separated, Distance distance) {
    Random random(seed);
    int separated = 0, open = 0;
    for (int trial = 0; trial < 4000; ++trial) {
        const Meeting meeting(random);
        const auto [least, greatest] = meeting.sampled(distance);
        const double rounding = 4 * meeting.unit();
        EXPECT_FALSE(are_separated(meeting, least + rounding)) << "their least distance is " << least;
        if (greatest - least > 0.01 * least || rounding > 0.001 * least)
            continue; // directions change, or nothing can be separated
        (are_separated(meeting, 0.98 * least) ? separated : open) += 1;
    }
    std::cout << separated << " separated, " << open << " left open\n";
    EXPECT_GT(separated, 1000);
    EXPECT_LT(open, separated / 100);
}

TEST(DistanceTests, TheWayTellsVerticesApart) {
    check(
        881,
        [](const Meeting& m, double distance) {
            return detail::are_separated<double>({m.path(m.moving[0]), m.maps().weight}, m.fixed[0],
                                                 {distance, m.scale});
        },
        [](const Segment3& moving, const Segment3& fixed) { return (moving[0] - fixed[0]).norm(); });
}

TEST(DistanceTests, TheWayTellsAVertexAndAnEdgeApart) {
    check(
        882,
        [](const Meeting& m, double distance) {
            return detail::are_separated<double>({m.path(m.moving[0]), m.maps().weight},
                                                 resting_edge(m.fixed[0], m.fixed[1]), {distance, m.scale});
        },
        [](const Segment3& moving, const Segment3& fixed) { return distance_to_segment(moving[0], fixed); });
}

TEST(DistanceTests, TheWayTellsEdgesApart) {
    check(
        883,
        [](const Meeting& m, double distance) {
            return detail::are_separated<double>(
                {m.maps(), edge_path(m.maps(), m.moving[0], m.moving[1]), fixed_edge(m.fixed[0], m.fixed[1])},
                {distance, m.scale});
        },
        distance_of_segments);
}

} // namespace
} // namespace chasles::elementary
