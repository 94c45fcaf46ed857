// Writes motions of half, full and many turns: what the pages are given, and where the bodies are proven to be.
// played_turns.mjs plays them by the program of the page.
#include "view/page_data.h"
#include "view/record_json.h"
#include "view/sampled_poses.h"

#include "tests/query/bodies.h"
#include "tests/support/random_poses.h"

#include <iostream>
#include <numbers>

namespace chasles {
namespace {

constexpr int scenes = 400;
constexpr int frames = 50;
constexpr double half_turn = std::numbers::pi;

/// A pose whose turn is a half turn from `from`, as exactly as doubles can say it.
Pose half_a_turn_from(const Pose& from, test::Random& random) {
    const Eigen::Vector3d axis = random.chance(0.5) ? Eigen::Vector3d(Eigen::Vector3d::Unit(random.integer(0, 2)))
                                                    : test::random_point(random, 1);
    const Eigen::Quaterniond turn(0, axis.x(), axis.y(), axis.z());
    return {test::random_point(random, 3), Eigen::Quaterniond(from.rotation) * turn};
}

Motion turning_motion(int kind, test::Random& random) {
    const Pose start = test::random_pose(random, 3);
    const Pose goal = half_a_turn_from(start, random);
    const Eigen::Vector3d origin = Eigen::Vector3d::Zero();
    constexpr std::array turns{1, 2, 4, 16, 32, 64};
    const double angle = half_turn * turns[std::size_t(random.integer(0, 5))];
    switch (kind % 6) {
    case 0:
        return Motion::velocity(start, goal, random.chance(0.5) ? origin : test::random_point(random, 1));
    case 1:
        return Motion::twist(start, goal);
    case 2:
        return Motion::hinge(test::random_point(random, 2), test::random_point(random, 1), {0, angle});
    case 3:
        return Motion::spline({0, 0.25, 1}, {start, goal, half_a_turn_from(goal, random)});
    case 4:
        return TimedPoses::through({0, 0.5, 1}, {start, goal, start});
    default:
        return Motion::slider(test::random_point(random, 1), {0, 2}) *
               Motion::hinge(test::random_point(random, 2), test::random_point(random, 1), {0, 0, angle});
    }
}

view::Json row_json(const Pose& pose) {
    return view::pose_json(pose);
}

view::Json proven_poses(const Motion& motion) {
    view::Json rows = view::Json::array();
    for (int i = 0; i <= frames; ++i)
        rows.push_back(row_json(motion.pose_at(double(i) / frames)));
    return rows;
}

view::Json played_scene(int index, test::Random& random) {
    const Polyhedron box = test::box({0.5, 0.4, 0.3}).polyhedron();
    Scene scene;
    const Motion motion = turning_motion(index, random);
    scene.add({"turning", box, motion});
    scene.add({"at rest", box, Motion::at_rest(test::shifted(50, 0, 0))});
    const view::SceneRecord record =
        view::scene_record(scene, scene.first_contact(), view::RecordSource::first_contact);
    return {{"record", view::Json::parse(view::record_json(record))},
            {"query", view::packed(view::sampled_poses(motion).moving)},
            {"proven", proven_poses(motion)}};
}

} // namespace
} // namespace chasles

int main() {
    chasles::test::Random random(41);
    for (int i = 0; i < chasles::scenes; ++i)
        std::cout << chasles::played_scene(i, random).dump() << '\n';
}
