// Chasles beside other libraries: who is right how often, and for what price. Answers come first: what is true is
// established without the peers, each of them is held against it, and then all take turns to be timed on the same
// questions. The table goes to standard output and to bench/results/.
#include "bench/all_peers.h"
#include "bench/peer_judge.h"
#include "bench/peer_table.h"
#include "bench/run_benchmarks.h"

#include <benchmark/benchmark.h>
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <memory>

namespace chasles::bench {
namespace {

/// What a row may cost while the answers are judged, and again while they are timed: slow peers get fewer queries.
constexpr double judging_seconds = 1.5;
constexpr double timing_seconds = 0.5;

/// One peer on one case.
struct Contest {
    const PeerCase& pair;
    std::string peer;
    PeerPair asked;
    Judgement judged;
    std::vector<std::vector<double>> seconds; ///< by query, one number a repetition
};

void time_queries(benchmark::State& state, Contest& contest) {
    using Clock = std::chrono::steady_clock;
    std::size_t query = 0;
    for (auto _ : state) {
        const Displacement& motion = contest.pair.questions[query].motion;
        const Clock::time_point start = Clock::now();
        const PeerAnswer answer = contest.asked.ask(motion);
        const double seconds = std::chrono::duration<double>(Clock::now() - start).count();
        benchmark::DoNotOptimize(answer);
        state.SetIterationTime(seconds);
        contest.seconds[query].push_back(seconds);
        query = (query + 1) % contest.seconds.size();
    }
    state.counters["missed"] = double(contest.judged.missed);
    state.counters["false_alarms"] = double(contest.judged.false_alarms);
}

/// One repetition asks every query once; repetitions of all contests take turns.
void add_benchmark(Contest& contest) {
    const double repetitions = std::clamp(timing_seconds / contest.judged.seconds, 1.0, 15.0);
    benchmark::RegisterBenchmark((contest.pair.name + "/" + contest.peer).c_str(),
                                 [&contest](benchmark::State& state) { time_queries(state, contest); })
        ->UseManualTime()
        ->Iterations(benchmark::IterationCount(contest.judged.queries))
        ->Repetitions(int(repetitions));
}

class Comparison {
public:
    explicit Comparison(const AllPeers& peers) : peers_(peers), cases_(peer_cases()) {}

    /// False, with lines on standard output, if what is held to be true is not.
    bool judge_all() {
        bool is_right = true;
        for (const PeerCase& pair : cases_) {
            std::vector<Truth> truths;
            std::string contradiction;
            for (const PeerQuestion& question : pair.questions) {
                truths.push_back(truth_of(pair, question));
                if (!truths.back().contradiction.empty())
                    contradiction = "query " + std::to_string(truths.size() - 1) + ": " + truths.back().contradiction;
            }
            for (const Peer& peer : peers_.present) {
                if (peer.is_for_convex_bodies_only && !pair.is_convex)
                    continue;
                const PeerPair asked = peer.prepare(pair.moving, pair.fixed);
                const Judgement judged = judge(pair, asked, truths, judging_seconds);
                if (!judged.contradiction.empty())
                    contradiction = peer.name + ", " + judged.contradiction;
                contests_.push_back({pair, peer.name, asked, judged, std::vector<std::vector<double>>(judged.queries)});
            }
            std::printf("%-26s %s\n", pair.name.c_str(), contradiction.empty() ? "checked" : contradiction.c_str());
            std::fflush(stdout);
            is_right = is_right && contradiction.empty();
        }
        return is_right;
    }

    void add_benchmarks() {
        for (Contest& contest : contests_)
            add_benchmark(contest);
    }

    [[nodiscard]] PeerTable table() const {
        PeerTable table{{}, peers_.absent};
        double reference = 0;
        for (const Contest& contest : contests_) {
            std::vector<double> medians;
            for (const std::vector<double>& repeated : contest.seconds)
                if (!repeated.empty())
                    medians.push_back(spread_of(repeated).median);
            const Spread time = spread_of(medians);
            if (contest.peer == peers_.present.front().name)
                reference = time.median;
            table.rows.push_back(
                {contest.pair.name, contest.peer, contest.judged, time, reference > 0 ? time.median / reference : 0});
        }
        return table;
    }

private:
    const AllPeers& peers_;
    std::vector<PeerCase> cases_;
    std::vector<Contest> contests_;
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
    Comparison comparison(peers);
    if (!comparison.judge_all())
        return 1;
    comparison.add_benchmarks();
    benchmark::ConsoleReporter silent(benchmark::ConsoleReporter::OO_None); // the table says it all
    const int status = run_benchmarks(argc, argv, &silent);
    if (status == 0)
        write(comparison.table());
    return status;
}

} // namespace
} // namespace chasles::bench

int main(int argc, char** argv) {
    return chasles::bench::run(argc, argv);
}
