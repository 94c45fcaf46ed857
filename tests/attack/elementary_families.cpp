#include "tests/attack/elementary_families.h"

#include "tests/attack/any_motion.h"

#include <Eigen/Geometry>

namespace chasles::attack {

namespace {

using Points = std::vector<Eigen::Vector3d>;

/// Four lattice points: a vertex and a triangle, or an edge and an edge.
struct LatticeFour {
    Points first;
    Points second;
};

Eigen::Vector3d lattice_point(AttackRandom& random) {
    return 6 * random.grid(3).cast<double>();
}

Eigen::Vector3d lattice_direction(AttackRandom& random) {
    return random.grid_direction(4).cast<double>();
}

Points lattice_triangle(AttackRandom& random) {
    for (;;) {
        const Points t{lattice_point(random), lattice_point(random), lattice_point(random)};
        if (!(t[1] - t[0]).cross(t[2] - t[0]).isZero(0))
            return t;
    }
}

Question asked(const LatticeMotion& motion, const LatticeFour& four, bool swapped) {
    Question question;
    const Points& moving = swapped ? four.second : four.first;
    const Points& fixed = swapped ? four.first : four.second;
    question.kind = four.first.size() == 2 ? QuestionKind::edge_edge
                    : swapped              ? QuestionKind::face_vertex
                                           : QuestionKind::vertex_face;
    for (const Eigen::Vector3d& z : moving)
        question.moving.push_back(motion.moving_point(z));
    for (const Eigen::Vector3d& z : fixed)
        question.fixed.push_back(motion.fixed_point(z));
    return question;
}

/// Questions on the lattice of one motion.
template <class Make>
QuestionGroup on_lattice(AttackRandom& random, const MotionWish& wish, Make make) {
    const LatticeMotion motion = lattice_motion(random, wish);
    QuestionGroup group{motion.posed, {}};
    while (group.questions.size() < questions_of_group)
        group.questions.push_back(asked(motion, make(random), random.chance(0.5)));
    return group;
}

LatticeFour vertex_in_face(AttackRandom& random) {
    const Points t = lattice_triangle(random);
    return {{(t[0] + t[1] + t[2]) / 3}, t};
}

LatticeFour vertex_on_rim(AttackRandom& random) {
    const Points t = lattice_triangle(random);
    return {{random.chance(0.5) ? t[0] : Eigen::Vector3d((t[0] + t[1]) / 2)}, t};
}

/// A vertex anywhere in the triangle's plane, also outside the triangle.
LatticeFour vertex_in_plane(AttackRandom& random) {
    const Points t = lattice_triangle(random);
    const double a = random.integer(-3, 4) / 3.0;
    const double b = random.integer(-3, 4) / 3.0;
    return {{t[0] + (a * (t[1] - t[0])).array().round().matrix() + (b * (t[2] - t[0])).array().round().matrix()}, t};
}

LatticeFour crossing_edges(AttackRandom& random) {
    const Eigen::Vector3d place = lattice_point(random);
    const Eigen::Vector3d u = lattice_direction(random);
    const Eigen::Vector3d v = lattice_direction(random);
    const auto through = [&](const Eigen::Vector3d& d) -> Points {
        return {place - random.integer(0, 3) * d, place + random.integer(1, 3) * d};
    };
    return {through(u), through(v)};
}

/// Parallel edges: overlapping, on one line, or next to each other.
LatticeFour parallel_edges(AttackRandom& random) {
    const Eigen::Vector3d place = lattice_point(random);
    const Eigen::Vector3d d = lattice_direction(random);
    const Eigen::Vector3d aside =
        random.chance(0.2) ? Eigen::Vector3d(random.grid(1).cast<double>()) : Eigen::Vector3d::Zero();
    const int from = random.integer(-4, 4);
    const int to = from + random.integer(1, 4) * (random.chance(0.5) ? 1 : -1);
    return {{place + aside + from * d, place + aside + to * d}, {place, place + random.integer(1, 4) * d}};
}

LatticeFour any_lattice_four(AttackRandom& random) {
    switch (random.integer(0, 5)) {
    case 0:
        return vertex_in_face(random);
    case 1:
        return vertex_on_rim(random);
    case 2:
        return vertex_in_plane(random);
    case 3:
        return parallel_edges(random);
    default:
        return crossing_edges(random);
    }
}

// --- The families
// -----------------------------------------------------------------------------------------------------

bool is_one_piece(const PosedMotion& posed) {
    const auto screw = posed.screw();
    return !screw || screw->piece_count() == 1;
}

/// Points with all digits.
QuestionGroup random_points(AttackRandom& random) {
    QuestionGroup group{any_motion(random, 1), {}};
    while (!is_one_piece(group.posed))
        group.posed = any_motion(random, 1);
    for (std::size_t i = 0; i < questions_of_group; ++i) {
        Question question;
        question.kind = QuestionKind(random.integer(0, 2));
        const int moving = question.kind == QuestionKind::vertex_face ? 1
                           : question.kind == QuestionKind::edge_edge ? 2
                                                                      : 3;
        for (int j = 0; j < 4; ++j)
            (j < moving ? question.moving : question.fixed).push_back(random.vector(1.5));
        group.questions.push_back(question);
    }
    return group;
}

QuestionGroup faces(AttackRandom& random) {
    return on_lattice(random, {},
                      [](AttackRandom& r) { return r.chance(0.7) ? vertex_in_face(r) : vertex_in_plane(r); });
}

QuestionGroup rims(AttackRandom& random) {
    return on_lattice(random, {}, vertex_on_rim);
}

QuestionGroup edges(AttackRandom& random) {
    return on_lattice(random, {}, crossing_edges);
}

QuestionGroup parallels(AttackRandom& random) {
    return on_lattice(random, {}, parallel_edges);
}

/// Touches at time 0 or 1.
QuestionGroup ends(AttackRandom& random) {
    MotionWish wish;
    wish.tau = random.integer(0, 1);
    return on_lattice(random, wish, any_lattice_four);
}

/// All four points stay in one plane. The motion turns or slides within this plane.
QuestionGroup planar(AttackRandom& random) {
    const int axis = random.integer(0, 2);
    MotionWish wish;
    wish.turns = random.chance(0.5) ? 1 : 0;
    wish.slides = 0;
    wish.axis = Eigen::Vector3i::Unit(axis);
    wish.travel = random.grid_direction(20);
    wish.travel[axis] = 0;
    if (wish.travel.isZero())
        wish.travel[(axis + 1) % 3] = 12;
    return on_lattice(random, wish, [axis](AttackRandom& r) {
        for (;;) {
            LatticeFour four =
                r.chance(0.5) ? LatticeFour{{lattice_point(r)}, lattice_triangle(r)}
                              : LatticeFour{{lattice_point(r), lattice_point(r)}, {lattice_point(r), lattice_point(r)}};
            for (Points* points : {&four.first, &four.second})
                for (Eigen::Vector3d& p : *points)
                    p[axis] = 0;
            const Points& t = four.second;
            if (t.size() == 3 ? !(t[1] - t[0]).cross(t[2] - t[0]).isZero(0)
                              : t[0] != t[1] && four.first[0] != four.first[1])
                return four;
        }
    });
}

/// The path of a moving point is tangent to the fixed feature.
QuestionGroup tangents(AttackRandom& random) {
    MotionWish wish;
    wish.turns = 1;
    const LatticeMotion motion = lattice_motion(random, wish);
    QuestionGroup group{motion.posed, {}};
    while (group.questions.size() < questions_of_group) {
        const Eigen::Vector3d z = lattice_point(random);
        const Eigen::Vector3d place = motion.fixed_point(z);
        const Eigen::Vector3d along = motion.velocity(z);
        const double size = std::max(1.0, std::ceil(along.cwiseAbs().maxCoeff() / 8));
        const Eigen::Vector3d aside = size * lattice_direction(random);
        if (along.cross(aside).isZero(0))
            continue;
        if (random.chance(0.5)) {
            group.questions.push_back({QuestionKind::vertex_face,
                                       {motion.moving_point(z)},
                                       {place - along - aside, place + along - aside, place + aside}});
            continue;
        }
        const Eigen::Vector3d u = lattice_direction(random);
        const Eigen::Vector3d v = along + random.integer(-2, 2) * size * u;
        if (!v.isZero(0))
            group.questions.push_back({QuestionKind::edge_edge,
                                       {motion.moving_point(z - u), motion.moving_point(z + u)},
                                       {place - random.integer(0, 2) * v, place + v}});
    }
    return group;
}

void nudge(Question& question, AttackRandom& random) {
    for (Points* points : {&question.moving, &question.fixed})
        for (Eigen::Vector3d& p : *points)
            for (double& x : p)
                if (random.chance(0.1)) {
                    const double side = random.chance(0.5) ? 1 : -1;
                    x = x == 0 ? std::ldexp(side, -100) : std::nextafter(x, side * 1e300);
                }
}

QuestionGroup any_degenerate(AttackRandom& random) {
    return random.chance(0.3)   ? tangents(random)
           : random.chance(0.3) ? planar(random)
                                : on_lattice(random, {}, any_lattice_four);
}

QuestionGroup nudged(AttackRandom& random) {
    QuestionGroup group = any_degenerate(random);
    for (Question& question : group.questions)
        nudge(question, random);
    return group;
}

QuestionGroup scaled(AttackRandom& random) {
    QuestionGroup group = random.chance(0.3) ? random_points(random) : any_degenerate(random);
    constexpr double factors[] = {0x1p-80, 0x1p-40, 0x1p60, 0x1p72, 1e-9, 1e-22, 1e12, 3.3e20};
    const double factor = random.pick(factors);
    scale_lengths(group.posed, factor);
    for (Question& question : group.questions)
        for (Points* points : {&question.moving, &question.fixed})
            for (Eigen::Vector3d& p : *points)
                p *= factor;
    return group;
}

QuestionGroup tiny_turns(AttackRandom& random) {
    QuestionGroup group = random.chance(0.5) ? random_points(random) : any_degenerate(random);
    make_tiny_turn(group.posed, random);
    return group;
}

QuestionGroup half_turns(AttackRandom& random) {
    QuestionGroup group = random.chance(0.5) ? random_points(random) : any_degenerate(random);
    do
        turn_around(group.posed, random);
    while (!is_one_piece(group.posed));
    return group;
}

constexpr ElementaryFamily families[] = {
    {"random points", 0.2, random_points},
    {"vertex in face", 0.1, faces},
    {"vertex on rim", 0.1, rims},
    {"edges cross", 0.1, edges},
    {"parallel edges", 0.1, parallels},
    {"at time 0 or 1", 0.05, ends},
    {"in one plane", 0.05, planar},
    {"tangent", 0.1, tangents},
    {"nudged", 0.1, nudged},
    {"scaled", 0.04, scaled},
    {"tiny turn", 0.03, tiny_turns},
    {"half turn", 0.03, half_turns},
};

} // namespace

std::span<const ElementaryFamily> elementary_families() {
    return families;
}

} // namespace chasles::attack
