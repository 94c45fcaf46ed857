// One feature pair under one translation, where vertices move along straight lines: the elementary detections of
// Chasles, and Tight-Inclusion from the IPC Toolkit. The true answers are known exactly, by construction. The overhead
// of a call from Python is measured; the ratio of the times excludes it.
#include "bench/child_process.h"
#include "bench/elementary_detector.h"
#include "bench/peer_table.h"
#include "bench/process_peer.h"
#include "bench/registry_peers.h"
#include "bench/translation_cases.h"
#include "chasles/motion/motion.h"
#include "chasles/search/touch_stages.h"

#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <memory>
#include <sstream>

namespace chasles::bench {
namespace {

using algebra::DoubleDouble;
using algebra::FeasibleInterval;

/// The detection of a query: in double precision, and in double-double precision for an uncertain answer.
class Chasles {
public:
    std::optional<FeasibleInterval> operator()(const auto& problem) {
        const auto found = filter_(problem);
        if (!found || (found->certain && found->upper - found->lower <= width))
            return found;
        refinement_.use(search::refinement_tolerance(width, *found));
        return refinement_(problem);
    }

private:
    static constexpr double width = 1e-12;

    motion::RationalMotion<DoubleDouble> motion_ =
        ScrewMotion::between(Pose(), Pose(way, Eigen::Quaterniond::Identity())).frame().motion;
    motion::ControlMaps<double> maps_ = motion::double_maps(motion_);
    motion::ControlMaps<DoubleDouble> exact_maps_ = motion::control_maps(motion_);
    Detector<double> filter_{maps_, maps_, search::filter_tolerance(width)};
    Detector<DoubleDouble> refinement_{exact_maps_, maps_, {}};
};

PeerAnswer answer_of(Chasles& chasles, const auto& problem) {
    const auto found = chasles(problem);
    PeerAnswer answer{found.has_value(), {}, 1e-9 * nanoseconds_of(5, 20, [&] { return chasles(problem); })};
    if (found)
        answer.time = found->lower;
    return answer;
}

std::string words_of(const Point& point) {
    char text[96];
    std::snprintf(text, sizeof text, " %.17g %.17g %.17g", point.x, point.y, point.z);
    return text;
}

std::string line_of(const VertexFaceProblem& problem) {
    const auto& [a, b, c] = problem.face;
    return "vertex_face" + words_of(problem.vertex) + words_of(a) + words_of(b) + words_of(c);
}

std::string line_of(const EdgeEdgeProblem& problem) {
    return "edge_edge" + words_of(problem.moving[0]) + words_of(problem.moving[1]) + words_of(problem.fixed[0]) +
           words_of(problem.fixed[1]);
}

/// The IPC Toolkit in its own process.
class TightInclusion {
public:
    TightInclusion(const PythonPeers& python, const std::string& rescaling)
        : child_({python.interpreter, python.scripts + "/translations.py", rescaling}) {
        expect_ready(child_, limit);
    }

    PeerAnswer operator()(const auto& problem) {
        const std::string way_words = words_of({way.x(), way.y(), way.z()});
        return answer_in(child_.ask(line_of(problem) + way_words, limit));
    }

    /// Seconds of a nearly empty call of this kind (the first word of a problem).
    double seconds_of_a_call(const std::string& kind) { return *answer_in(child_.ask("call " + kind, limit)).seconds; }

private:
    static constexpr ChildProcess::Limit limit{60};
    ChildProcess child_;
};

/// One detector on one case.
struct Row {
    std::string case_name;
    std::string detector;
    std::size_t missed = 0;
    std::size_t false_alarms = 0;
    double worst_time_error = 0;
    std::vector<double> seconds;
    double seconds_of_a_call = 0; ///< overhead included in each of the seconds

