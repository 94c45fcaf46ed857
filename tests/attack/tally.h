// What an attack found, family by family, as a table.
#pragma once

#include <cstdint>
#include <string>

namespace chasles::attack {

/// Counts of one family.
struct Tally {
    std::uint64_t queries = 0;
    std::uint64_t touches = 0;      ///< by the exact reference
    std::uint64_t missed = 0;       ///< a touch, answered with clear
    std::uint64_t false_alarms = 0; ///< no touch, answered with contact
    std::uint64_t late = 0;         ///< the lower end is behind the exact tau
    std::uint64_t outside = 0;      ///< certain, and the exact tau is not in the bracket
    std::uint64_t misnamed = 0;     ///< certain of contact_at_start, and it comes later
    std::uint64_t loose = 0;        ///< not certain, and the exact tau is behind the bracket
    std::uint64_t misplaced = 0;    ///< a contact's point, normal or gap does not fit its features
    std::uint64_t near = 0;         ///< another answer than the exact one, by less than the documented resolution
    std::uint64_t at_start = 0;     ///< of the touches
    std::uint64_t uncertain = 0;    ///< answers that say that they are not certain
    std::uint64_t refused = 0;      ///< meshes that are not taken
    std::uint64_t failed = 0;       ///< questions at which the reference or the library gave up
    double widest = 0;              ///< bracket of tau, of certain answers
    std::uint64_t tests = 0;        ///< elementary tests of all queries
    std::uint64_t refined = 0;      ///< of those, repeated in double-double
    std::uint64_t exact = 0;        ///< of those, decided in exact arithmetic
    double seconds = 0;             ///< of the library
    double reference_seconds = 0;

    [[nodiscard]] bool is_broken() const {
        return missed + false_alarms + late + outside + misnamed + misplaced + failed > 0;
    }
    /// Whether an answer left something open that the exact reference tells.
    [[nodiscard]] bool is_in_doubt() const { return uncertain + loose > 0; }
    /// Whether a family does not do what it is there for.
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
