// Directions prove slivers and nearly parallel edges apart: never features that may come within the distance, and
// nearly all that stay beyond it. Distances are those of samples, in 40 digits. Note 34.
#include "chasles/elementary/direction_tests.h"

#include "tests/support/posed_motions.h"
#include "tests/support/surface_distance.h"

#include <boost/multiprecision/eigen.hpp>
#include <boost/multiprecision/gmp.hpp>

namespace chasles::elementary {
namespace {

using namespace test;
using Corner = Vector3<double>;
using Long = boost::multiprecision::number<boost::multiprecision::gmp_float<40>, boost::multiprecision::et_off>;
using LongPoint = Point3<Long>;

LongPoint in_long(const Corner& p) {
    return {p.x, p.y, p.z};
}

/// A part of a random motion, and two features that are set near each other in its middle.
class ThinMeeting {
public:
    explicit ThinMeeting(Random& random) : reach_(std::abs(random.scaled(-2, 2))) {
        const PosedMotion posed = random_posed_motion(random, reach_);
        const double width = std::ldexp(1.0, -random.integer(6, 20));
        const double from = width * random.integer(0, int(1 / width) - 1);
        maps = motion::restricted(motion::double_maps(posed.made), from, from + width);
        vertex = random.vector(reach_);
        gap = reach_ * std::abs(random.scaled(-9.5, -1));
        accuracy.scale =
            error_scale(maps, reach_ + posed.made.reference_extent + motion::rounding_extent(posed.made), 4 * reach_);
        accuracy.scale.deviation = random.chance(0.5) ? 0 : gap * random.uniform(0.05, 0.5);
    }

    [[nodiscard]] Vector3<Bernstein<3, double>> path(const Corner& point) const {
        return maps.rotation * point + maps.translation;
    }
    [[nodiscard]] Corner at(const Corner& point, double tau) const {
        return position_at(path(point), maps.weight, tau);
    }
    /// A sliver whose inside or rim is at the gap from the vertex, half way through the part.
    [[nodiscard]] std::array<Corner, 3> sliver(Random& random) const {
        const Corner along = random.vector(reach_), across = detail::across(along, random.vector(1));
        const double width = std::abs(random.scaled(-11, -2)) * length(along) / length(across);
        const Corner normal = cross(along, across);
        const double b = random.uniform(-0.2, 1), c = random.uniform(-0.2, 1);
        const Corner foot = scale(along, b) + scale(across, c * width);
        const Corner from = at(vertex, 0.5) - scale(normal, gap / length(normal)) - foot;
        const double share = random.chance(0.5) ? 0 : 0.5;
        return {from, from + along, from + scale(along, share) + scale(across, width)};
    }
    [[nodiscard]] double rounding() const { return 4 * error_unit<double> * accuracy.scale.length; }

