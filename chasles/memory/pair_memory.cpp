#include "chasles/memory/pair_memory.h"

#include "chasles/memory/neighbour_list.h"
#include "chasles/memory/orbit_filter.h"

namespace chasles {

namespace {

/// A list where it pays, and orbits otherwise.
class ListAndOrbits : public search::Memory {
public:
    ListAndOrbits(const Body& moving, const Body& fixed) : list_(moving, fixed), orbits_(moving, fixed) {}

    std::optional<std::span<const culling::NodePair>> pairs_worth_testing(const search::PieceContext& context,
                                                                          double margin,
                                                                          const culling::TimeRange& range,
                                                                          Work& work) override {
        const auto listed = list_.pairs_worth_testing(context, margin, range, work);
        return listed ? listed : orbits_.pairs_worth_testing(context, margin, range, work);
    }
    void learn(const search::PieceContext& context, const Work& work) override { orbits_.learn(context, work); }

private:
    memory::NeighbourList list_;
    memory::OrbitFilter orbits_;
};

} // namespace

PairMemory::PairMemory(const Polyhedron& moving, const Polyhedron& fixed)
    : moving_(moving), fixed_(fixed), of_searches_(std::make_unique<ListAndOrbits>(moving_.body(), fixed_.body())) {}
PairMemory::~PairMemory() = default;
PairMemory::PairMemory(PairMemory&& other) noexcept = default;
PairMemory& PairMemory::operator=(PairMemory&& other) noexcept = default;

bool PairMemory::is_of(const Polyhedron& moving, const Polyhedron& fixed) const {
    return &moving.body() == &moving_.body() && &fixed.body() == &fixed_.body();
}

} // namespace chasles
