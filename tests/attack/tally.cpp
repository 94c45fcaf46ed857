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
    misplaced += other.misplaced;
    nested += other.nested;
    near += other.near;
    wide += other.wide;
    doubted += other.doubted;
    at_start += other.at_start;
    uncertain += other.uncertain;
    refused += other.refused;
    failed += other.failed;
    widest = std::max(widest, other.widest);
    tests += other.tests;
    refined += other.refined;
    exact += other.exact;
    seconds += other.seconds;
    reference_seconds += other.reference_seconds;
    return *this;
}

void print_header(const std::string& title) {
    std::printf("%-26s %10s %10s %7s %7s %7s %7s %7s %7s %7s %7s %7s %7s %7s %7s %9s %9s %8s %8s %8s %8s\n",
                title.c_str(), "queries", "touches", "start", "nested", "missed", "false", "late", "outside", "misnam.",
                "mispl.", "loose", "near", "wide", "doubted", "uncertain", "widest", "refined", "exact", "seconds",
                "truth");
}

void print_line(const NamedTally& one) {
    const Tally& t = one.tally;
    const auto count = [](std::uint64_t x) { return static_cast<unsigned long long>(x); };
    const auto share = [&](std::uint64_t x) { return t.tests == 0 ? 0 : 100.0 * double(x) / double(t.tests); };
    std::printf(
        "%-26s %10llu %10llu %7llu %7llu %7llu %7llu %7llu %7llu %7llu %7llu %7llu %7llu %7llu %7llu %9llu %9.1e "
        "%7.3f%% %7.3f%% "
        "%8.1f %8.1f\n",
        one.name.c_str(), count(t.queries), count(t.touches), count(t.at_start), count(t.nested), count(t.missed),
        count(t.false_alarms), count(t.late), count(t.outside), count(t.misnamed), count(t.misplaced), count(t.loose),
        count(t.near), count(t.wide), count(t.doubted), count(t.uncertain), t.widest, share(t.refined), share(t.exact),
        t.seconds, t.reference_seconds);
    std::fflush(stdout);
}

} // namespace chasles::attack
