#include "tests/attack/trajectory_families.h"

#include "tests/attack/composed_motions.h"
#include "tests/attack/trajectory_motions.h"
#include "tests/support/turn_to.h"

namespace chasles::attack {

namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;

struct NamedMotion {
    const char* name;
    MotionCase (*make)(AttackRandom& random, bool is_simple, double unit);
};
constexpr NamedMotion motions[] = {{"velocity", velocity_case},     {"twist", twist_case},      {"hinge", hinge_case},
                                   {"polynomial", polynomial_case}, {"bspline", b_spline_case}, {"track", track_case},
                                   {"product", product_case},       {"chain", chain_case},      {"both", both_case}};

struct NamedPlacement {
    const char* name;
    double share;
    Placement placement;
};
constexpr NamedPlacement placements[] = {{"near", 0.25, Placement::near_path}, {"met", 0.3, Placement::met},
                                         {"grazed", 0.2, Placement::grazed},   {"start", 0.1, Placement::at_start},
                                         {"end", 0.05, Placement::at_end},     {"lattice", 0.1, Placement::lattice}};

Shape octahedron() {
    Shape shape;
    for (const double side : {-12.0, 12.0})
        for (int i = 0; i < 3; ++i)
            shape.vertices.emplace_back(side * Vector3d::Unit(i));
    for (std::uint32_t i = 0; i < 8; ++i) {
        const std::uint32_t x = i & 1 ? 0 : 3;
        const std::uint32_t y = i & 2 ? 1 : 4;
        const std::uint32_t z = i & 4 ? 2 : 5;
        shape.faces.push_back({x, y, z});
    }
    return shape;
}

/// Faces are triangles, except for those of boxes on the lattice.
Shape any_shape(AttackRandom& random, bool is_simple) {
    Shape shape = random.chance(0.1) ? octahedron() : random_shape(random);
    if (!is_simple && random.chance(0.6))
        return shaken(shape, random);
    for (Vector3d& v : shape.vertices)
        v /= 16; // exact
    if (!is_simple)
        cut_into_triangles(shape);
    return shape;
}

void place(Shape& shape, const Isometry3d& pose) {
    for (Vector3d& v : shape.vertices)
        v = pose * v;
}

void scale(Shape& shape, double factor) {
    for (Vector3d& v : shape.vertices)
        v *= factor;
}

/// The velocity at a time of a point of the moving body, in the body's frame. In double: it only places bodies.
Vector3d velocity_of(const TrueMotion& motion, const Vector3d& point, double time) {
    constexpr double step = 0x1p-20;
    const double from = std::min(time, 1 - step);
    const TruePose pose = motion.at(from);
    const TruePose next = motion.at(from + step);
    const WideVector path = (next.turn - pose.turn) * widened(point) + next.place - pose.place;
    return narrowed(WideVector(pose.turn.transpose() * path)) / step;
}

/// The direction, in the body's frame, across the motion of a point. The fixed body lies in it in order to graze.
Vector3d side_of_graze(const TrajectoryCase& posed, double time, AttackRandom& random) {
    const Vector3d velocity = velocity_of(posed.motion.truth, random.pick(posed.moving.vertices), time);
    const Vector3d side = random.chance(0.5) ? random.vector(1) : some_direction(posed.moving, random).normalized();
    if (velocity.norm() == 0 || random.chance(0.2))
        return side;
    const Vector3d ahead = velocity.normalized();
    return side - side.dot(ahead) * ahead;
}

/// A point of a surface and a direction out of it.
struct Spot {
    Vector3d point;
    Vector3d outward;
};

/// A corner, a point of an edge or a point of a face: `corners` of a face are mixed.
Spot some_spot(const Shape& shape, int corners, AttackRandom& random) {
    const auto face = random.pick(shape.faces);
    const int first = random.integer(0, 2);
    double sum = 0;
    Spot spot{Vector3d::Zero(), Vector3d::Zero()};
    for (int i = 0; i < corners; ++i) {
        const double weight = random.uniform(0.05, 1);
        spot.point += weight * shape.vertices[face[std::size_t((first + i) % 3)]];
        sum += weight;
    }
    spot.point /= sum;
    Vector3d centre = Vector3d::Zero();
    for (const Vector3d& v : shape.vertices)
        centre += v / double(shape.vertices.size());
    const auto& v = shape.vertices;
    const Vector3d normal = (v[face[1]] - v[face[0]]).cross(v[face[2]] - v[face[0]]);
    spot.outward = spot.point - centre;
    if (corners == 3 || spot.outward.norm() == 0)
        spot.outward = normal.dot(spot.outward) < 0 ? Vector3d(-normal) : normal;
    spot.outward.normalize();
    return spot;
}

/// Turns and shifts the fixed body in the moving body's frame, so that one spot of it is at one of the moving body. The
/// moving body runs into it, unless other features are in the way.
void set_in_the_way(TrajectoryCase& posed, double time, AttackRandom& random) {
    const int corners = random.integer(1, 3);
    Spot spot = some_spot(posed.moving, corners, random);
    Vector3d ahead = velocity_of(posed.motion.truth, spot.point, time).normalized();
    for (int i = 0; i < 4; ++i) { // a spot at the front
        const Spot other = some_spot(posed.moving, corners, random);
        const Vector3d velocity = velocity_of(posed.motion.truth, other.point, time).normalized();
        if (other.outward.dot(velocity) > spot.outward.dot(ahead)) {
            spot = other;
            ahead = velocity;
        }
    }
    if (ahead.norm() == 0)
        ahead = spot.outward;
    const Spot there = some_spot(posed.fixed, random.chance(0.1) ? random.integer(1, 3) : 4 - corners, random);
    const Vector3d out = corners == 3 ? spot.outward : ahead + random.vector(0.5);
    const Eigen::Quaterniond spin(Eigen::AngleAxisd(random.uniform(0, 6), out.normalized()));
    const Eigen::Quaterniond turn = spin * test::turn_to(there.outward, -out);
    place(posed.fixed, Eigen::Translation3d(spot.point) * turn * Eigen::Translation3d(-there.point));
}

double time_of_contact(Placement placement, AttackRandom& random) {
    switch (placement) {
    case Placement::at_start:
        return random.chance(0.7) ? 0 : std::pow(10, random.uniform(-16, -3));
    case Placement::at_end:
        return random.chance(0.5) ? 1 : 1 - std::pow(10, random.uniform(-16, -3));
    case Placement::lattice:
        return random.pick(std::array{0.0, 0.5, 0.5, 1.0});
    default:
        return random.chance(0.1) ? random.integer(1, 7) / 8.0 : random.uniform(0, 1);
    }
}

/// Places the fixed body against the moving one at a time.
void build_contact(TrajectoryCase& posed, Placement placement, double unit, AttackRandom& random) {
    const double time = time_of_contact(placement, random);
    if (placement == Placement::lattice) {
        set_against(posed.fixed, posed.moving, some_direction(posed.moving, random), random);
    } else if (placement == Placement::grazed) {
        const Vector3d side = side_of_graze(posed, time, random);
        set_against(posed.fixed, posed.moving, side, random);
        if (random.chance(0.6)) {
            const double offset = std::pow(10, random.uniform(-16, -2)) * (random.chance(0.5) ? 1 : -1);
            shift(posed.fixed, side.normalized() * (offset * unit));
        }
    } else {
        set_in_the_way(posed, time, random);
    }
    place(posed.fixed, narrowed(posed.motion.truth.at(time)));
}

} // namespace

