// Chasles and other libraries: correctness and time. First the reference answers are computed without the peers, and
// the answers of each peer are compared with them. Then all peers are timed in turns on the same queries. The table is
// written to standard output and to bench/results/.
#include "bench/all_peers.h"
#include "bench/peer_judge.h"
#include "bench/peer_table.h"
#include "bench/run_benchmarks.h"

#include <algorithm>
#include <benchmark/benchmark.h>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <iterator>

namespace chasles::bench {
namespace {

/// Time limits per row for judging and for timing. Slow peers run fewer queries.
constexpr double judging_seconds = 1.2;
constexpr double timing_seconds = 0.5;

/// One peer on one case.
struct Contest {
    const PeerCase& pair;
    std::string peer;
    PeerPair asked;
    Judgement judged;
    std::vector<std::vector<double>> seconds; ///< by query, one number per repetition
    std::string failure;                      ///< empty, or the reason why there is no answer
};

void time_queries(benchmark::State& state, Contest& contest) {
    std::size_t query = 0;
    for (auto _ : state) {
        const Displacement& motion = contest.pair.questions[query].motion;
        const TimedAnswer timed = timed_answer(contest.asked, motion);
        benchmark::DoNotOptimize(timed);
        state.SetIterationTime(timed.seconds);
        contest.seconds[query].push_back(timed.seconds);
        query = (query + 1) % contest.seconds.size();
    }
    state.counters["missed"] = double(contest.judged.missed);
    state.counters["false_alarms"] = double(contest.judged.false_alarms);
}

/// One repetition runs every query once. The repetitions of all contests take turns.
void add_benchmark(Contest& contest) {
    const double repetitions = std::clamp(timing_seconds / contest.judged.seconds, 1.0, 15.0);
    benchmark::RegisterBenchmark((contest.pair.name + "/" + contest.peer).c_str(),
                                 [&contest](benchmark::State& state) {
                                     try {
                                         time_queries(state, contest);
                                     } catch (const PeerFailed& failure) {
                                         contest.failure = failure.what();
                                         state.SkipWithError(failure.what());
                                     }
                                 })
        ->UseManualTime()
        ->Iterations(benchmark::IterationCount(contest.judged.queries))
        ->Repetitions(int(repetitions));
}

Contest judged(const PeerCase& pair, const Peer& peer, const std::vector<Truth>& truths) {
    Contest contest{pair, peer.name, {}, {}, {}, {}};
    try {
        contest.asked = peer.prepare(pair.moving, pair.fixed);
        contest.judged = judge(pair, contest.asked, truths, judging_seconds);
        contest.seconds.resize(contest.judged.queries);
    } catch (const PeerFailed& failure) {
        contest.failure = failure.what();
    }
    return contest;
}

/// The contests of one case: all peers that accept its bodies.
std::vector<Contest> judged(const PeerCase& pair, const std::vector<Peer>& peers, const std::vector<Truth>& truths) {
    std::vector<Contest> contests;
    for (const Peer& peer : peers)
        if (pair.is_convex || !peer.is_for_convex_bodies_only)
            contests.push_back(judged(pair, peer, truths));
    return contests;
}

/// Empty, or a contradiction between Chasles, the construction, the discrete test and the peers.
std::string contradiction(const std::vector<Truth>& truths, const std::vector<Contest>& contests) {
    for (std::size_t query = 0; query < truths.size(); ++query)
        if (!truths[query].contradiction.empty())
            return "query " + std::to_string(query) + ": " + truths[query].contradiction;
    for (const Contest& contest : contests)
        if (!contest.judged.contradiction.empty())
            return contest.peer + ", " + contest.judged.contradiction;
    return {};
}

/// The contests of all cases. Empty, with a line on standard output, if a reference answer is wrong.
std::vector<Contest> judged(const std::vector<PeerCase>& cases, const std::vector<Peer>& peers) {
    std::vector<Contest> all;
    bool is_right = true;
    for (const PeerCase& pair : cases) {
        std::vector<Truth> truths;
        for (const PeerQuestion& question : pair.questions)
            truths.push_back(truth_of(pair, question));
        std::vector<Contest> contests = judged(pair, peers, truths);
        const std::string reason = contradiction(truths, contests);
        std::printf("%-27s %s\n", pair.name.c_str(), reason.empty() ? "checked" : reason.c_str());
        std::fflush(stdout);
        is_right = is_right && reason.empty();
        std::move(contests.begin(), contests.end(), std::back_inserter(all));
    }
    return is_right ? std::move(all) : std::vector<Contest>();
}

/// The spread of the medians of the first `count` queries, omitting queries that were not timed.
Spread time_of(const Contest& contest, std::size_t count) {
    std::vector<double> medians;
    for (std::size_t query = 0; query < std::min(count, contest.seconds.size()); ++query)
        if (!contest.seconds[query].empty())
            medians.push_back(spread_of(contest.seconds[query]).median);
    return spread_of(medians);
}

PeerTable table_of(const std::vector<Contest>& contests, const AllPeers& peers) {
    PeerTable table{{}, peers.absent};
    const Contest* reference = nullptr;
    for (const Contest& contest : contests) {
        if (contest.peer == peers.present.front().name)
            reference = &contest;
        if (!contest.failure.empty()) {
            table.rows.push_back({contest.pair.name, contest.peer + " (" + contest.failure + ")", {}, {}, 0});
            continue;
        }
        const Spread time = time_of(contest, contest.judged.queries);
        const std::size_t common = std::min(contest.judged.queries, reference->judged.queries);
        const double unit = time_of(*reference, common).median;
        table.rows.push_back({contest.pair.name, contest.peer, contest.judged, time,
                              unit > 0 ? time_of(contest, common).median / unit : 0});
    }
    return table;
}

/// Prints nothing, because the table has all results.
class SilentReporter : public benchmark::ConsoleReporter {
public:
    void ReportRuns(const std::vector<Run>& /*runs*/) override {}
};

void write(const PeerTable& table) {
    const std::filesystem::path results = CHASLES_BENCH_RESULTS;
    std::ofstream markdown(results / "peers_bench.md");
    std::ofstream csv(results / "peers_bench.csv");
    print_markdown(markdown, table);
    print_csv(csv, table);
    print(std::cout, table);
}

int run(int argc, char** argv) {
    const AllPeers peers = all_peers();
    const std::vector<PeerCase> cases = peer_cases();
    std::vector<Contest> contests = judged(cases, peers.present);
    if (contests.empty())
        return 1;
    for (Contest& contest : contests)
        if (contest.failure.empty())
            add_benchmark(contest);
    SilentReporter silent;
    const int status = run_benchmarks(argc, argv, &silent);
    if (status == 0)
        write(table_of(contests, peers));
    return status;
}

} // namespace
} // namespace chasles::bench

int main(int argc, char** argv) {
    return chasles::bench::run(argc, argv);
}
