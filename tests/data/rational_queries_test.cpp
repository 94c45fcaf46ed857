// Elementary queries with exact truth (Wang et al. 2021) whose primitives translate rigidly, as mesh pairs. Each
// primitive becomes a sliver triangle. Its third corner trails the motion, so this corner adds barely any contacts.

#include "tests/attack/check_mesh.h"
#include "tests/data/shared_data.h"

#include <Eigen/Geometry>
#include <array>
#include <boost/multiprecision/gmp.hpp>
#include <fstream>
#include <sstream>

namespace chasles::test {
namespace {

using Rational = boost::multiprecision::mpq_rational;
using Integer = boost::multiprecision::mpz_int;
using RationalPoint = std::array<Rational, 3>;

/// Eight points (four at each end of the motion) and the true answer.
struct ElementaryQuery {
    std::array<RationalPoint, 8> points;
    bool is_vertex_face = false;
    bool collides = false;
    std::string name;

    [[nodiscard]] RationalPoint displacement(int point) const {
        RationalPoint d;
        for (int c = 0; c < 3; ++c)
            d[c] = points[point + 4][c] - points[point][c];
        return d;
    }
    /// The first point of the second primitive: the face, or the second edge.
    [[nodiscard]] int second() const { return is_vertex_face ? 1 : 2; }
    [[nodiscard]] bool is_rigid() const {
        for (int i = 0; i < 4; ++i)
            if (displacement(i) != displacement(i < second() ? 0 : second()))
                return false;
        return true;
    }
};

std::vector<ElementaryQuery> read_queries(const std::filesystem::path& file) {
    std::vector<ElementaryQuery> queries;
    std::ifstream lines(file);
    int row = 0;
    for (std::string line; std::getline(lines, line); ++row) {
        std::array<std::string, 7> fields;
        std::istringstream stream(line);
        for (std::string& field : fields)
            std::getline(stream, field, ',');
        if (row % 8 == 0)
            queries.emplace_back().name = file.string() + " query " + std::to_string(row / 8);
        ElementaryQuery& query = queries.back();
        for (int c = 0; c < 3; ++c)
            query.points[row % 8][c] = Rational(Integer(fields[2 * c]), Integer(fields[2 * c + 1]));
        query.collides = fields[6].find('1') != std::string::npos;
        query.is_vertex_face = file.string().find("vertex-face") != std::string::npos;
    }
    return queries;
}

Eigen::Vector3d in_double(const RationalPoint& p) {
    return {p[0].convert_to<double>(), p[1].convert_to<double>(), p[2].convert_to<double>()};
}

attack::Shape triangle(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c) {
    return {{a, b, c}, {{0, 1, 2}}};
}

Polyhedron polyhedron(const attack::Shape& shape) {
    return Polyhedron::from_polygons(shape.vertices, shape.faces);
}

constexpr double sliver_width = 0x1p-20;

attack::Shape sliver_at(const Eigen::Vector3d& a, const Eigen::Vector3d& b, Eigen::Vector3d behind) {
    const Eigen::Vector3d edge = (b - a).normalized();
    behind.normalize();
    if (behind.cross(edge).norm() < 1e-3)
        behind = edge.unitOrthogonal();
    return triangle(a, b, 0.5 * (a + b) + sliver_width * behind);
}

attack::Shape spike_at(const Eigen::Vector3d& tip, Eigen::Vector3d behind) {
    behind = behind.norm() > 0 ? behind.normalized() : Eigen::Vector3d::UnitX();
    const Eigen::Vector3d base = tip + sliver_width * behind;
    return triangle(tip, base, base + 0.1 * sliver_width * behind.unitOrthogonal());
}

attack::MeshCase mesh_case(const ElementaryQuery& query) {
    std::array<Eigen::Vector3d, 4> p;
    for (int i = 0; i < 4; ++i)
        p[i] = in_double(query.points[i]);
    attack::PosedMotion posed;
    posed.is_relative = true;
    posed.moving_goal = Pose(in_double(query.displacement(0)), Eigen::Quaterniond::Identity());
    posed.fixed_goal = Pose(in_double(query.displacement(query.second())), Eigen::Quaterniond::Identity());
    const Eigen::Vector3d ahead = posed.moving_goal.translation - posed.fixed_goal.translation;
    const bool vf = query.is_vertex_face;
    return {vf ? spike_at(p[0], -ahead) : sliver_at(p[0], p[1], -ahead),
            vf ? triangle(p[1], p[2], p[3]) : sliver_at(p[2], p[3], ahead), posed};
}

FirstContact answer(const attack::MeshCase& pair) {
    return first_contact({.moving = polyhedron(pair.moving),
                          .fixed = polyhedron(pair.fixed),
                          .motion = pair.posed.motion(),
                          .options = {.find = Find::first_with_all_contacts}});
}

/// Whether the contact is between the query's own primitives, not at an added corner.
bool is_own(const Contact& contact, bool is_vertex_face) {
    if (is_vertex_face)
        return contact.kind == ContactKind::vertex_face && contact.moving.first == 0;
    const auto is_first_edge = [](const Feature& f) { return f.first == 0 && f.second == 1; };
    return contact.kind == ContactKind::edge_edge && is_first_edge(contact.moving) && is_first_edge(contact.fixed);
}

struct Tally {
    int queries = 0;
    int colliding = 0;
    int missed = 0;
    int false_alarms = 0;  ///< contacts of the query's own primitives where the true answer is no
    int added_corners = 0; ///< contacts only of added corners
    attack::Tally exact{}; ///< the same mesh pairs against the exact reference
};

void compare(const ElementaryQuery& query, Tally& tally) {
    const attack::MeshCase pair = mesh_case(query);
    EXPECT_EQ(attack::check(pair, tally.exact), "") << query.name;
    const FirstContact found = answer(pair);
    const bool touches = found.verdict != Verdict::clear;
    ++tally.queries;
    tally.colliding += query.collides ? 1 : 0;
    if (query.collides && !touches) {
        ++tally.missed;
        ADD_FAILURE() << query.name << " is missed";
    }
    if (query.collides || !touches)
        return;
    const bool own = std::any_of(found.contacts.begin(), found.contacts.end(),
                                 [&](const Contact& c) { return is_own(c, query.is_vertex_face); });
    ++(own ? tally.false_alarms : tally.added_corners);
    if (own)
        ADD_FAILURE() << query.name << " is a false alarm, certain: " << found.certain;
}

TEST(RationalQueries, NoContactIsMissedAndNoneIsInvented) {
    CHASLES_REQUIRE_DATA("ccd-queries-rational");
    Tally tally;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(shared_data("ccd-queries-rational"))) {
        if (entry.path().extension() != ".csv" || entry.path().filename() == "SUMMARY.csv")
            continue;
        for (const ElementaryQuery& query : read_queries(entry.path()))
            if (query.is_rigid())
                compare(query, tally);
    }
    EXPECT_EQ(tally.queries, 590);
    EXPECT_EQ(tally.colliding, 173);
    print_figures("ccd-queries-rational: %d rigid queries, %d collide; %d missed, %d false alarms "
                  "(%d more contacts of the corners that make an edge or a vertex a mesh)",
                  tally.queries, tally.colliding, tally.missed, tally.false_alarms, tally.added_corners);
    print_figures("  against exact arithmetic on the doubles: %d missed, %d false alarms, %d late, %d not certain",
                  int(tally.exact.missed), int(tally.exact.false_alarms), int(tally.exact.late),
                  int(tally.exact.uncertain));
}

} // namespace
} // namespace chasles::test
