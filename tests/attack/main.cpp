// Tests the library with millions of questions, most of them degenerate on purpose, and compares every answer with the
// exact reference. The exit status is 1 after any miss, false alarm, or late or wrong bracket; with --certain also
// after any uncertain answer.
#include "tests/attack/check_elementary.h"
#include "tests/attack/check_least.h"
#include "tests/attack/check_margin.h"
#include "tests/attack/check_mesh.h"
#include "tests/attack/check_trajectory.h"

#include <CLI/CLI.hpp>
#include <atomic>
#include <iostream>
#include <mutex>
#include <thread>

namespace chasles::attack {
namespace {

struct Options {
    std::uint64_t seed = 1;
    std::uint64_t mesh_pairs = 100'000;
    std::uint64_t elementary = 10'000'000;
    std::uint64_t margins = 100'000;
    std::uint64_t least = 10'000;
    std::uint64_t trajectories = 20'000;
    unsigned threads = std::max(1u, std::thread::hardware_concurrency());
    std::string family;
    std::int64_t index = -1;
    int shown = 3;
    bool certain = false;
};

/// Calls attack(index, tally) for all indices on several threads.
template <class Attack>
Tally run(std::uint64_t count, unsigned threads, Attack attack) {
    std::atomic<std::uint64_t> next{0};
    std::mutex mutex;
    Tally sum;
    const auto work = [&] {
        Tally mine;
        for (std::uint64_t i = next++; i < count; i = next++)
            attack(i, mine);
        const std::lock_guard lock(mutex);
        sum += mine;
    };
    std::vector<std::thread> pool;
    for (unsigned i = 1; i < threads; ++i)
        pool.emplace_back(work);
    work();
    for (std::thread& thread : pool)
        thread.join();
    return sum;
}

/// Prints the first few wrong answers of a family, with the options that reproduce them.
class Failures {
public:
    Failures(const Options& options, std::string family) : options_(options), family_(std::move(family)) {}

