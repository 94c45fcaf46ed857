// Rejects pairs of faces and features at which no new contact of a search with `hold` can begin.
// Source: docs/derivations/17-hold.md, "Before any root".
#pragma once

#include "chasles/culling/bvh_traversal.h"
#include "chasles/search/minimum_filter.h"
#include "chasles/search/piece_context.h"

namespace chasles::search {

/// The tolerance of a filter for features at a distance, beside chord deviations. It covers the roundings of
/// directions, of positions at both ends and of the chord's middle.
inline double minimum_tolerance(const elementary::ErrorScale& scale, double distance) {
    return elementary::with_underflow<double>(32 * elementary::position_error<double>(scale)) + 0x1p-30 * distance;
}

/// A new contact begins at a local minimum of the distance, which is the margin there.
class BirthFilter {
public:
    BirthFilter(const PieceContext& context, const culling::PieceParts& parts, double margin)
        : filter_(context.moving(), context.fixed()), maps_(parts),
          tolerance_(minimum_tolerance(parts.scale(), margin)) {}

    [[nodiscard]] bool may_be_in(const culling::FacePair& pair) {
        if (maps_.set(pair.interval))
            ends_ = culling::IntervalEnds(maps_.maps());
        filter_.use(ends_, tolerance_ + pair.deviation);
        return filter_.set({pair.moving, pair.fixed});
    }
    /// Of the last pair of faces.
    [[nodiscard]] bool allows(const contact::FeaturePair& features) const { return filter_.allows(features); }

private:
    MinimumFilter filter_;
    culling::PartMaps maps_;
    culling::IntervalEnds ends_;
    double tolerance_;
};

} // namespace chasles::search
