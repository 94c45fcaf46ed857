// 2,036 mesh pairs under screws whose first contacts are known to 15 digits, from a program that shares no formula
// with this one. Covers rotations from 1e-14 to 3.05 rad and motions down to 1e-7 of a body.

#include "tests/data/shared_data.h"

#include <map>
#include <nlohmann/json.hpp>
#include <numbers>
#include <zlib.h>

namespace chasles::test {
namespace {

using Json = nlohmann::json;

/// Lines of a gzip file.
template <class Function>
void for_each_line(const std::filesystem::path& file, Function function) {
    const gzFile stream = gzopen(file.c_str(), "rb");
    std::string line;
    for (int c = gzgetc(stream); c != -1; c = gzgetc(stream)) {
        if (c != '\n') {
            line.push_back(static_cast<char>(c));
            continue;
        }
        function(line);
        line.clear();
    }
    gzclose(stream);
}

Polyhedron polyhedron(const Json& mesh) {
    std::vector<Eigen::Vector3d> vertices;
    for (const auto& v : mesh["v"].get<std::vector<std::vector<double>>>())
        vertices.emplace_back(v[0], v[1], v[2]);
    return Polyhedron::from_polygons(vertices, mesh["f"].get<std::vector<std::vector<std::uint32_t>>>());
}

Pose pose(const Json& numbers) {
    const auto n = numbers.get<std::vector<double>>();
    return {Eigen::Vector3d(n[0], n[1], n[2]), Eigen::Quaterniond(n[3], n[4], n[5], n[6])};
}

const char* name_of(Verdict verdict) {
    switch (verdict) {
    case Verdict::clear:
        return "clear";
    case Verdict::contact:
        return "contact";
    case Verdict::contact_at_start:
        return "contact_at_start";
    }
    return "";
}

bool encloses(const Bracket& bracket, double value) {
    return bracket.lower <= value && value <= bracket.upper;
}

struct Tally {
    int cases = 0;
    int wrong_verdicts = 0;
    int outside_bracket = 0;
    int uncertain = 0;
    double widest = 0; ///< bracket of time
    Work work;
};

void answer(const std::string& line, Tally& tally) {
    const Json one = Json::parse(line);
    const FirstContact found = first_contact({.moving = polyhedron(one["moving"]),
                                              .fixed = polyhedron(one["fixed"]),
                                              .motion = ScrewMotion::between(pose(one["start"]), pose(one["goal"])),
                                              .max_turn = std::numbers::pi});
    ++tally.cases;
    tally.work += found.work;
    const Json& truth = one["truth"];
    if (truth["verdict"] != name_of(found.verdict)) {
        ++tally.wrong_verdicts;
        ADD_FAILURE() << one["id"] << ": " << name_of(found.verdict) << " instead of " << truth;
        return;
    }
    if (found.verdict == Verdict::clear)
        return;
    tally.uncertain += found.certain ? 0 : 1;
    tally.widest = std::max(tally.widest, found.time.upper - found.time.lower);
    if (!encloses(found.tau, truth["tau"]) || !encloses(found.time, truth["time"])) {
        ++tally.outside_bracket;
        ADD_FAILURE() << one["id"] << ": tau in [" << found.tau.lower << ", " << found.tau.upper << "] excludes "
                      << truth;
    }
}

TEST(KnownAnswers, EveryVerdictIsRightAndEveryTauIsInsideItsBracket) {
    CHASLES_REQUIRE_DATA("screw-known-answers");
    Tally tally;
    const Stopwatch watch;
    for_each_line(shared_data("screw-known-answers/cases.jsonl.gz"), [&](const std::string& l) { answer(l, tally); });
    EXPECT_EQ(tally.cases, 2036);
    EXPECT_LE(tally.widest, 1e-12);
    print_figures("screw-known-answers: %d cases, %d wrong verdicts, %d outside the bracket, %d not certain, "
                  "widest bracket %.2g, %.2f s",
                  tally.cases, tally.wrong_verdicts, tally.outside_bracket, tally.uncertain, tally.widest,
                  watch.seconds());
    print_figures("  %llu elementary tests, %llu looked for roots, %llu repeated in double-double",
                  static_cast<unsigned long long>(tally.work.elementary_tests),
                  static_cast<unsigned long long>(tally.work.root_brackets),
                  static_cast<unsigned long long>(tally.work.refined));
}

} // namespace
} // namespace chasles::test