    void add(const PeerAnswer& answer, bool touches, double time) {
        missed += touches && !answer.touches ? 1 : 0;
        false_alarms += !touches && answer.touches ? 1 : 0;
        if (touches && answer.time)
            worst_time_error = std::max(worst_time_error, std::abs(*answer.time - time));
        seconds.push_back(*answer.seconds);
    }
};

struct Detectors {
    Chasles chasles;
    std::vector<std::pair<std::string, std::unique_ptr<TightInclusion>>> others;
};

Detectors all_detectors(std::string& absent_because) {
    Detectors detectors;
    const PythonPeers python = python_peers();
    absent_because = python.absent_because;
    if (!absent_because.empty())
        return detectors;
    try {
        detectors.others.emplace_back("Tight-Inclusion", std::make_unique<TightInclusion>(python, "1"));
        detectors.others.emplace_back("Tight-Inclusion, default rescaling",
                                      std::make_unique<TightInclusion>(python, "0.8"));
    } catch (const std::runtime_error& failure) {
        absent_because = failure.what();
        detectors.others.clear();
    }
    return detectors;
}

/// All detectors take turns, one problem at a time.
template <class Problem>
std::vector<Row> rows_of(const TranslationCase<Problem>& test_case, Detectors& detectors) {
    std::vector<Row> rows{{test_case.name, "Chasles", 0, 0, 0, {}, 0}};
    const std::string line = line_of(test_case.problems.front());
    for (auto& [name, ask] : detectors.others)
        rows.push_back({test_case.name, name, 0, 0, 0, {}, ask->seconds_of_a_call(line.substr(0, line.find(' ')))});
    for (const Problem& problem : test_case.problems) {
        rows[0].add(answer_of(detectors.chasles, problem), test_case.touches, problem.tau);
        for (std::size_t i = 0; i < detectors.others.size(); ++i)
            rows[i + 1].add((*detectors.others[i].second)(problem), test_case.touches, problem.tau);
    }
    return rows;
}

std::string cell(const char* format, double value) {
    char text[32];
    std::snprintf(text, sizeof text, format, value);
    return text;
}

using Cells = std::vector<std::string>;

const Cells heads{"case",      "detector", "problems", "missed",  "false alarms", "time error",
                  "median ns", "99 % ns",  "worst ns", "call ns", "ratio"};

/// Times include the overhead of a call; the ratio of the medians excludes it. A row whose median is at most twice the
/// overhead has no ratio.
Cells cells_of(const Row& row, double unit) {
    const Spread all = spread_of(row.seconds);
    const auto own = [&](double seconds) { return std::max(0.0, seconds - row.seconds_of_a_call); };
    const bool is_seen = all.median > 2 * row.seconds_of_a_call;
    return {row.case_name,
            row.detector,
            std::to_string(row.seconds.size()),
            std::to_string(row.missed),
            std::to_string(row.false_alarms),
            cell("%.1e", row.worst_time_error),
            cell("%.0f", 1e9 * all.median),
            cell("%.0f", 1e9 * all.ninety_nine_percent),
            cell("%.0f", 1e9 * all.worst),
            cell("%.0f", 1e9 * row.seconds_of_a_call),
            is_seen ? cell("%.3g", own(all.median) / unit) : "-"};
}

std::vector<Cells> lines_of(const std::vector<Row>& rows) {
    std::vector<Cells> lines{heads};
    double unit = 1;
    for (const Row& row : rows) {
        if (row.detector == "Chasles")
            unit = spread_of(row.seconds).median;
        lines.push_back(cells_of(row, unit));
    }
    return lines;
}

void print(std::ostream& out, const std::vector<Cells>& lines) {
    for (const Cells& cells : lines) {
        char text[160];
        std::snprintf(text, sizeof text, "%-28s %-35s %8s %6s %12s %10s", cells[0].c_str(), cells[1].c_str(),
                      cells[2].c_str(), cells[3].c_str(), cells[4].c_str(), cells[5].c_str());
        out << text;
        std::snprintf(text, sizeof text, " %9s %9s %10s %7s %8s\n", cells[6].c_str(), cells[7].c_str(),
                      cells[8].c_str(), cells[9].c_str(), cells[10].c_str());
        out << text;
    }
    out << "\nTimes are per problem and include the overhead of a call from Python (call). Ratio: between medians, "
           "without "
           "the overhead.\n";
}

void print_csv(std::ostream& out, const std::vector<Cells>& lines) {
    for (const Cells& cells : lines)
        for (std::size_t i = 0; i < cells.size(); ++i)
            out << '"' << cells[i] << (i + 1 < cells.size() ? "\"," : "\"\n");
}

bool is_right(const std::vector<Row>& rows) {
    return std::none_of(rows.begin(), rows.end(), [](const Row& row) {
        return row.detector == "Chasles" && (row.missed + row.false_alarms > 0 || row.worst_time_error > 1e-11);
    });
}

int run() {
    std::string absent_because;
    Detectors detectors = all_detectors(absent_because);
    std::vector<Row> rows;
    const auto add = [&](const auto& cases) {
        for (const auto& test_case : cases)
            for (Row& row : rows_of(test_case, detectors))
                rows.push_back(std::move(row));
    };
    try {
        add(vertex_face_translations());
        add(edge_edge_translations());
    } catch (const std::runtime_error& failure) { // runs without the peer
        absent_because = failure.what();
        detectors.others.clear();
        rows.clear();
        add(vertex_face_translations());
        add(edge_edge_translations());
    }
    const std::vector<Cells> lines = lines_of(rows);
    print(std::cout, lines);
    if (!absent_because.empty())
        std::cout << "absent: IPC Toolkit (" << absent_because << ")\n";
    const std::filesystem::path results = CHASLES_BENCH_RESULTS;
    std::filesystem::create_directories(results);
    std::ofstream csv(results / "translations_bench.csv");
    print_csv(csv, lines);
    if (!is_right(rows))
        std::cout << "an answer of Chasles is wrong\n";
    return is_right(rows) ? 0 : 1;
}

} // namespace
} // namespace chasles::bench

int main() {
    return chasles::bench::run();
}
