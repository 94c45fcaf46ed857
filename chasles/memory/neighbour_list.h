// The pairs of faces that may be near each other while the moving body stays near one place, kept from search to
// search. A body that slides along another one asks many questions at nearly the same place.
// Source: docs/derivations/31-neighbour-lists.md; the idea is that of L. Verlet, "Computer experiments on classical
// fluids", 1967.
#pragma once

#include "chasles/culling/face_separation.h"
#include "chasles/memory/node_front.h"
#include "chasles/memory/separations.h"
#include "chasles/memory/way.h"
#include "chasles/search/find.h"
#include "chasles/search/memory.h"
#include "chasles/search/owned_pairs.h"
#include "chasles/search/piece_context.h"

#include <vector>

namespace chasles::memory {

/// A list for two bodies, which are kept by reference. For one thread.
class NeighbourList : public search::Memory {
public:
    NeighbourList(const Body& moving, const Body& fixed);

    /// Those of the whole piece, ascending. Empty if a list does not pay: the way is long, or too much is near;
    /// without a margin; or if the maps of the piece only enclose the motion.
    std::optional<std::span<const culling::NodePair>> pairs_worth_testing(const search::PieceContext& context,
                                                                          double margin,
                                                                          const culling::TimeRange& range,
                                                                          Work& work) override;

private:
    /// Two faces with a half space of the fixed body's frame that contains the fixed face.
    struct Neighbours {
        NodeFront::PairOfNodes leaves{};
        search::TwoFaces faces{};
        algebra::Vector3<float> normal{}; ///< no longer than 1, towards the moving face; 0: none is known
        culling::FaceSeparation::Axis axis = culling::FaceSeparation::no_axis; ///< of the normal
        double offset = 0;                                                     ///< of the fixed face, along the normal
        double widest = 0; ///< the gap along the normal when it was found to be the widest one

        [[nodiscard]] bool is_known() const { return normal.x != 0 || normal.y != 0 || normal.z != 0; }
    };
    /// Bounds of the gap along the normal at both ends of a way. In between, the gap on chords is linear.
    struct Gaps {
        double start;
        double end;

        [[nodiscard]] double least() const { return std::min(start, end); }
    };

    [[nodiscard]] std::size_t size() const { return pairs_.size() + front_.size(); }
    [[nodiscard]] bool is_outdated() const;
    void restart();
    void add_new();
    void find_near(const Way& way, double bound);
    void place_corners(std::uint32_t face, const Way& way);
    bool stays_apart(std::size_t index, const Way& way);
    bool finds_direction(Neighbours& pair, double distance);
    double set_direction(Neighbours& pair, const culling::FaceSeparation::Direction& direction) const;
    [[nodiscard]] Gaps gaps_of(const Neighbours& pair) const;

    const Body& moving_;
    const Body& fixed_;
    culling::FaceSeparation separation_;
    Travel travel_;
    NodeFront front_;
    std::vector<Neighbours> pairs_;              ///< of faces that the front does not keep apart
    Separations apart_;                          ///< along the normals of the pairs
    double longest_way_;                         ///< for which a list pays
    double last_use_ = 0;                        ///< the way that was travelled then
    double widest_margin_ = 0;                   ///< of all questions
    std::size_t size_at_start_ = 0;              ///< after the first question; 0 before
    int pause_ = 0;                              ///< questions until the next try, after too much was near
    std::vector<NodeFront::PairOfNodes> leaves_; ///< of pairs that are new
    std::uint32_t placed_face_ = 0;
    std::vector<algebra::Vector3<double>> placed_starts_; ///< corners of one moving face at the start of the piece
    std::vector<algebra::Vector3<double>> placed_ends_;   ///< likewise at the end; empty if the body rests
    std::vector<culling::NodePair> near_;
};

} // namespace chasles::memory
