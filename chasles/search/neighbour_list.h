// The pairs of faces that may be near each other while the moving body stays near one place, kept from search to
// search. A body that slides along another one asks many questions at nearly the same place.
// Source: docs/derivations/31-neighbour-lists.md; the idea is that of L. Verlet, "Computer experiments on classical
// fluids", 1967.
#pragma once

#include "chasles/culling/bvh_traversal.h"
#include "chasles/culling/face_separation.h"
#include "chasles/search/find.h"
#include "chasles/search/owned_pairs.h"
#include "chasles/search/piece_context.h"

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
        algebra::Vector3<double> normal{}; ///< unit up to rounding, towards the moving face; 0: none is known
        double offset = 0;                 ///< of the fixed face, along the normal
        double widest = 0;                 ///< the gap along the normal when it was found to be the widest one
    };
    /// A piece as the list sees it.
    struct Way {
        culling::IntervalEnds ends;
        double margin = 0;
        double deviation = 0; ///< of points that come within the margin, from the chords between both ends
        double rounding = 0;  ///< of positions
    };

    [[nodiscard]] Way way_of(const PieceContext& context, double margin) const;
    [[nodiscard]] double travel(const culling::MatrixPose& from, const Way& way) const;
    [[nodiscard]] double distance(const culling::MatrixPose& from, const culling::MatrixPose& to) const;
    bool reaches(const PieceContext& context, const Way& way, Work& work);
    bool make(const PieceContext& context, double reach, Work& work);
    void take(const std::vector<std::uint64_t>& found);
    void measure_gaps(const culling::MatrixPose& place);
    void place_corners(std::uint32_t face, const Way& way);
    [[nodiscard]] double gap(const Neighbours& pair, const culling::MatrixPose& pose) const;
    double least_on_way(std::size_t index, const Way& way);
    bool is_beyond(std::size_t index, double distance);
    void take_direction(std::size_t index, const algebra::Vector3<double>& direction);
    [[nodiscard]] double gap_on_way(const Neighbours& pair) const;

    const Body& moving_;
    const Body& fixed_;
    culling::FaceSeparation separation_;
    culling::MatrixPose place_;     ///< of the moving body when the list was made
    culling::MatrixPose gap_place_; ///< of the moving body when the gaps were measured
    double reach_ = 0;              ///< pairs within it at that place are listed; 0: there is no list
    double usual_travel_ = 0;       ///< of a piece
    double longest_skin_;           ///< of a list
    int pause_ = 0;                 ///< questions until the next try, after a list that was too long
    std::vector<Neighbours> pairs_; ///< ascending by faces
    std::vector<double> gaps_;      ///< of each pair along its normal
    std::size_t tests_ = 0;         ///< of pairs since the gaps were measured
    std::uint32_t placed_face_ = 0;
    std::vector<algebra::Vector3<double>> placed_; ///< corners of one moving face at both ends of the piece
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