    motion::ControlMaps<double> maps;
    Corner vertex;
    double gap = 0;
    Accuracy accuracy;

private:
    double reach_;
};

/// The least and the greatest of a distance during the part.
template <class SquareAt>
std::pair<double, double> sampled(SquareAt square_at) {
    constexpr int samples = 10;
    std::pair<double, double> extremes{1e300, 0};
    for (int i = 0; i <= samples; ++i) {
        const auto distance = double(sqrt(square_at(double(i) / samples)));
        extremes = {std::min(extremes.first, distance), std::max(extremes.second, distance)};
    }
    return extremes;
}

struct Outcomes {
    int apart = 0;
    int open = 0;
};

/// `are_apart_beyond(distance)` must be false where the true features may come as near, and should be true otherwise.
template <class AreApart>
void judge(const ThinMeeting& meeting, const std::pair<double, double>& distances, AreApart are_apart_beyond,
           Outcomes& outcomes) {
    const auto [least, greatest] = distances;
    const double deviation = meeting.accuracy.scale.deviation;
    EXPECT_FALSE(are_apart_beyond(least + meeting.rounding() - deviation)) << "their least distance is " << least;
    if (greatest - least > 0.01 * least || meeting.rounding() > 0.001 * least)
        return; // directions change, or nothing can be separated
    (are_apart_beyond(0.95 * (least - deviation)) ? outcomes.apart : outcomes.open) += 1;
}

TEST(DirectionTests, TellAVertexAndASliverApart) {
    Random random(4111);
    Outcomes outcomes;
    for (int trial = 0; trial < 1500; ++trial) {
        const ThinMeeting meeting(random);
        const std::array<Corner, 3> corners = meeting.sliver(random);
        const FaceShape<double> face = face_shape<double>(corners, {});
        if (!(length(face.normal) > 0) || !(length(corners[2] - corners[1]) > 0))
            continue; // rounding has made it a segment
        const Triangle3<Long> triangle{in_long(corners[0]), in_long(corners[1]), in_long(corners[2])};
        const auto path = meeting.path(meeting.vertex);
        const auto distances = sampled([&](double tau) {
            const LongPoint p = in_long(meeting.at(meeting.vertex, tau));
            Long least = squared_distance_to_segment<Long>(p, triangle[0], triangle[1]);
            least = std::min(least, squared_distance_to_segment<Long>(p, triangle[1], triangle[2]));
            least = std::min(least, squared_distance_to_segment<Long>(p, triangle[2], triangle[0]));
            return std::min<Long>(least, squared_distance_to_inside<Long>(p, triangle, least));
        });
        judge(
            meeting, distances,
            [&](double distance) {
                return are_apart<double>({path, meeting.maps.weight}, face, distance, meeting.accuracy);
            },
            outcomes);
    }
    std::cout << outcomes.apart << " apart, " << outcomes.open << " left open\n";
    EXPECT_GT(outcomes.apart, 200);
    EXPECT_LT(outcomes.open, outcomes.apart / 50);
}

TEST(DirectionTests, TellNearlyParallelEdgesApart) {
    Random random(4112);
    Outcomes outcomes;
    for (int trial = 0; trial < 1500; ++trial) {
        const ThinMeeting meeting(random);
        const Corner other = random.vector(1);
        const Corner from = meeting.at(meeting.vertex, 0.5), along = meeting.at(other, 0.5) - from;
        const Corner across = detail::across(along, random.vector(1)), up = cross(along, across);
        const double angle = std::abs(random.scaled(-9, -1)) * length(along) / length(across);
        const Corner start = from + scale(along, random.uniform(-0.3, 0.3)) + scale(up, meeting.gap / length(up));
        const Corner end = start + along + scale(across, angle);
        const auto distances = sampled([&](double tau) {
            const LongPoint a = in_long(meeting.at(meeting.vertex, tau)), b = in_long(meeting.at(other, tau));
            const LongPoint c = in_long(start), d = in_long(end);
            Long least =
                std::min(squared_distance_to_segment<Long>(a, c, d), squared_distance_to_segment<Long>(b, c, d));
            least = std::min(least, squared_distance_to_segment<Long>(c, a, b));
            least = std::min(least, squared_distance_to_segment<Long>(d, a, b));
            return std::min<Long>(least, squared_distance_of_insides<Long>(a, b, c, d, least));
        });
        const EdgePath<double> moving = edge_path(meeting.maps, meeting.vertex, other);
        judge(
            meeting, distances,
            [&](double distance) {
                return are_apart<double>({meeting.maps, moving, fixed_edge(start, end)}, distance, meeting.accuracy);
            },
            outcomes);
    }
    std::cout << outcomes.apart << " apart, " << outcomes.open << " left open\n";
    EXPECT_GT(outcomes.apart, 200);
    EXPECT_LT(outcomes.open, outcomes.apart / 20);
}

TEST(DirectionTests, AcrossIsPerpendicularToBothHoweverSmallTheAngle) {
    Random random(4113);
    for (int trial = 0; trial < 2000; ++trial) {
        const Corner a = random.vector(1),
                     b = scale(a, random.uniform(-2, 2)) + random.vector(std::abs(random.scaled(-12, 0)));
        const Corner direction = detail::across(a, b);
        for (const Corner& side : {a, b}) {
            const Long height = in_long(direction).dot(in_long(side));
            EXPECT_LT(double(abs(height)), 0x1p-47 * length(direction) * length(side)) << trial;
        }
    }
}

/// A sliver in a plane of any direction: its normal is level along it, and so is the vector from a long side.
TEST(DirectionTests, DirectionsAreLevelAlongASliver) {
    Random random(4114);
    for (int trial = 0; trial < 2000; ++trial) {
        const Corner along = random.vector(1), aside = detail::across(along, random.vector(1));
        const double width = std::abs(random.scaled(-11, -2)) / length(aside), share = random.uniform(0.1, 0.9);
        const Corner from = random.vector(1);
        const std::array<Corner, 3> corners{from, from + along, from + scale(along, share) + scale(aside, width)};
        const FaceShape<double> face = face_shape<double>(corners, {});
        const ConvexPart<double> part = convex_part(face, 0);
        const Corner normal = detail::normal_along_longest_side(part);
        for (const Corner& corner : corners) {
            const Long height = in_long(normal).dot(in_long(corner) - in_long(from));
            EXPECT_LT(double(abs(height)), 0x1p-47 * length(normal) * length(along)) << trial;
        }
        const double away = -std::abs(random.scaled(-9, -1)) / length(aside); // from the long side
        const Corner point = from + scale(along, random.uniform(0.2, 0.8)) + scale(aside, away);
        const Corner vector = detail::vector_from_rim(part, point);
        const Long tilt = in_long(vector).dot(in_long(corners[1]) - in_long(from));
        EXPECT_LT(double(abs(tilt)), 0x1p-47 * length(vector) * length(along)) << trial;
    }
}

} // namespace
} // namespace chasles::elementary
