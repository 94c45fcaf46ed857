// Recorded and simulated tracks with time stamps, answered in one call each, against dense discrete samples by FCL.
// FCL's test is in double, and sees triangles that pass through each other. CHASLES_LONG=1 takes a thousand samples
// between every two stamps.
#if CHASLES_TESTS_FCL

#include "chasles/motion/timed_poses.h"
#include "chasles/query/least_distance.h"
#include "tests/data/cad_frames.h"
#include "tests/data/fcl_model.h"

#include <algorithm>
#include <cstdlib>
#include <fcl/narrowphase/collision.h>
#include <string>
#include <vector>

namespace chasles::test {
namespace {

/// How many samples to take where the tests of every day take some.
int samples(int daily) {
    return std::getenv("CHASLES_LONG") != nullptr ? 1000 : daily;
}

/// Samples between two stamps of a track.
struct Density {
    std::size_t segments;
    int everywhere;
    int nearby;
};

/// A question about a track, and FCL's opinion at single times.
class SampledTrack {
public:
    SampledTrack(const Polyhedron& moving, const Polyhedron& fixed, Motion motion)
        : moving_(fcl_model_of(moving)), fixed_(fcl_model_of(fixed)), query_{moving, fixed, std::move(motion)} {}

    /// The same bodies on another track.
    void follow(Motion motion) { query_.motion = std::move(motion); }
    FirstContact ask() {
        const Stopwatch watch;
        FirstContact found = first_contact(query_);
        seconds_ = watch.seconds();
        return found;
    }
    [[nodiscard]] double seconds() const { return seconds_; }
    [[nodiscard]] bool overlaps_at(double time) const {
        fcl::CollisionResultd result;
        return fcl::collide<double>(moving_.get(), query_.motion.pose_at(time).isometry(), fixed_.get(),
                                    query_.motion.fixed_pose_at(time).isometry(), fcl::CollisionRequestd(), result) > 0;
    }
    /// The first of the samples between two times at which the surfaces overlap; 2 if none.
    [[nodiscard]] double first_sample(double from, double to, int count) {
        for (int i = 0; i <= count; ++i) {
            ++samples_;
            if (const double time = from + (to - from) * i / count; overlaps_at(time))
                return time;
        }
        return 2;
    }
    /// No sample may deny the answer, and one must see the contact. Samples are taken `everywhere` up to our contact or
    /// the end, and `nearby` from two stamps before to one after our contact, or the least distance.
    Verdict expect_agreement(const std::string& name, Density density) {
        const FirstContact found = ask();
        const bool is_clear = found.verdict == Verdict::clear;
        const double segments = double(density.segments), end = is_clear ? 1 : found.time.upper;
        const LeastDistance least = least_distance({query_.moving, query_.fixed, query_.motion});
        const double place = is_clear ? least.time.lower : end;
        const double before = std::max(0.0, place - 2 / segments), after = std::min(1.0, place + 1 / segments);
        const double sample =
            std::min(first_sample(0, end, int(density.everywhere * segments * end) + 1),
                     first_sample(before, after, int(density.nearby * segments * (after - before)) + 1));
        print_figures(
            "%s: %s %.6f of %zu stamps, least distance %.2g, bracket %.1g, certain %d; %ld samples, the first "
            "overlap at %.6f; %.2f ms",
            name.c_str(), is_clear ? "clear for" : "contact at", end * segments, density.segments, least.distance.lower,
            found.time.upper - found.time.lower, int(found.certain), samples_, is_clear ? -1 : sample * segments,
            1e3 * seconds_);
        EXPECT_GE(sample, is_clear ? 2 : found.time.lower) << name;
        EXPECT_EQ(sample == 2, is_clear) << name << ": no sample sees the contact";
        EXPECT_EQ(found.verdict == Verdict::contact_at_start, overlaps_at(0)) << name;
        return found.verdict;
    }

private:
    std::shared_ptr<const FclModel> moving_, fixed_;
    FirstContactQuery query_;
    double seconds_ = 0;
    long samples_ = 0;
};

/// Both parts as tracks, from one frame to another.
Motion motion_of(const std::vector<Frame>& frames, std::size_t first, std::size_t last) {
    std::vector<double> stamps;
    std::vector<Pose> moving, fixed;
    for (std::size_t i = first; i <= last; ++i) {
        stamps.push_back(frames[i].stamp);
        moving.push_back(frames[i].moving);
        fixed.push_back(frames[i].fixed);
    }
    return relative(TimedPoses::through(stamps, moving), TimedPoses::through(stamps, fixed));
}

/// Asks for the first contact from each of some frames on, to the last frame or to `last`.
void expect_cad_tracks(const std::string& set, const std::string& poses, const std::vector<std::size_t>& starts,
                       std::size_t last = 10'000) {
    const Polyhedron moving = Polyhedron::load(shared_data("fcl-motions/" + set + "/obj1.obj"));
    const Polyhedron fixed = Polyhedron::load(shared_data("fcl-motions/" + set + "/obj2.obj"));
    const std::vector<Frame> frames = read_frames(shared_data("fcl-motions/" + set + "/" + poses));
    const int dense = samples(100);
    last = std::min(last, frames.size() - 1);
    for (const std::size_t start : starts) {
        SampledTrack track(moving, fixed, motion_of(frames, start, last));
        track.expect_agreement(set + " " + poses + ", frames " + std::to_string(start) + " to " + std::to_string(last),
                               {last - start, dense, dense});
    }
}

TEST(Tracks, OfCadPartsAgreeWithSamples) {
    CHASLES_REQUIRE_DATA("fcl-motions");
    expect_cad_tracks("polyhedron-and-block", "poses.csv", {0, 24, 25}); // in contact from the 25th to the end
    expect_cad_tracks("polyhedron-and-block", "poses.csv", {0}, 24);     // clear
    expect_cad_tracks("bevel-gears-coarse", "poses.csv", {0, 1, 2, 33, 38, 46});
    expect_cad_tracks("bevel-gears-coarse", "poses-step.csv", {0});
    expect_cad_tracks("ring-and-plate", "poses-scenario1.csv", {0});
    expect_cad_tracks("ring-and-plate", "poses-scenario2.csv", {0}); // in contact from the start
}

/// From every frame on: we say contact at the start exactly where FCL does.
TEST(Tracks, OfCadPartsStartInContactWhereSamplesDo) {
    CHASLES_REQUIRE_DATA("fcl-motions");
    for (const std::string set : {"polyhedron-and-block", "bevel-gears-coarse"}) {
        const Polyhedron moving = Polyhedron::load(shared_data("fcl-motions/" + set + "/obj1.obj"));
        const Polyhedron fixed = Polyhedron::load(shared_data("fcl-motions/" + set + "/obj2.obj"));
        const std::vector<Frame> frames = read_frames(shared_data("fcl-motions/" + set + "/poses.csv"));
        SampledTrack track(moving, fixed, motion_of(frames, 0, frames.size() - 1));
        std::size_t touching = 0;
        for (std::size_t start = 0; start + 1 < frames.size(); ++start) {
            track.follow(motion_of(frames, start, frames.size() - 1));
            const bool touches = track.ask().verdict == Verdict::contact_at_start;
            touching += touches ? 1 : 0;
            EXPECT_EQ(touches, track.overlaps_at(0)) << set << " from frame " << start;
        }
        print_figures("%s: %zu of %zu frames in contact", set.c_str(), touching, frames.size() - 1);
    }
}

/// The poses of a hand that holds a camera; every stamp is kept.
struct Recorded {
    std::vector<double> stamps;
    std::vector<Pose> poses;
};

Recorded recorded_track() {
    std::ifstream lines(shared_data("trajectories-tum/freiburg1_xyz-groundtruth.txt"));
    Recorded track;
    for (std::string line; std::getline(lines, line);) {
        std::istringstream numbers(line);
        double t = 0, x = 0, y = 0, z = 0, a = 0, b = 0, c = 0, w = 0;
        if (line.starts_with('#') || !(numbers >> t >> x >> y >> z >> a >> b >> c >> w))
            continue;
        track.stamps.push_back(t);
        track.poses.emplace_back(Eigen::Vector3d(x, y, z), Eigen::Quaterniond(w, a, b, c));
    }
    return track;
}

/// FCL's samples are taken on our own poses. Here these are compared with Eigen's slerp and a straight line.
void expect_slerp(const Recorded& track, const TimedPoses& carried) {
    for (std::size_t i = 0; i + 1 < track.poses.size(); i += 7) {
        const double share = 0.1 + 0.2 * double(i % 5);
        const double stamp = (1 - share) * track.stamps[i] + share * track.stamps[i + 1];
        const Eigen::Isometry3d from = track.poses[i].isometry(), to = track.poses[i + 1].isometry();
        Eigen::Isometry3d between(
            Eigen::Quaterniond(from.linear()).slerp(share, Eigen::Quaterniond(to.linear())).normalized());
        between.translation() = (1 - share) * from.translation() + share * to.translation();
        const Pose ours = carried.pose_at(carried.time_of(stamp));
        EXPECT_LT((ours.isometry().matrix() - between.matrix()).norm(), 1e-6) << i; // stamps of 1.3e9 s, to 2.4e-7 s
    }
}

/// Spot, about 0.2 m long.
Polyhedron small_spot() {
    const Polyhedron large = Polyhedron::load(shared_data("meshes/spot.obj"), {.triangulate = true});
    std::vector<Eigen::Vector3d> vertices;
    std::vector<std::vector<std::uint32_t>> faces;
    for (const Eigen::Vector3d& v : large.vertices())
        vertices.emplace_back(0.1 * v);
    for (std::size_t i = 0; i < large.face_count(); ++i)
        faces.emplace_back(large.face(i).begin(), large.face(i).end());
    return Polyhedron::from_polygons(vertices, faces);
}

/// Beside where the track is at one time.
Pose place_beside(const Recorded& track, int i) {
    const Eigen::Vector3d place = track.poses[std::size_t(240 * i + 100)].translation +
                                  (0.08 + 0.02 * i) * Eigen::Vector3d(std::cos(i), std::sin(i), 0.3);
    return Pose(place, Eigen::Quaterniond(Eigen::AngleAxisd(i, Eigen::Vector3d(1, 2, 3).normalized())));
}

/// A small body is carried along the track past a copy, which is put near to where it is at several times.
TEST(Tracks, OfARecordedHandAgreeWithSamples) {
    CHASLES_REQUIRE_DATA("trajectories-tum");
    CHASLES_REQUIRE_DATA("meshes");
    const Polyhedron body = small_spot();
    const Recorded track = recorded_track();
    ASSERT_EQ(track.poses.size(), 3000U);
    const TimedPoses carried = TimedPoses::through(track.stamps, track.poses);
    expect_slerp(track, carried);
    int contacts = 0;
    for (int i = 0; i < 12; ++i) {
        SampledTrack question(body, body, relative(carried, Motion::at_rest(place_beside(track, i))));
        const Verdict verdict = question.expect_agreement("recorded track past place " + std::to_string(i),
                                                          {track.poses.size() - 1, samples(10), samples(100)});
        contacts += verdict == Verdict::contact ? 1 : 0;
    }
    EXPECT_GT(contacts, 2);
    EXPECT_LT(contacts, 10);
}

/// The copies that it does not touch are moved along the shortest gap, to a tenth of a millimetre before and behind the
/// touch.
TEST(Tracks, OfARecordedHandBarelyTouchOrMiss) {
    CHASLES_REQUIRE_DATA("trajectories-tum");
    CHASLES_REQUIRE_DATA("meshes");
    const Polyhedron body = small_spot();
    const Recorded track = recorded_track();
    const TimedPoses carried = TimedPoses::through(track.stamps, track.poses);
    for (const int i : {6, 7, 8, 9}) {
        Pose rest = place_beside(track, i);
        const Motion far = relative(carried, Motion::at_rest(rest));
        const LeastDistance gap = least_distance({body, body, far});
        ASSERT_FALSE(gap.contacts.empty());
        const Eigen::Vector3d place = rest.translation;
        for (const double depth : {-1e-4, 1e-4}) {
            rest.translation = place + (gap.distance.lower + depth) * gap.contacts.front().normal;
            SampledTrack question(body, body, relative(carried, Motion::at_rest(rest)));
            const Verdict verdict = question.expect_agreement("recorded track past place " + std::to_string(i) +
                                                                  (depth < 0 ? ", just short" : ", just touching"),
                                                              {track.poses.size() - 1, samples(10), samples(1000)});
            EXPECT_TRUE(depth < 0 || verdict == Verdict::contact);
        }
    }
}

} // namespace
} // namespace chasles::test

#endif
