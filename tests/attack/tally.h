// The counts of an attack by family, as a table.
#pragma once

#include <cstdint>
#include <string>

namespace chasles::attack {

/// Counts of one family.
struct Tally {
    std::uint64_t queries = 0;
    std::uint64_t touches = 0;      ///< by the exact reference
    std::uint64_t missed = 0;       ///< touches with the answer clear
    std::uint64_t false_alarms = 0; ///< answers contact without a touch
    std::uint64_t late = 0;         ///< the lower end is after the exact tau
    std::uint64_t outside = 0;      ///< certain, but the exact tau is outside the bracket
    std::uint64_t misnamed = 0;     ///< certain of contact_at_start, but the contact is later
    std::uint64_t nested = 0;       ///< one body is inside of the other one at the start
    std::uint64_t loose = 0;        ///< not certain, and the exact tau is after the bracket
    std::uint64_t misplaced = 0;    ///< a contact's point, normal or gap does not fit its features
    std::uint64_t near = 0;         ///< differs from the exact answer by less than the documented resolution
    std::uint64_t wide = 0;         ///< certain brackets that are wider than the time tolerance
    std::uint64_t doubted = 0;      ///< uncertain contacts that the reference proves to within a few roundings of time
    std::uint64_t at_start = 0;     ///< touches at the start
    std::uint64_t uncertain = 0;    ///< uncertain answers
    std::uint64_t refused = 0;      ///< refused meshes
    std::uint64_t failed = 0;       ///< questions that the reference or the library did not finish
    double widest = 0;              ///< widest bracket of tau of certain answers
    std::uint64_t tests = 0;        ///< elementary tests of all queries
    std::uint64_t refined = 0;      ///< tests repeated in double-double
    std::uint64_t exact = 0;        ///< tests decided in exact arithmetic
    double seconds = 0;             ///< time of the library
    double reference_seconds = 0;

    [[nodiscard]] bool is_broken() const {
        return missed + false_alarms + late + outside + misnamed + misplaced + wide + failed > 0;
    }
    /// Whether any answer is uncertain although the exact reference decides it.
    [[nodiscard]] bool is_in_doubt() const { return uncertain + loose > 0; }
    /// Whether a family has too few touches to be a useful test.
    [[nodiscard]] bool is_idle() const {
        return queries + refused >= 50 && (touches * 30 < queries || refused > queries);
    }
    Tally& operator+=(const Tally& other);
};

/// A line of the table.
struct NamedTally {
    std::string name;
    Tally tally;
};

void print_header(const std::string& title);
void print_line(const NamedTally& one);

} // namespace chasles::attack
