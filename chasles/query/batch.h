// Many questions on all cores.
#pragma once

#include "chasles/query/first_contact.h"

#include <functional>
#include <span>

namespace chasles {

/// How to run a batch.
struct BatchOptions {
    unsigned threads = 0; ///< at most so many; 0: all cores
    /// Called now and then, from any one thread at a time, with the number of questions done; may be empty.
    std::function<void(std::size_t done)> progress = {};
};

/// Many motions of one pair of bodies.
struct BatchQuery {
    Polyhedron moving;
    Polyhedron fixed;
    std::span<const Motion> motions; ///< kept by reference
    QueryOptions options = {};
    BatchOptions batch = {};
};

/// One answer a motion, in order; the same for any number of threads. Throws InvalidInput for an option out of its
/// range, and for a motion that check_motion refuses, before any motion is answered.
CHASLES_EXPORT std::vector<FirstContact> first_contact_batch(const BatchQuery& query);

/// Many questions, each with its own bodies, motion and options. One answer a question, in order; the same for any
/// number of threads. Throws InvalidInput as first_contact does, and for a question with a memory, which serves one
/// thread; before any question is answered.
CHASLES_EXPORT std::vector<FirstContact> first_contact_batch(std::span<const FirstContactQuery> queries,
                                                             const BatchOptions& options = {});

} // namespace chasles