    void report(std::uint64_t index, const std::string& what, const std::string& described) {
        const std::lock_guard lock(mutex_);
        if (shown_++ < options_.shown)
            std::cout << "WRONG: " << what << "\n  chasles_attack --seed " << options_.seed << " --family \"" << family_
                      << "\" --index " << index << "\n"
                      << described << std::flush;
    }

private:
    const Options& options_;
    std::string family_;
    std::mutex mutex_;
    int shown_ = 0;
};

/// The error of a check, or the message of an exception.
template <class Check>
std::string guarded(Check check, Tally& tally) {
    try {
        return check();
    } catch (const std::exception& error) {
        ++tally.failed;
        return error.what();
    }
}

/// Tests one family of mesh pairs, with or without a margin.
template <class Family>
Tally attack_pairs(const Family& family, const std::string& name, std::uint64_t number, std::uint64_t total,
                   const Options& options) {
    Failures failures(options, name);
    const auto attack = [&](std::uint64_t index, Tally& tally) {
        AttackRandom random(options.seed, number, index);
        const auto posed = family.make(random);
        const std::string wrong = guarded([&] { return check(posed, tally); }, tally);
        if (!wrong.empty())
            failures.report(index, wrong, described(posed));
        else if (options.index >= 0)
            std::cout << described(posed);
    };
    if (options.index >= 0) {
        Tally tally;
        attack(static_cast<std::uint64_t>(options.index), tally);
        return tally;
    }
    const auto count = static_cast<std::uint64_t>(std::ceil(family.share * double(total)));
    return run(count, options.threads, attack);
}

/// Tests one family of elementary questions; one line per stage.
std::array<NamedTally, 3> attack_elementary(const ElementaryFamily& family, std::uint64_t number,
                                            const Options& options) {
    Failures failures(options, family.name);
    std::mutex mutex;
    StageTallies sum;
    const auto attack = [&](std::uint64_t index, Tally&) {
        AttackRandom random(options.seed, number, index);
        StageTallies mine;
        const std::string wrong = guarded([&] { return check(family.make(random), mine); }, mine.filter);
        if (!wrong.empty())
            failures.report(index, wrong, "");
        const std::lock_guard lock(mutex);
        sum += mine;
    };
    const double groups = family.share * double(options.elementary) / double(questions_of_group);
    if (options.index >= 0) {
        Tally none;
        attack(static_cast<std::uint64_t>(options.index), none);
    } else {
        run(static_cast<std::uint64_t>(std::ceil(groups)), options.threads, attack);
    }
    const std::string name = family.name;
    return {NamedTally{name + ", double", sum.filter}, NamedTally{name + ", dd", sum.refinement},
            NamedTally{name + ", exact", sum.exact}};
}

/// A table that grows line by line.
class Table {
public:
    explicit Table(const std::string& title) { print_header(title); }
    void add(const NamedTally& line) {
        print_line(line);
        sum_.tally += line.tally;
        any_idle_ = any_idle_ || line.tally.is_idle();
    }
    /// Prints the last line.
    const Tally& sum() const {
        print_line(sum_);
        if (any_idle_)
            std::cout << "WRONG: a family with too few touches\n";
        return sum_.tally;
    }
    [[nodiscard]] bool is_broken() const { return any_idle_ || sum_.tally.is_broken(); }

private:
    NamedTally sum_{"all", {}};
    bool any_idle_ = false;
};

int attack_all(const Options& options) {
    std::cout << "seed " << options.seed << std::endl;
    const auto is_chosen = [&](const std::string& name) { return options.family.empty() || options.family == name; };
    bool is_broken = false;
    bool is_in_doubt = false; // after the last stage
    std::uint64_t number = 0;
    if (options.elementary > 0) {
        Table table("elementary");
        for (const ElementaryFamily& family : elementary_families()) {
            if (++number; !is_chosen(family.name))
                continue;
            const auto lines = attack_elementary(family, number, options);
            for (const NamedTally& line : lines)
                table.add(line);
            is_in_doubt = is_in_doubt || lines.back().tally.is_in_doubt();
        }
        table.sum();
        is_broken = table.is_broken();
    }
    const auto attack_all_pairs = [&](const char* title, std::uint64_t total, const auto& families, const char* kind) {
        Table table(title);
        for (const auto& family : families) {
            const std::string name = std::string(kind) + family.name;
            if (++number; is_chosen(name))
                table.add({family.name, attack_pairs(family, name, number, total, options)});
        }
        const Tally& sum = table.sum();
        is_broken = is_broken || table.is_broken();
        return sum;
    };
    number = 100;
    if (options.mesh_pairs > 0)
        is_in_doubt =
            attack_all_pairs("mesh pairs", options.mesh_pairs, mesh_families(), "mesh ").is_in_doubt() || is_in_doubt;
    number = 200;
    if (options.margins > 0) // answers within the resolution may be uncertain
        is_in_doubt =
            attack_all_pairs("margins", options.margins, margin_families(), "margin ").loose > 0 || is_in_doubt;
    number = 300;
    if (options.least > 0) // distances as small as their rounding are uncertain
        attack_all_pairs("least distances", options.least, least_families(), "least ");
    number = 400;
    if (options.trajectories > 0) // grazes are uncertain: there is no exact stage for motions that are not rational
        attack_all_pairs("trajectories", options.trajectories, trajectory_families(), "trajectory ");
    return is_broken || (options.certain && is_in_doubt) ? 1 : 0;
}

} // namespace
} // namespace chasles::attack

int main(int argc, char** argv) {
    chasles::attack::Options options;
    CLI::App app("Degenerate questions in bulk, each answer held against exact arithmetic.");
    app.add_option("--seed", options.seed, "brings back the same questions")->capture_default_str();
    app.add_option("--mesh-pairs", options.mesh_pairs, "how many")->capture_default_str();
    app.add_option("--elementary", options.elementary, "how many elementary queries")->capture_default_str();
    app.add_option("--margins", options.margins, "how many mesh pairs with a margin")->capture_default_str();
    app.add_option("--least", options.least, "how many least distances")->capture_default_str();
    app.add_option("--trajectories", options.trajectories, "how many questions for each motion that is not rational")
        ->capture_default_str();
    app.add_option("--threads", options.threads, "at most")->capture_default_str();
    app.add_option("--family", options.family, "only this one");
    app.add_option("--index", options.index, "only this case of the family");
    app.add_option("--show", options.shown, "wrong answers to print, for each family")->capture_default_str();
    app.add_flag("--certain", options.certain,
                 "fail where an answer of the exact stage or about a mesh pair is not certain");
    CLI11_PARSE(app, argc, argv);
    return chasles::attack::attack_all(options);
}
