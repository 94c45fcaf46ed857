// The pairs of faces that may be near each other while the moving body stays near one place, kept from search to
// search. A body that slides along another one asks many questions at nearly the same place.
// Source: docs/derivations/31-neighbour-lists.md; the idea is that of L. Verlet, "Computer experiments on classical
// fluids", 1967.
#pragma once

#include "chasles/culling/bvh_traversal.h"
#include "chasles/culling/face_separation.h"
#include "chasles/search/find.h"
#include "chasles/search/node_front.h"
#include "chasles/search/owned_pairs.h"
#include "chasles/search/piece_context.h"
#include "chasles/search/separations.h"
#include "chasles/search/way.h"

#include <optional>
#include <span>
#include <vector>

namespace chasles::search {

/// A list for two bodies, which are kept by reference. For one thread. What it holds changes the time of the
/// next searches, and their brackets within the tolerance.
class NeighbourList {
public:
    NeighbourList(const Body& moving, const Body& fixed);

    /// Two faces, and a distance within which they do not come in the piece.
    struct Near {
        TwoFaces faces{};
        double least = 0;
    };

    /// All pairs of faces that may come within `margin`, positive, of each other in the piece; ascending, and valid
    /// until the next call. Empty if a list does not pay: the way is long, or too much is near; or if the maps of the
    /// piece only enclose the motion.
    std::optional<std::span<const Near>> within(const PieceContext& context, double margin, Work& work);

private:
    /// Two faces with a half space of the fixed body's frame that contains the fixed face.
    struct Neighbours {
        TwoFaces faces{};
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
    double least_on_way(std::size_t index, const Way& way);
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
    std::vector<Near> near_;
};

/// The leaf tests of pairs of faces that a list gave for `margin`, over a range of tau, instead of a traversal.
template <culling::LeafTests Leaves>
void test_pairs(const PieceContext& context, double margin, std::span<const NeighbourList::Near> pairs,
                const culling::TimeRange& range, Leaves& leaves) {
    const double deviation = context.deviation(margin, range);
    for (const auto& [faces, least] : pairs) {
        if (leaves.is_over())
            break;
        leaves.test({faces.moving, faces.fixed, range, {0, 1}, range.lower, deviation});
    }
}

} // namespace chasles::search
