// What questions about the same two bodies keep for the next ones. Questions about a body that slides come at nearly
// the same place each time. Source: docs/derivations/31-neighbour-lists.md and 32-orbits.md.
#pragma once

#include "chasles/mesh/polyhedron.h"

#include <memory>

namespace chasles {

namespace search {
class Memory;
} // namespace search

/// The memory of two bodies, for one thread at a time. It changes the time that the next answers take, and no verdict.
/// Brackets of time may differ within their tolerance, and contacts may come in another order. It helps questions with
/// a margin, and screws about one axis.
///
///     PairMemory memory(nut, bolt);
///     for (...)
///         const FirstContact found = first_contact({nut, bolt, motion, options, &memory});
class CHASLES_EXPORT PairMemory {
public:
    /// Keeps handles of both bodies.
    PairMemory(const Polyhedron& moving, const Polyhedron& fixed);
    ~PairMemory();
    PairMemory(PairMemory&& other) noexcept;
    PairMemory& operator=(PairMemory&& other) noexcept;

    /// Whether it is the memory of these two, in these roles.
    [[nodiscard]] bool is_of(const Polyhedron& moving, const Polyhedron& fixed) const;

    /// Internal.
    [[nodiscard]] search::Memory& of_searches() { return *of_searches_; }

private:
    Polyhedron moving_;
    Polyhedron fixed_;
    std::unique_ptr<search::Memory> of_searches_;
};

} // namespace chasles
