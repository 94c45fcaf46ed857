#include "chasles/query/pair_memory.h"

#include "chasles/search/neighbour_list.h"
#include "chasles/search/orbit_filter.h"

namespace chasles {

PairMemory::PairMemory(const Polyhedron& moving, const Polyhedron& fixed)
    : moving_(moving), fixed_(fixed),
      neighbours_(std::make_unique<search::NeighbourList>(moving_.body(), fixed_.body())),
      orbits_(std::make_unique<search::OrbitFilter>(moving_.body(), fixed_.body())) {}
PairMemory::~PairMemory() = default;
PairMemory::PairMemory(PairMemory&& other) noexcept = default;
PairMemory& PairMemory::operator=(PairMemory&& other) noexcept = default;

bool PairMemory::is_of(const Polyhedron& moving, const Polyhedron& fixed) const {
    return &moving.body() == &moving_.body() && &fixed.body() == &fixed_.body();
}

} // namespace chasles
