#include "tests/attack/tally.h"

#include <algorithm>
#include <cstdio>

namespace chasles::attack {

Tally& Tally::operator+=(const Tally& other) {
    queries += other.queries;
    touches += other.touches;
    missed += other.missed;
    false_alarms += other.false_alarms;
    late += other.late;
    outside += other.outside;
    misnamed += other.misnamed;
    loose += other.loose;
    uncertain += other.uncertain;
    refused += other.refused;
    widest = std::max(widest, other.widest);
    tests += other.tests;
    refined += other.refined;
    exact += other.exact;
    seconds += other.seconds;
    reference_seconds += other.reference_seconds;
    return *this;
}

namespace {

void print_line(const std::string& name, const Tally& t) {
    const auto count = [](std::uint64_t x) { return static_cast<unsigned long long>(x); };
    const auto share = [&](std::uint64_t x) { return t.tests == 0 ? 0 : 100.0 * double(x) / double(t.tests); };
    std::printf("%-26s %10llu %10llu %7llu %7llu %7llu %7llu %7llu %7llu %9llu %9.1e %7.3f%% %7.3f%% %8.1f %8.1f\n",
                name.c_str(), count(t.queries), count(t.touches), count(t.missed), count(t.false_alarms), count(t.late),
                count(t.outside), count(t.misnamed), count(t.loose), count(t.uncertain), t.widest, share(t.refined),
                share(t.exact), t.seconds, t.reference_seconds);
}

} // namespace

Tally print_table(const std::string& title, const std::vector<NamedTally>& tallies) {
    std::printf("%-26s %10s %10s %7s %7s %7s %7s %7s %7s %9s %9s %8s %8s %8s %8s\n", title.c_str(), "queries",
                "touches", "missed", "false", "late", "outside", "misnam.", "loose", "uncertain", "widest", "refined",
                "exact", "seconds", "truth");
    Tally sum;
    for (const NamedTally& one : tallies) {
        print_line(one.name, one.tally);
        sum += one.tally;
    }
    print_line("all", sum);
    std::printf("\n");
    std::fflush(stdout);
    return sum;
}

} // namespace chasles::attack
