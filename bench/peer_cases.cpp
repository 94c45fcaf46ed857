#include "bench/peer_cases.h"

#include "bench/bodies.h"
#include "bench/discrete_overlap.h"
#include "bench/draw.h"
#include "bench/generated_bodies.h"
#include "chasles/query/first_contact.h"
#include "scenes/nut_motions.h"
#include "scenes/spur_gear.h"
#include "scenes/threaded_fastener.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>

namespace chasles::bench {

namespace {

using Eigen::AngleAxisd;
using Eigen::Quaterniond;
using Eigen::Vector3d;
using std::numbers::pi;

constexpr double degree = pi / 180;

/// A bounding sphere of a body.
struct Ball {
    Vector3d centre;
    double radius = 0;
    double length = 0; ///< the longest side of the bounding box
};

Ball ball_around(const Polyhedron& body) {
    Eigen::AlignedBox3d box;
    for (const Vector3d& vertex : body.vertices())
        box.extend(vertex);
    Ball ball{box.center(), 0, box.sizes().maxCoeff()};
    for (const Vector3d& vertex : body.vertices())
        ball.radius = std::max(ball.radius, (vertex - ball.centre).norm());
    return ball;
}

/// Two copies of a body. The fixed copy is in its own frame.
class CopiesOf {
public:
    CopiesOf(const Polyhedron& body, std::uint64_t seed) : body_(body), ball_(ball_around(body)), draw_(seed) {}

    /// A motion by 2 % of the body with a turn of up to 0.02 rad, roughly towards the other body, from a gap of up to 3
    /// %. About half of these motions end in contact.
    Displacement short_and_near() {
        const double step = 0.02 * ball_.length;
        const Approach approach = draw_approach();
        const Vector3d start = approach.touching + draw_.between(0.1, 1.5) * step * approach.from;
        const Vector3d way = (draw_.direction() - 1.5 * approach.from).normalized() * step;
        return displacement(approach.orientation, start, way, draw_.turn(0, 0.02));
    }

    /// Half a body length and up to 60 degrees. Without the turn the bodies would touch after three fifths of the
    /// motion.
    Displacement into_contact() {
        const Approach approach = draw_approach();
        const Vector3d way = -0.5 * ball_.length * approach.from;
        return displacement(approach.orientation, approach.touching - 0.6 * way, way, draw_.turn(0, 60 * degree));
    }

    /// A motion past the other body with a turn of up to 60 degrees. In the middle of the motion the bodies overlap or
    /// miss each other by up to 2 % of the body. At both ends they are free.
    Displacement passing_by() {
        for (;;) {
            const Approach approach = draw_approach();
            const Vector3d nearest = approach.touching + draw_.between(-0.02, 0.02) * ball_.length * approach.from;
            const Vector3d way = 0.5 * ball_.length * draw_.direction().cross(approach.from).normalized();
            const Quaterniond turn = draw_.turn(0, 60 * degree);
            const Quaterniond half_back = Quaterniond::Identity().slerp(0.5, turn.conjugate());
            const Displacement motion = displacement(half_back * approach.orientation, nearest - 0.5 * way, way, turn);
            if (!overlaps_at(motion.start) && !overlaps_at(motion.goal))
                return motion;
        }
    }

    /// Half a body length and up to 60 degrees, at a distance at which the bounding spheres stay apart.
    Displacement far_off() {
        const double distance = 2 * ball_.radius + draw_.between(0.7, 2) * ball_.length;
        const Vector3d way = 0.5 * ball_.length * draw_.direction();
        return displacement(draw_.turn(0, pi), distance * draw_.direction(), way, draw_.turn(0, 60 * degree));
    }

private:
    struct Approach {
        Quaterniond orientation;
        Vector3d from;     ///< unit vector
        Vector3d touching; ///< centre of the moving body when the bodies touch
    };