TrajectoryCase TrajectoryFamily::make(AttackRandom& random) const {
    const bool is_simple = placement == Placement::lattice;
    const double unit = is_simple            ? std::ldexp(1.0, random.integer(-3, 3))
                        : random.chance(0.3) ? std::pow(10, random.uniform(-6, 6))
                                             : 1;
    TrajectoryCase posed{any_shape(random, is_simple), any_shape(random, is_simple), motion(random, is_simple, unit)};
    if (has_slivers)
        add_slivers(random.chance(0.5) ? posed.moving : posed.fixed, random);
    scale(posed.moving, unit);
    scale(posed.fixed, unit);
    posed.time = random.uniform(0, 1);
    posed.find =
        random.pick(std::array{Find::first, Find::first, Find::first, Find::any, Find::first_with_all_contacts});
    if (placement == Placement::near_path) {
        const Eigen::Quaterniond turn(Eigen::AngleAxisd(random.uniform(0, 6), random.vector(1).normalized()));
        cut_into_triangles(posed.fixed);
        place(posed.fixed, Eigen::Translation3d(random.vector(1.5) * unit) * turn);
        place(posed.fixed, narrowed(posed.motion.truth.at(random.uniform(0, 1))));
    } else {
        build_contact(posed, placement, unit, random);
        if (!is_simple || random.chance(0.5))
            cut_into_triangles(posed.fixed);
    }
    return posed;
}

/// The families with slivers are last: the number of a family enters its random numbers.
std::vector<TrajectoryFamily> trajectory_families() {
    constexpr double share_of_slivers = 0.4;
    std::vector<TrajectoryFamily> families;
    for (const bool has_slivers : {false, true})
        for (const NamedMotion& motion : motions)
            for (const NamedPlacement& where : placements)
                if (!has_slivers || where.placement != Placement::lattice)
                    families.push_back({std::string(motion.name) + (has_slivers ? " slivers " : " ") + where.name,
                                        where.share * (has_slivers ? share_of_slivers : 1), motion.make,
                                        where.placement, has_slivers});
    return families;
}

} // namespace chasles::attack
