// A user's first program: two bodies, a motion, a query. The answer is known: a unit cube rises by two units and
// touches a slab after half of its motion.
#include "chasles/chasles.h"

#include <cstdio>

namespace {

chasles::Polyhedron box(double size, double height) {
    std::vector<Eigen::Vector3d> corners;
    for (const double z : {0.0, 1.0}) {
        for (const double y : {0.0, size}) {
            for (const double x : {0.0, size}) {
                corners.emplace_back(x - size / 2, y - size / 2, z + height);
            }
        }
    }
    const std::vector<std::vector<std::uint32_t>> faces = {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4},
                                                           {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}};
    return chasles::Polyhedron::from_polygons(corners, faces);
}

bool meets_at_half(const chasles::FirstContact& found) {
    return found.verdict == chasles::Verdict::contact && found.time.lower <= 0.5 && found.time.upper >= 0.5 &&
           found.time.upper - found.time.lower < 1e-9;
}

/// Exceptions keep their type across the boundary of a shared library.
bool refuses_nothing_at_all() {
    try {
        static_cast<void>(chasles::Polyhedron::from_polygons({}, {}));
    } catch (const chasles::InvalidInput& refusal) {
        std::printf("refused: %s\n", refusal.what());
        return true;
    }
    return false;
}

} // namespace

int main() {
    const chasles::Polyhedron cube = box(1, 0);
    const chasles::Polyhedron slab = box(4, 2);
    Eigen::Isometry3d goal = Eigen::Isometry3d::Identity();
    goal.translation().z() = 2;

    const chasles::Motion motion = chasles::ScrewMotion::between(Eigen::Isometry3d::Identity(), goal);
    const chasles::FirstContact found = chasles::first_contact({.moving = cube, .fixed = slab, .motion = motion});
    std::printf("first contact in [%.17g, %.17g]\n", found.time.lower, found.time.upper);

    // The library takes arrays of motions and returns arrays of answers: both sides must agree on their layout.
    const std::vector<chasles::Motion> motions(3, motion);
    const std::vector<chasles::FirstContact> all =
        chasles::first_contact_batch({.moving = cube, .fixed = slab, .motions = motions});
    bool is_expected = all.size() == 3 && meets_at_half(found);
    for (const chasles::FirstContact& one : all) {
        is_expected = is_expected && meets_at_half(one);
    }
    is_expected = is_expected && refuses_nothing_at_all();
    std::puts(is_expected ? "as expected" : "wrong");
    return is_expected ? 0 : 1;
}