    Approach draw_approach() {
        for (;;) {
            const Quaterniond orientation = draw_.turn(0, pi);
            const Vector3d from = draw_.direction();
            const Displacement straight =
                displacement(orientation, 3 * ball_.radius * from, -3 * ball_.radius * from, Quaterniond::Identity());
            const FirstContact found = first_contact(
                {.moving = body_, .fixed = body_, .motion = ScrewMotion::between(straight.start, straight.goal)});
            if (found.verdict == Verdict::contact)
                return {orientation, from, (1 - found.time.lower) * 3 * ball_.radius * from};
        }
    }

    /// `offset` is the vector from centre to centre. The body turns about its centre.
    [[nodiscard]] Displacement displacement(const Quaterniond& orientation, const Vector3d& offset, const Vector3d& way,
                                            const Quaterniond& turn) const {
        const auto pose = [&](const Quaterniond& rotation, const Vector3d& centre) {
            return Pose(Vector3d(ball_.centre + centre - rotation * ball_.centre), rotation);
        };
        return {pose(orientation, offset), pose(turn * orientation, offset + way)};
    }

    [[nodiscard]] bool overlaps_at(const Pose& pose) const { return is_overlapping(body_, body_, pose.isometry()); }

    const Polyhedron& body_;
    Ball ball_;
    Draw draw_;
};

using Drawing = Displacement (CopiesOf::*)();

PeerCase copies(const std::string& name, const Polyhedron& body, int count, Drawing next) {
    CopiesOf pair(body, 20000 + std::uint64_t(count));
    PeerCase made{name, body, body, {}};
    for (int i = 0; i < count; ++i)
        made.questions.push_back({(pair.*next)(), std::nullopt});
    return made;
}

std::string in_thousands(const Polyhedron& body) {
    const double thousands = double(body.report().triangles) / 1000;
    char text[32];
    std::snprintf(text, sizeof text, thousands < 10 ? "%.1fk" : "%.0fk", thousands);
    return text;
}

void add_meshes(std::vector<PeerCase>& cases) {
    for (const std::size_t sides : {43, 86, 172, 344}) {
        const Polyhedron torus = bumpy_torus(sides, sides);
        cases.push_back(
            copies("near: torus " + in_thousands(torus), torus, sides > 300 ? 32 : 64, &CopiesOf::short_and_near));
    }
    Polyhedron body = bumpy_torus(54, 54);
    std::string name = "torus";
    if (const auto file = data_file("meshes/spot.obj")) {
        body = Polyhedron::load(*file, {.triangulate = true});
        name = "spot";
        const Polyhedron fine = subdivided(body, 2);
        cases.push_back(copies("near: spot " + in_thousands(fine), fine, 64, &CopiesOf::short_and_near));
    } else {
        std::printf("skipped: meshes/spot.obj is missing; a bumpy torus of as many triangles is used instead\n");
    }
    cases.push_back(copies("large: " + name + " " + in_thousands(body), body, 100, &CopiesOf::into_contact));
    cases.push_back(copies("passing: " + name + " " + in_thousands(body), body, 100, &CopiesOf::passing_by));
    const NamedBody large = large_body();
    cases.push_back(
        copies("large: " + large.name + " " + in_thousands(large.body), large.body, 64, &CopiesOf::into_contact));
    PeerCase far = copies("far: " + large.name + " " + in_thousands(large.body), large.body, 100, &CopiesOf::far_off);
    for (PeerQuestion& question : far.questions)
        question.known = PeerAnswer{.touches = false, .time = {}};
    cases.push_back(std::move(far));
}

/// The screw about an axis through the body's origin with the pose `middle` at `time`.
Displacement screw_through(const Pose& middle, double time, const Vector3d& slide, double angle) {
    const Vector3d axis = slide.normalized();
    const auto pose_at = [&](double at) {
        return Pose(Vector3d(middle.translation + (at - time) * slide),
                    Quaterniond(AngleAxisd((at - time) * angle, axis)) * Quaterniond(middle.rotation));
    };
    return {pose_at(0), pose_at(1)};
}

/// The lowest corner of a turned body along `up`.
Vector3d lowest_along(const Vector3d& up, const Polyhedron& body, const Quaterniond& orientation) {
    const auto is_lower = [&](const Vector3d& a, const Vector3d& b) {
        return up.dot(orientation * a) < up.dot(orientation * b);
    };
    return orientation * *std::min_element(body.vertices().begin(), body.vertices().end(), is_lower);
}

/// A corner of the moving body moves onto the middle of a face of the fixed body, along the face's normal and turning
/// about this normal. The plane of the face separates the bodies until the contact. In other motions the bodies stay
/// apart by 1e-5 to 0.1.
///
/// Turns are between 30 and 40 degrees. Chasles cuts them into four pieces. Contacts are at quarters of the time, where
/// the motion of Chasles agrees with the uniform screw of the other libraries.
PeerCase convex_case() {
    const Polyhedron moving = ellipsoid({0.5, 0.8, 0.6}, 2);
    const Polyhedron fixed = ellipsoid({1, 0.7, 0.9}, 2);
    PeerCase made{"convex: ellipsoids 0.3k", moving, fixed, {}, true};
    Draw draw(3);
    for (int i = 0; i < 100; ++i) {
        const auto face = fixed.face(std::size_t(draw.between(0, double(fixed.face_count()))));
        const Vector3d a = fixed.vertices()[face[0]];
        const Vector3d b = fixed.vertices()[face[1]];
        const Vector3d c = fixed.vertices()[face[2]];
        const Vector3d normal = (b - a).cross(c - a).normalized();
        const Quaterniond orientation = draw.turn(0, pi);
        const Vector3d lowest = lowest_along(normal, moving, orientation);
        const bool touches = i % 3 != 0;
        const double gap = touches ? 0 : std::pow(10, draw.between(-5, -1));
        const double time = touches ? 0.25 * (1 + i % 3) : 1;
        const Pose nearest(Vector3d((a + b + c) / 3 + gap * normal - lowest), orientation);
        made.questions.push_back(
            {screw_through(nearest, time, -draw.between(0.2, 1) * normal, draw.between(30, 40) * degree),
             touches ? PeerAnswer{true, time} : PeerAnswer{}});
    }
    return made;
}

/// A round peg turns and moves down into a hole that is 1 % wider. The motion is clear, because the peg's corners stay
/// inside the hole's flats. If `is_off`, the peg is off the axis by more than the clearance, and its flat end touches
/// the plate.
PeerCase peg_case(bool is_off) {
    const std::size_t sides = 48;
    const Prism size{sides, 1, 2};
    const double hole = 1.01;
    PeerCase made{is_off ? "conforming: peg on rim" : "conforming: peg in hole",
                  peg(size),
                  plate_with_hole({sides, 2, 1}, hole),
                  {}};
    Draw draw(4);
    for (int i = 0; i < 100; ++i) {
        const double off = is_off ? draw.between(0.03, 0.3) : 0;
        const double towards = draw.between(0, 2 * pi);
        const Vector3d at_the_rim(off * std::cos(towards), off * std::sin(towards), is_off ? 1 : 0.1);
        const double time = is_off ? 0.25 * (1 + i % 3) : 1;
        const Pose pose(at_the_rim, Quaterniond::Identity());
        made.questions.push_back(
            {screw_through(pose, time, {0, 0, -draw.between(0.5, 1.5)}, draw.between(30, 40) * degree),
             is_off ? PeerAnswer{true, time} : PeerAnswer{}});
    }
    return made;
}

/// A box moves along an oblique line and lands flat on a table: thousands of pairs of triangles touch at the same time.
PeerCase table_case() {
    const Prism size{4, 1, 1};
    const Prism table{4, 3, 0.5};
    const Polyhedron box = subdivided(peg(size), 4);
    PeerCase made{"conforming: box on table " + in_thousands(box), box, subdivided(peg(table), 4), {}};
    Draw draw(8);
    for (int i = 0; i < 100; ++i) {
        const Vector3d place(draw.between(-1, 1), draw.between(-1, 1), table.height);
        const Quaterniond orientation(AngleAxisd(draw.between(0, 2 * pi), Vector3d::UnitZ()));
        const Vector3d way(draw.between(-0.5, 0.5), draw.between(-0.5, 0.5), -draw.between(0.2, 1.5));
        const double time = draw.between(0.2, 0.9);
        made.questions.push_back({screw_through(Pose(place, orientation), time, way, 0), PeerAnswer{true, time}});
    }
    return made;
}

/// The M16 pair from 0.97 pitch above its assembled pose on: steps of five degrees up the thread, which is clear for
/// two turns, or pulls straight along the bolt by four pitches.
void add_m16(std::vector<PeerCase>& cases, bool is_pulled) {
    const auto pair = m16_nut_and_bolt();
    if (!pair)
        return;
    PeerCase made{is_pulled ? "conforming: M16 nut pulled" : "conforming: M16 nut", pair->nut, pair->bolt, {}};
    Draw draw(5);
    const scenes::NutTurn thread{.height = 0.97 * 0.002, .slide_per_turn = 0.002};
    for (int i = 0; i < 12; ++i) {
        const double turns = i == 0 ? 0 : draw.between(0, 1.9); // the first one is the motion of first_contact_bench
        Displacement motion{nut_pose(thread, turns), nut_pose(thread, turns + (is_pulled ? 0 : 5.0 / 360))};
        if (is_pulled)
            motion.goal.translation.z() += 4 * 0.002;
        made.questions.push_back({motion, PeerAnswer{.touches = is_pulled, .time = {}}});
    }
    cases.push_back(std::move(made));
}

/// The nut of scenes/, whose axial clearance is known by construction (docs/derivations/09-threaded-fastener.md). Five
/// degrees up the thread are clear. If `is_pulled`, a pull by more than the clearance is added, and the flanks touch.
PeerCase own_nut_case(bool is_pulled) {
    const scenes::ThreadedFastener fastener;
    PeerCase made{is_pulled ? "conforming: own nut pulled" : "conforming: own nut", nut(fastener), bolt(fastener), {}};
    Draw draw(6);
    const scenes::NutTurn thread{.height = 12, .slide_per_turn = fastener.pitch};
    for (int i = 0; i < 24; ++i) {
        const double turns = draw.between(0, 2);
        Displacement motion{nut_pose(thread, turns), nut_pose(thread, turns + 5.0 / 360)};
        if (is_pulled)
            motion.goal.translation.z() += draw.between(1.5, 3) * axial_clearance(fastener);
        made.questions.push_back({motion, PeerAnswer{.touches = is_pulled, .time = {}}});
    }
    return made;
}

/// Two copies of a gear in mesh, with vertical axes.
struct GearPair {
    Polyhedron gear;
    Vector3d centre;
    double distance; ///< distance between the axes
    double tooth;    ///< angle of a tooth and its gap
    double play;     ///< total backlash, as an angle
    double offset;   ///< offset of the moving gear along its axis; 0: end faces are in the same planes
};

/// The pose of the moving gear in the frame of the fixed gear after both have turned by `turn` in opposite directions,
/// and the moving gear by `more` in addition.
Pose meshing(const GearPair& pair, double turn, double more) {
    const Quaterniond back(AngleAxisd(-turn, Vector3d::UnitZ()));
    const Quaterniond orientation(AngleAxisd(0.5 * pair.tooth - 2 * turn + more, Vector3d::UnitZ()));
    const Vector3d centre = pair.centre + back * Vector3d(pair.distance, 0, pair.offset);
    return {Vector3d(centre - orientation * pair.centre), orientation};
}

/// Both gears turn by five degrees at a random position within their backlash. The motion is clear, because involutes
/// roll on each other. The screw differs from the rolling motion by a thousandth of the distance, which is small
/// relative to the backlash. If `is_held`, the fixed gear does not turn, and five degrees exceed the backlash.
PeerCase gear_case(const std::string& name, const GearPair& pair, bool is_held) {
    PeerCase made{name, pair.gear, pair.gear, {}};
    Draw draw(9);
    for (int i = 0; i < 24; ++i) {
        const double turn = draw.between(0, 2 * pi);
        const double more = draw.between(-0.2, 0.2) * pair.play;
        const Pose goal = is_held ? meshing(pair, turn, more + (i % 2 == 0 ? 5 : -5) * degree)
                                  : meshing(pair, turn + 5 * degree, more);
        made.questions.push_back({{meshing(pair, turn, more), goal}, PeerAnswer{.touches = is_held, .time = {}}});
    }
    return made;
}

void add_gears(std::vector<PeerCase>& cases, const std::string& name, GearPair pair) {
    cases.push_back(gear_case("conforming: " + name + " flush", pair, false));
    pair.offset = 1e-3 * pair.distance;
    cases.push_back(gear_case("conforming: " + name, pair, false));
    cases.push_back(gear_case("conforming: " + name + ", one held", pair, true));
}

void add_gears(std::vector<PeerCase>& cases) {
    const scenes::SpurGear size;
    add_gears(cases, "own gears",
              {scenes::spur_gear(size), Vector3d::Zero(), 2 * size.pitch_radius(), 2 * pi / double(size.teeth),
               size.play / size.pitch_radius(), 0});
    if (const auto small = small_gear()) {
        // The axes are half a millimetre farther apart than necessary, as are the shafts of their base.
        const double space = 5e-4;
        const double play = 2 * space * std::tan(20 * degree) / 0.01;
        add_gears(cases, "small gears", {*small, {0.0505, 0, 0}, 0.02 + space, 18 * degree, play, 0});
    }
}

/// FCL's own pair: a robot of open sheets in a room of loose triangles. The robot moves a quarter of the room's length,
/// turns by up to 60 degrees, and is free at the start.
void add_soup(std::vector<PeerCase>& cases) {
    const auto robot = data_file("fcl-pianomover/rob.obj");
    const auto room = data_file("fcl-pianomover/env.obj");
    if (!robot || !room) {
        std::printf("skipped: fcl-pianomover is missing\n");
        return;
    }
    PeerCase made{"soup: pianomover 2.2k", Polyhedron::load(*robot), Polyhedron::load(*room), {}};
    Draw draw(7);
    while (made.questions.size() < 100) {
        const Vector3d from(draw.between(-2500, 2500), draw.between(-2500, 2500), draw.between(400, 2600));
        const Quaterniond orientation = draw.turn(0, pi);
        const Displacement motion{Pose(from, orientation), Pose(Vector3d(from + 1500 * draw.direction()),
                                                                draw.turn(0, 60 * degree) * orientation)};
        if (!is_overlapping(made.moving, made.fixed, motion.start.isometry()))
            made.questions.push_back({motion, std::nullopt});
    }
    cases.push_back(std::move(made));
}

} // namespace

std::vector<PeerCase> peer_cases() {
    std::vector<PeerCase> cases;
    add_meshes(cases);
    add_soup(cases);
    cases.push_back(convex_case());
    for (const bool is_off : {false, true})
        cases.push_back(peg_case(is_off));
    cases.push_back(table_case());
    for (const bool is_pulled : {false, true})
        cases.push_back(own_nut_case(is_pulled));
    add_gears(cases);
    for (const bool is_pulled : {false, true})
        add_m16(cases, is_pulled);
    return cases;
}

} // namespace chasles::bench
