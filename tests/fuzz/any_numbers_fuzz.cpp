// Queries with arbitrary doubles: each query returns finite numbers after bounded work, or is refused.
#include "chasles/base/invalid_input.h"
#include "chasles/query/path.h"
#include "tests/fuzz/sound_answer.h"

#include <array>
#include <limits>
#include <vector>

namespace chasles::fuzz {
namespace {

/// A number with a preference for the ends of the range and for mixed magnitudes.
double number(Bytes& bytes) {
    static constexpr std::array<double, 16> corners{0,
                                                    -0.0,
                                                    1,
                                                    -1,
                                                    0.1,
                                                    1e30,
                                                    -1e30,
                                                    1e-30,
                                                    1e90,
                                                    0x1p-1074,
                                                    0x1p-1022,
                                                    std::numeric_limits<double>::max(),
                                                    std::numeric_limits<double>::infinity(),
                                                    std::numeric_limits<double>::quiet_NaN(),
                                                    1e-160,
                                                    1e16};
    const unsigned kind = bytes.byte();
    switch (kind >> 4 & 3) {
    case 0:
        return corners[kind & 15];
    case 1:
        return bytes.any_double();
    case 2: {
        const int mantissa = std::int8_t(bytes.byte());
        return std::ldexp(mantissa, int(bytes.below(255)) - 127);
    }
    default:
        return double(kind & 15) - 7;
    }
}

Eigen::Vector3d point(Bytes& bytes) {
    Eigen::Vector3d point;
    for (double& coordinate : point)
        coordinate = number(bytes);
    return point;
}

Pose pose(Bytes& bytes) {
    Eigen::Quaterniond rotation;
    for (double& coefficient : rotation.coeffs())
        coefficient = number(bytes);
    return {point(bytes), rotation};
}

Polyhedron body(Bytes& bytes) {
    std::vector<Eigen::Vector3d> vertices;
    for (unsigned count = 3 + bytes.below(4); count > 0; --count)
        vertices.push_back(point(bytes));
    std::vector<std::vector<std::uint32_t>> faces(1 + bytes.below(4));
    for (auto& face : faces)
        for (unsigned corners = 3 + (bytes.below(4) == 0 ? 1 : 0); corners > 0; --corners)
            face.push_back(bytes.below(unsigned(vertices.size())));
    const unsigned options = bytes.byte();
    return Polyhedron::from_polygons(vertices, faces, {.triangulate = (options & 1) != 0});
}

Motion motion(Bytes& bytes, double max_turn) {
    const std::array<Pose, 4> poses{pose(bytes), pose(bytes), pose(bytes), pose(bytes)};
    switch (bytes.below(4)) {
    case 0:
        return ScrewMotion::between(poses[0], poses[1], max_turn);
    case 1:
        return ScrewMotion::relative(poses[0], poses[1], poses[2], poses[3], max_turn);
    case 2:
        return SweepMotion::between(poses[0], poses[1], point(bytes));
    default:
        return SweepMotion::relative(poses[0], poses[1], poses[2], poses[3]);
    }
}

/// Large enough to avoid thousands of pieces, which would only take time.
double max_turn(Bytes& bytes) {
    const double turn = number(bytes);
    return turn >= ScrewMotion::least_max_turn && turn < 0.1 ? 0.1 : turn;
}

void ask(Bytes& bytes) {
    const auto find = Find(bytes.below(3));
    const double tolerance = bytes.below(4) == 0 ? number(bytes) : 1e-12;
    const double turn = bytes.below(4) == 0 ? max_turn(bytes) : 0.5;
    const Polyhedron moving = body(bytes);
    const Polyhedron fixed = body(bytes);
    if (bytes.below(4) == 0) {
        const std::array<Pose, 3> poses{pose(bytes), pose(bytes), pose(bytes)};
        const PathContact found = first_contact_on_path({.moving = moving,
                                                         .fixed = fixed,
                                                         .motions = screws_along(poses, turn),
                                                         .options = {.time_tolerance = tolerance, .find = find}});
        demand_sound(found.contact, find);
        demand(found.segment < poses.size() - 1, "the segment is one of the path");
    } else {
        demand_sound(first_contact({.moving = moving,
                                    .fixed = fixed,
                                    .motion = motion(bytes, turn),
                                    .options = {.time_tolerance = tolerance, .find = find}}),
                     find);
    }
}

} // namespace
} // namespace chasles::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    chasles::fuzz::Bytes bytes(data, size);
    try {
        chasles::fuzz::ask(bytes);
    } catch (const chasles::InvalidInput&) { // refused, which is an answer
    }
    return 0;
}
