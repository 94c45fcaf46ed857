// Elementary queries of turning rigid bodies from a simulator, compared with the exact reference: as elementary
// detections in both precisions, and as mesh pairs whose added corners trail the motion.
#include "tests/attack/check_elementary.h"
#include "tests/attack/check_mesh.h"
#include "tests/data/shared_data.h"

#include <fstream>
#include <nlohmann/json.hpp>

namespace chasles::test {
namespace {

using Json = nlohmann::json;

Eigen::Vector3d vector(const Json& numbers) {
    return {numbers.at(0).get<double>(), numbers.at(1).get<double>(), numbers.at(2).get<double>()};
}

/// The pose `steps` simulator steps after the first pose. The rotation vector is axis times angle. The query uses the
/// quaternion of this vector, rounded to doubles.
Pose pose(const Json& body, double steps) {
    const auto number = [&](const char* name) -> Eigen::Vector3d {
        const Eigen::Vector3d from = vector(body.at("pose_t0").at(name));
        return from + steps * (vector(body.at("pose_t1").at(name)) - from);
    };
    const Eigen::Vector3d rotation = number("rotation");
    const double angle = rotation.norm();
    const Eigen::Vector3d axis = angle > 0 ? Eigen::Vector3d(rotation / angle) : Eigen::Vector3d::UnitZ();
    return Pose(number("position"), Eigen::Quaterniond(Eigen::AngleAxisd(angle, axis)));
}

/// One query: the features and the poses of both bodies.
attack::QuestionGroup question_in(const Json& json, double steps) {
    const bool is_edges = json.at("type") == "ee";
    const Json& moving = json.at(is_edges ? "edge0" : "vertex");
    const Json& fixed = json.at(is_edges ? "edge1" : "face");
    attack::Question question;
    question.kind = is_edges ? attack::QuestionKind::edge_edge : attack::QuestionKind::vertex_face;
    const auto add = [](std::vector<Eigen::Vector3d>& points, const Json& body) {
        for (const char* name : {"vertex", "vertex0", "vertex1", "vertex2"})
            if (body.contains(name))
                points.push_back(vector(body.at(name)));
    };
    add(question.moving, moving);
    add(question.fixed, fixed);
    attack::PosedMotion posed;
    posed.is_relative = true;
    posed.moving_start = pose(moving, 0);
    posed.moving_goal = pose(moving, steps);
    posed.fixed_start = pose(fixed, 0);
    posed.fixed_goal = pose(fixed, steps);
    return {posed, {question}};
}

/// A feature as a triangle; a sliver if the feature has fewer than three points.
attack::Shape triangle_of(std::vector<Eigen::Vector3d> points) {
    if (points.size() == 1)
        points.push_back(points[0] + Eigen::Vector3d(0x1p-20, 0, 0));
    if (points.size() == 2)
        points.push_back(0.5 * (points[0] + points[1]) + 0x1p-20 * (points[1] - points[0]).unitOrthogonal());
    return {points, {{0, 1, 2}}};
}

struct Figures {
    attack::StageTallies elementary;
    attack::Tally pairs;
};

/// Runs all queries with a motion of `steps` simulator steps.
Figures answered(double steps) {
    Figures figures;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(shared_data("rigid-ccd-queries"))) {
        if (entry.path().extension() != ".json")
            continue;
        SCOPED_TRACE(entry.path().string());
        const attack::QuestionGroup group = question_in(Json::parse(std::ifstream(entry.path())), steps);
        EXPECT_EQ(attack::check(group, figures.elementary), "");
        const attack::Question& question = group.questions[0];
        EXPECT_EQ(
            attack::check({triangle_of(question.moving), triangle_of(question.fixed), group.posed}, figures.pairs), "");
    }
    const auto count = [](std::uint64_t x) { return static_cast<unsigned long long>(x); };
    const attack::Tally& filter = figures.elementary.filter;
    const attack::Tally& refinement = figures.elementary.refinement;
    print_figures("rigid-ccd-queries, %g steps: %llu queries, %llu touch by exact arithmetic; in double %llu missed, "
                  "%llu uncertain; in double-double %llu missed, %llu uncertain",
                  steps, count(filter.queries), count(filter.touches), count(filter.missed), count(filter.uncertain),
                  count(refinement.missed), count(refinement.uncertain));
    print_figures("  as mesh pairs: %llu touch, %llu missed, %llu false alarms, %llu late, %llu uncertain",
                  count(figures.pairs.touches), count(figures.pairs.missed), count(figures.pairs.false_alarms),
                  count(figures.pairs.late), count(figures.pairs.uncertain));
    EXPECT_EQ(filter.queries, 197u);
    EXPECT_EQ(figures.pairs.queries, 197u);
    return figures;
}

/// The simulator keeps its bodies apart: none of its queries touches. With longer steps some queries touch.
TEST(RigidQueries, AnswersAgreeWithExactArithmetic) {
    CHASLES_REQUIRE_DATA("rigid-ccd-queries");
    EXPECT_EQ(answered(1).elementary.filter.touches, 0u);
    EXPECT_GT(answered(64).elementary.filter.touches, 10u);
}

} // namespace
} // namespace chasles::test
