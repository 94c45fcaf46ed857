// Recorded and simulated tracks with time stamps, answered in one call each, against dense discrete samples by FCL.
#if CHASLES_TESTS_FCL

#include "chasles/motion/timed_poses.h"
#include "tests/data/cad_frames.h"

#include <algorithm>
#include <fcl/geometry/bvh/BVH_model.h>
#include <fcl/narrowphase/collision.h>
#include <numeric>

namespace chasles::test {
namespace {

using Model = fcl::BVHModel<fcl::OBBRSSd>;

std::shared_ptr<Model> model_of(const Polyhedron& body) {
    auto model = std::make_shared<Model>();
    model->beginModel();
    std::vector<fcl::Triangle> triangles;
    for (std::size_t i = 0; i < body.face_count(); ++i) {
        const auto face = body.face(i);
        EXPECT_EQ(face.size(), 3U);
        triangles.emplace_back(face[0], face[1], face[2]);
    }
    model->addSubModel({body.vertices().begin(), body.vertices().end()}, triangles);
    model->endModel();
    return model;
}

/// A question about a track, and FCL's opinion at single times.
class SampledTrack {
public:
    SampledTrack(const Polyhedron& moving, const Polyhedron& fixed, Motion motion)
        : moving_(model_of(moving)), fixed_(model_of(fixed)), query_{moving, fixed, std::move(motion)} {}

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
    [[nodiscard]] double first_sample(double from, double to, int samples) const {
        for (int i = 0; i <= samples; ++i)
            if (const double time = from + (to - from) * i / samples; overlaps_at(time))
                return time;
        return 2;
    }
    /// No sample may deny the answer.
    void expect_agreement(const char* name, int samples) {
        const FirstContact found = ask();
        const bool touches = found.verdict != Verdict::clear;
        const double sample = first_sample(0, touches ? std::min(1.0, found.time.upper + 1e-3) : 1, samples);
        print_figures("%s: %s at %.15g, bracket %.1g, certain %d, first of %d samples at %.6g; %.2f ms", name,
                      touches ? "contact" : "clear", found.time.lower, found.time.upper - found.time.lower,
                      int(found.certain), samples, sample, 1e3 * seconds_);
        EXPECT_GE(sample, found.verdict == Verdict::clear ? 2 : found.time.lower) << name;
        EXPECT_EQ(found.verdict == Verdict::contact_at_start, overlaps_at(0)) << name;
    }

private:
    std::shared_ptr<Model> moving_, fixed_;
    FirstContactQuery query_;
    double seconds_ = 0;
};

std::vector<double> even_stamps(std::size_t count) {
    std::vector<double> stamps(count);
    std::iota(stamps.begin(), stamps.end(), 0.0);
    return stamps;
}

/// Both parts as tracks, from one frame to the last.
Motion motion_of(const std::vector<Frame>& frames, std::size_t first) {
    std::vector<Pose> moving, fixed;
    for (std::size_t i = first; i < frames.size(); ++i) {
        moving.push_back(frames[i].moving);
        fixed.push_back(frames[i].fixed);
    }
    return relative(TimedPoses::through(even_stamps(moving.size()), moving),
                    TimedPoses::through(even_stamps(fixed.size()), fixed));
}

void expect_cad_track(const std::string& set, const std::string& poses, std::size_t first, int samples) {
    const Polyhedron moving = Polyhedron::load(shared_data("fcl-motions/" + set + "/obj1.obj"));
    const Polyhedron fixed = Polyhedron::load(shared_data("fcl-motions/" + set + "/obj2.obj"));
    const std::vector<Frame> frames = read_frames(shared_data("fcl-motions/" + set + "/" + poses));
    SampledTrack track(moving, fixed, motion_of(frames, first));
    track.expect_agreement((set + " from frame " + std::to_string(first)).c_str(), samples);
}

TEST(Tracks, OfCadPartsAgreeWithSamples) {
    CHASLES_REQUIRE_DATA("fcl-motions");
    expect_cad_track("polyhedron-and-block", "poses.csv", 0, 25'000);
    expect_cad_track("bevel-gears-coarse", "poses.csv", 0, 2'000);
    expect_cad_track("bevel-gears-coarse", "poses.csv", 2, 6'000);  // free again
    expect_cad_track("bevel-gears-coarse", "poses.csv", 38, 5'000); // likewise
    expect_cad_track("ring-and-plate", "poses-scenario1.csv", 0, 1'000);
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

/// A body of about 0.2 m is carried along the track past a copy, which is put near to where it is at several times.
TEST(Tracks, OfARecordedHandAgreeWithSamples) {
    CHASLES_REQUIRE_DATA("trajectories-tum");
    CHASLES_REQUIRE_DATA("meshes");
    const Polyhedron large = Polyhedron::load(shared_data("meshes/spot.obj"), {.triangulate = true});
    std::vector<Eigen::Vector3d> vertices;
    std::vector<std::vector<std::uint32_t>> faces;
    for (const Eigen::Vector3d& v : large.vertices())
        vertices.emplace_back(0.1 * v);
    for (std::size_t i = 0; i < large.face_count(); ++i)
        faces.emplace_back(large.face(i).begin(), large.face(i).end());
    const Polyhedron body = Polyhedron::from_polygons(vertices, faces);
    const Recorded track = recorded_track();
    ASSERT_EQ(track.poses.size(), 3000U);
    const TimedPoses carried = TimedPoses::through(track.stamps, track.poses);
    for (int i = 0; i < 12; ++i) {
        const Eigen::Vector3d place = track.poses[std::size_t(240 * i + 100)].translation +
                                      (0.08 + 0.02 * i) * Eigen::Vector3d(std::cos(i), std::sin(i), 0.3);
        const Pose rest(place, Eigen::Quaterniond(Eigen::AngleAxisd(i, Eigen::Vector3d(1, 2, 3).normalized())));
        SampledTrack question(body, body, relative(carried, Motion::at_rest(rest)));
        question.expect_agreement(("recorded track " + std::to_string(i)).c_str(), 60'000);
    }
}

} // namespace
} // namespace chasles::test

#endif
