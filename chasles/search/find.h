// Where a search may stop, and how much it did.
#pragma once

#include "chasles/base/export.h"

#include <cstdint>

namespace chasles {

/// Where a query may stop.
enum class Find : std::uint8_t {
    first,                   ///< the first contact and one feature pair at it
    any,                     ///< yes or no: the query stops at any contact, which need not be the earliest
    first_with_all_contacts, ///< the first contact and every feature pair in contact within the bracket
};

/// How much was done. The counters never change an answer.
struct Work {
    std::uint64_t node_pairs = 0;       ///< pairs of boxes tested over some interval of time
    std::uint64_t face_pairs = 0;       ///< pairs of leaves that reached the elementary tests
    std::uint64_t elementary_tests = 0; ///< vertex/face and edge/edge tests in double precision
    std::uint64_t root_brackets = 0;    ///< elementary tests that had to bracket roots
    std::uint64_t refined = 0;          ///< feature pairs tested again in double-double precision
    std::uint64_t exact = 0; ///< feature pairs, and edges through faces at the start, decided in exact arithmetic
    CHASLES_EXPORT Work& operator+=(const Work& other);
};

} // namespace chasles
