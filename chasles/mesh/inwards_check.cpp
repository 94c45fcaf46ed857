#include "chasles/mesh/inwards_check.h"

#include "chasles/base/invalid_input.h"
#include "chasles/base/number_text.h"
#include "chasles/mesh/face_directions.h"
#include "chasles/mesh/way_out.h"

#include <algorithm>
#include <string>

namespace chasles {

namespace {

using Eigen::Vector3d;

/// Faces at a smaller angle to each other lie on each other: 1 less than the cosine of a hundredth of a radian.
constexpr double folded = 0.5e-4;
/// Faces at a smaller angle than some 4e-5 turn over as one.
constexpr double alike = 1e-9;
/// The faces that are narrower than so many times the flat length are too small to tell what is inside.
constexpr double too_narrow = 10;

[[noreturn]] void refuse(const InwardsMove& move, const std::string& what) {
    throw InvalidInput("mesh: radius: " + number_text(-move.distance) + " " + what +
                       ": the body is too thin there, or the face too small; a radius nearer to 0, or a mesh without "
                       "such faces, may do");
}

std::string named(const InwardsMove& move, std::uint32_t face) {
    return "face " + std::to_string(move.body.source_face(face));
}

/// Rounding of a moved vertex, and of its distance from a plane.
double rounding_of(const Vector3d& vertex, const Vector3d& shift) {
    return 0x1p-50 * (vertex.cwiseAbs().maxCoeff() + shift.cwiseAbs().maxCoeff());
}

bool moves_inwards(const InwardsMove& move, std::uint32_t face) {
    return std::ranges::all_of(move.body.face(face), [&](std::uint32_t corner) {
        const Vector3d& vertex = move.body.vertices()[corner];
        const Vector3d shift = move.moved[corner] - vertex;
        const double inwards = -shift.dot(move.directions[face]), rounding = rounding_of(vertex, shift);
        return inwards >= -rounding && inwards <= move.distance + rounding;
    });
}

/// Whether the face, or one of its sides, points the other way. A face without direction points nowhere.
bool is_turned(const InwardsMove& move, std::uint32_t face) {
    const std::span<const std::uint32_t> corners = move.body.face(face);
    if (!(area_vector(move.moved, corners).dot(move.directions[face]) > 0))
        return true;
    const std::span<const Vector3d> given = move.body.vertices();
    for (std::size_t i = 0, last = corners.size() - 1; i < corners.size(); last = i++)
        if (!((move.moved[corners[i]] - move.moved[corners[last]]).dot(given[corners[i]] - given[corners[last]]) > 0))
            return true;
    return false;
}

/// Whether no corner of a face moves along the direction of a face beside it. Corners far above that face do not count:
/// they are on another wall of a corner of a room.
bool stays_behind(const InwardsMove& move, std::uint32_t face, std::uint32_t beside) {
    const Vector3d& origin = move.body.vertices()[move.body.face(beside)[0]];
    const Vector3d& direction = move.directions[beside];
    return std::ranges::all_of(move.body.face(face), [&](std::uint32_t corner) {
        const Vector3d& vertex = move.body.vertices()[corner];
        const Vector3d shift = move.moved[corner] - vertex;
        return direction.dot(vertex - origin) > move.distance || direction.dot(shift) <= rounding_of(vertex, shift);
    });
}

/// Checks a face against the faces beside it. If it turns over, its corners must move inwards of each of them, and a
/// face beside it that turns over, too, must lie in its plane. The corners of a tiny face that overhangs must move so
/// as well: it may be a fault of rounding.
void check_beside(const InwardsMove& move, std::uint32_t face, const std::vector<char>& turned) {
    const bool tiny = width_of(move.body, face) < too_narrow * move.flat;
    for (const std::uint32_t other : faces_beside(move.body, face)) {
        const double cosine = move.directions[face].dot(move.directions[other]);
        if (cosine < folded - 1)
            refuse(move, "finds no room between " + named(move, face) + " and " + named(move, other));
        if (turned[face] && ((turned[other] && cosine < 1 - alike) || !stays_behind(move, face, other)))
            refuse(move, "turns " + named(move, face) + " over");
        if (tiny && cosine < 0 && !stays_behind(move, face, other))
            refuse(move, "moves " + named(move, face) + " outwards");
    }
}

} // namespace

void require_inwards(const InwardsMove& move) {
    std::vector<char> turned;
    for (std::uint32_t face = 0; face < move.body.face_count(); ++face) {
        if (!moves_inwards(move, face))
            refuse(move, "moves " + named(move, face) + " outwards or too far");
        turned.push_back(is_turned(move, face));
    }
    for (std::uint32_t face = 0; face < move.body.face_count(); ++face)
        check_beside(move, face, turned);
    WayOut way_out(move.body, move.flat);
    for (std::uint32_t vertex = 0; vertex < move.moved.size(); ++vertex)
        if (const auto face = way_out.face_on_way(vertex, move.moved[vertex]))
            refuse(move, "moves vertex " + std::to_string(vertex) + " out of the body through " + named(move, *face));
}

} // namespace chasles
