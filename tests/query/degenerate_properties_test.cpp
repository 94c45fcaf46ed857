// Changes that must not change an answer, on pairs with degenerate touches of all kinds: swapped bodies, shortened
// motions, a turned world, other units, another order, triangles for polygons, threads, repetition.
#include "chasles/algebra/double_double.h"
#include "chasles/query/batch.h"
#include "tests/attack/lattice.h"
#include "tests/attack/mesh_families.h"

#include <algorithm>
#include <gtest/gtest.h>
#include <numeric>

namespace chasles::attack {
namespace {

constexpr std::uint64_t seed = 31;
constexpr int cases_of_family = 40;

struct Bodies {
    Polyhedron moving;
    Polyhedron fixed;

    explicit Bodies(const MeshCase& one)
        : moving(Polyhedron::from_polygons(one.moving.vertices, one.moving.faces)),
          fixed(Polyhedron::from_polygons(one.fixed.vertices, one.fixed.faces)) {}
};

FirstContact answer(const Bodies& bodies, const PosedMotion& posed) {
    return first_contact({.moving = bodies.moving, .fixed = bodies.fixed, .motion = posed.motion()});
}

FirstContact answer(const MeshCase& one) {
    return answer(Bodies(one), one.posed);
}

bool is_valid(const MeshCase& one) {
    try {
        const Bodies bodies(one);
        return true;
    } catch (const std::exception&) {
        return false;
    }
}

/// Runs a comparison on cases of every family. Fails if too few of them touch or too few are clear.
template <class Compare>
void on_degenerate_cases(Compare compare) {
    std::cout << "seed " << seed << std::endl;
    int touches = 0;
    int clear = 0;
    std::uint64_t number = 0;
    for (const MeshFamily& family : mesh_families()) {
        ++number;
        for (int i = 0; i < cases_of_family; ++i) {
            SCOPED_TRACE(std::string(family.name) + ", case " + std::to_string(i));
            AttackRandom random(seed, number, static_cast<std::uint64_t>(i));
            const MeshCase one = family.make(random);
            if (!is_valid(one))
                continue;
            const FirstContact found = answer(one);
            if (compare(one, found, random))
                ++(found.verdict == Verdict::clear ? clear : touches);
        }
    }
    std::cout << touches << " touch, " << clear << " do not" << std::endl;
    EXPECT_GT(touches, 30);
    EXPECT_GT(clear, 15);
}

/// If one answer is an uncertain touch, the other answer may differ.
void expect_same(const FirstContact& found, const FirstContact& other) {
    if (found.certain && other.certain) {
        EXPECT_EQ(found.verdict == Verdict::clear, other.verdict == Verdict::clear);
    }
    if (found.certain && other.certain && found.verdict != Verdict::clear && other.verdict != Verdict::clear) {
        EXPECT_LE(found.tau.lower, other.tau.upper);
        EXPECT_LE(other.tau.lower, found.tau.upper);
    }
}

void expect_same_bits(const FirstContact& found, const FirstContact& other) {
    EXPECT_EQ(found.verdict, other.verdict);
    EXPECT_EQ(found.certain, other.certain);
    EXPECT_EQ(found.tau.lower, other.tau.lower);
    EXPECT_EQ(found.tau.upper, other.tau.upper);
    EXPECT_EQ(found.contacts.size(), other.contacts.size());
}

TEST(DegenerateProperties, SwappingTheBodiesKeepsTheAnswer) {
    on_degenerate_cases([](const MeshCase& one, const FirstContact& found, AttackRandom&) {
        const auto screw = one.posed.screw();
        if (!screw || screw->piece_count() > 1)
            return false; // in the frame of the other body a sweep is not a sweep, and cutting rounds poses
        MeshCase swapped{one.fixed, one.moving, one.posed};
        std::swap(swapped.posed.moving_start, swapped.posed.fixed_start);
        std::swap(swapped.posed.moving_goal, swapped.posed.fixed_goal);
        swapped.posed.is_relative = true;
        expect_same(found, answer(swapped));
        return true;
    });
}

/// A reversed sweep and a reversed translation have the same poses.
TEST(DegenerateProperties, WhatIsClearForwardsIsClearBackwards) {
    on_degenerate_cases([](const MeshCase& one, const FirstContact& found, AttackRandom&) {
        const auto screw = one.posed.screw();
        if (screw && screw->angle() > 0)
            return false;
        MeshCase back = one;
        std::swap(back.posed.moving_start, back.posed.moving_goal);
        std::swap(back.posed.fixed_start, back.posed.fixed_goal);
        const FirstContact other = answer(back);
        if (!found.certain || !other.certain)
            return true;
        EXPECT_EQ(found.verdict == Verdict::clear, other.verdict == Verdict::clear);
        if (found.verdict == Verdict::contact && other.verdict == Verdict::contact) {
            EXPECT_LE(found.tau.lower, 1 - other.tau.lower) << "the first is not after the last";
        }
        return true;
    });
}

/// The first half of a screw about an axis through the origin is a screw between poses that doubles represent exactly.
TEST(DegenerateProperties, AScrewCutShortFindsTheSameContact) {
    std::cout << "seed " << seed << std::endl;
    int before = 0;
    int behind = 0;
    for (std::uint64_t i = 0; i < 600; ++i) {
        SCOPED_TRACE("case " + std::to_string(i));
        AttackRandom random(seed, 50, i);
        const Shape fixed = random_shape(random);
        Shape moving = random_shape(random);
        set_against(moving, fixed, some_direction(fixed, random), random);
        const LatticeMotion motion = lattice_motion(random);
        if (motion.posed.kind != MotionKind::screw || motion.posed.is_relative)
            continue;
        MeshCase whole{moving, fixed, motion.posed};
        for (Eigen::Vector3d& v : whole.moving.vertices)
            v = motion.moving_point(v);
        for (Eigen::Vector3d& v : whole.fixed.vertices)
            v = motion.fixed_point(v);
        MeshCase half = whole;
        const auto& start = whole.posed.moving_start.rotation;
        const auto& goal = whole.posed.moving_goal.rotation; // turn times start, in whole numbers
        const Eigen::Quaterniond turn = Eigen::Quaterniond(goal) * Eigen::Quaterniond(start).conjugate();
        const double sign = turn.w() < 0 ? -1 : 1;
        const Eigen::Quaterniond half_turn(2 * sign * turn.w(), sign * turn.x(), sign * turn.y(), sign * turn.z());
        half.posed.moving_goal = Pose(whole.posed.moving_goal.translation / 2, half_turn * Eigen::Quaterniond(start));
        const FirstContact found = answer(whole);
        const FirstContact cut = answer(half);
        if (!found.certain || !cut.certain)
            continue;
        const bool is_before = found.verdict != Verdict::clear && found.tau.upper < 0.5;
        const bool is_behind = found.verdict == Verdict::clear || found.tau.lower > 0.5;
        before += is_before ? 1 : 0;
        behind += is_behind ? 1 : 0;
        if (is_before) {
            EXPECT_NE(cut.verdict, Verdict::clear);
            EXPECT_LE(cut.tau.lower, 2 * found.tau.upper);
            EXPECT_LE(2 * found.tau.lower, cut.tau.upper);
        }
        if (is_behind) {
            EXPECT_EQ(cut.verdict, Verdict::clear);
        }
    }
    EXPECT_GT(before, 20);
    EXPECT_GT(behind, 10);
}

/// Whether composition with a right angle is exact. The components of the result are sums and differences of two
/// components.
bool turns_exactly(const Eigen::Quaterniond& rotation) {
    using algebra::DoubleDouble;
    const Eigen::Vector4d q = rotation.coeffs();
    for (int i = 0; i < 4; ++i)
        for (int j = 0; j < i; ++j)
            if (DoubleDouble::exact_sum(q[i], q[j]).low() != 0 || DoubleDouble::exact_sum(q[i], -q[j]).low() != 0)
                return false;
    return true;
}

/// Turns of the world by right angles and shifts by whole numbers are exact on the lattice.
TEST(DegenerateProperties, TurningTheWorldKeepsTheAnswer) {
    on_degenerate_cases([](const MeshCase& one, const FirstContact& found, AttackRandom& random) {
        Eigen::Quaterniond right_angle(1, 0, 0, 0);
        right_angle.vec()[random.integer(0, 2)] = random.chance(0.5) ? 1 : -1;
        const Eigen::Matrix3d turn = right_angle.normalized().toRotationMatrix().array().round();
        EXPECT_TRUE((turn * turn.transpose()).isIdentity(0)) << turn;
        const Eigen::Vector3d by = random.grid(9).cast<double>();
        const auto is_whole = [](const Pose& pose) {
            return pose.translation == pose.translation.array().round().matrix();
        };
        MeshCase moved = one;
        moved.posed.is_relative = true;
        for (Pose* pose :
             {&moved.posed.moving_start, &moved.posed.moving_goal, &moved.posed.fixed_start, &moved.posed.fixed_goal}) {
            if (!one.posed.is_relative && (pose == &moved.posed.fixed_start || pose == &moved.posed.fixed_goal))
                *pose = Pose();
            if (!is_whole(*pose) || pose->translation.norm() > 0x1p40 || !turns_exactly(pose->rotation))
                return false;
            *pose = Pose(turn * pose->translation + by, right_angle * Eigen::Quaterniond(pose->rotation));
        }
        const auto screw = one.posed.screw();
        if (screw && screw->piece_count() > 1)
            return false;
        expect_same(found, answer(moved));
        return true;
    });
}

TEST(DegenerateProperties, AnotherUnitByAPowerOfTwoChangesNoBit) {
    on_degenerate_cases([](const MeshCase& one, const FirstContact& found, AttackRandom&) {
        for (const double unit : {0x1p-20, 0x1p30}) {
            MeshCase other = one;
            scale_lengths(other.posed, unit);
            for (Shape* shape : {&other.moving, &other.fixed})
                for (Eigen::Vector3d& v : shape->vertices)
                    v *= unit;
            if (!is_valid(other)) // too small or too large to compute with
                return false;
            expect_same_bits(found, answer(other));
        }
        return true;
    });
}

Shape shuffled(const Shape& shape, AttackRandom& random) {
    std::vector<std::uint32_t> order(shape.vertices.size());
    std::iota(order.begin(), order.end(), 0u);
    for (std::size_t i = order.size(); i > 1; --i)
        std::swap(order[i - 1], order[static_cast<std::size_t>(random.integer(0, int(i) - 1))]);
    Shape result = shape;
    for (std::size_t i = 0; i < order.size(); ++i)
        result.vertices[order[i]] = shape.vertices[i];
    for (auto& face : result.faces) {
        for (std::uint32_t& vertex : face)
            vertex = order[vertex];
        std::rotate(face.begin(), face.begin() + random.integer(0, int(face.size()) - 1), face.end());
        if (random.chance(0.3))
            std::reverse(face.begin(), face.end());
    }
    for (std::size_t i = result.faces.size(); i > 1; --i)
        std::swap(result.faces[i - 1], result.faces[static_cast<std::size_t>(random.integer(0, int(i) - 1))]);
    return result;
}

TEST(DegenerateProperties, OrderAndOrientationDoNotMatter) {
    on_degenerate_cases([](const MeshCase& one, const FirstContact& found, AttackRandom& random) {
        const FirstContact other = answer({shuffled(one.moving, random), shuffled(one.fixed, random), one.posed});
        expect_same(found, other);
        return true;
    });
}

TEST(DegenerateProperties, CuttingPolygonsIntoTrianglesDoesNotMatter) {
    on_degenerate_cases([](const MeshCase& one, const FirstContact& found, AttackRandom& random) {
        MeshCase cut = one;
        for (Shape* shape : {&cut.moving, &cut.fixed}) {
            Faces triangles;
            for (const auto& face : shape->faces)
                for (std::size_t i = 1; i + 1 < face.size(); ++i)
                    triangles.push_back({face[0], face[i], face[i + 1]});
            if (random.chance(0.7))
                shape->faces = triangles;
        }
        if (!is_valid(cut))
            return false;
        expect_same(found, answer(cut));
        return true;
    });
}

TEST(DegenerateProperties, RepetitionAndThreadsChangeNoBit) {
    std::cout << "seed " << seed << std::endl;
    int touches = 0;
    for (std::uint64_t i = 0; i < 12; ++i) {
        AttackRandom random(seed, 60, i);
        const Shape fixed = random_shape(random);
        Shape moving = random_shape(random);
        set_against(moving, fixed, some_direction(fixed, random), random);
        const LatticeMotion first = lattice_motion(random);
        MeshCase one{moving, fixed, first.posed};
        for (Eigen::Vector3d& v : one.moving.vertices)
            v = first.moving_point(v);
        for (Eigen::Vector3d& v : one.fixed.vertices)
            v = first.fixed_point(v);
        const Bodies bodies(one);
        const auto cut_motion = [](PosedMotion posed) {
            posed.max_turn = ScrewMotion::default_max_turn;
            return posed.motion();
        };
        std::vector<Motion> motions{cut_motion(first.posed)};
        while (motions.size() < 40)
            motions.push_back(cut_motion(lattice_motion(random).posed));
        std::vector<FirstContact> alone;
        for (const Motion& motion : motions)
            alone.push_back(first_contact({.moving = bodies.moving, .fixed = bodies.fixed, .motion = motion}));
        for (const unsigned threads : {1u, 2u, 5u}) {
            const auto many = first_contact_batch(
                {.moving = bodies.moving, .fixed = bodies.fixed, .motions = motions, .batch = {.threads = threads}});
            ASSERT_EQ(many.size(), alone.size());
            for (std::size_t j = 0; j < many.size(); ++j)
                expect_same_bits(many[j], alone[j]);
        }
        touches += int(std::count_if(alone.begin(), alone.end(),
                                     [](const FirstContact& c) { return c.verdict != Verdict::clear; }));
    }
    EXPECT_GT(touches, 30);
}

} // namespace
} // namespace chasles::attack
