// A hand whose body starts inside of another one, or into which another one is put.
#include "tests/manipulation/drag_scenes.h"

#include <gtest/gtest.h>

namespace chasles::test {
namespace {

TEST(InsideOfHands, ABodyInAnotherOneStaysAndNamesIt) {
    Scene scene;
    scene.add({"block", box({5, 5, 5}).polyhedron(), Motion::at_rest(shifted(0, 0, 0))});
    scene.add({"box", box({0.5, 0.5, 0.5}).polyhedron(), Motion::at_rest(shifted(1, 0, 1))});
    DraggedBody body(scene, "box", {.margin = 1e-4});
    const DragStep step = body.update(shifted(9, 0, 0));
    EXPECT_EQ(step.state, DragState::touching);
    EXPECT_EQ(step.touching, std::vector<std::size_t>{0});
    EXPECT_EQ(step.pose.translation, Eigen::Vector3d(1, 0, 1));
}

/// No surface comes near: only volumes tell.
TEST(InsideOfHands, ABodyThatJumpsAroundTheHandIsNamed) {
    for (const double half : {5.0, 0.1}) {
        Scene scene;
        scene.add({"other", box({half, half, half}).polyhedron(), Motion::at_rest(shifted(50, 0, 0))});
        scene.add({"box", box({0.5, 0.5, 0.5}).polyhedron(), Motion::at_rest(shifted(0, 0, 0))});
        DraggedBody body(scene, "box", {.margin = 1e-4});
        EXPECT_EQ(body.update(shifted(0.5, 0, 0)).state, DragState::reached);
        scene.move(0, Motion::at_rest(shifted(0.5, 0, 0)));
        const DragStep step = body.update(shifted(1, 0, 0));
        EXPECT_EQ(step.state, DragState::touching) << half;
        EXPECT_EQ(step.touching, std::vector<std::size_t>{0});
    }
}

} // namespace
} // namespace chasles::test
