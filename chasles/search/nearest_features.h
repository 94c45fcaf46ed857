// The features of two bodies at rest that are nearest to each other. Source: docs/derivations/21-least-distance.md,
// "Upper bounds".
#pragma once

#include "chasles/contact/near_pair.h"
#include "chasles/search/find.h"

#include <optional>

namespace chasles::search {

/// Two features and a distance that their nearest points do not exceed.
struct NearestFeatures {
    contact::FeaturePair features;
    double distance = 0;
};

/// The nearest points of features at one moment, or at one after another. Keeps what it knows of the last faces.
class NearestAtRest {
public:
    /// Points of the features, in the frame of the fixed body.
    contact::NearestPoints points(const contact::RelativeConfiguration& bodies, const contact::FeaturePair& features);
    /// A distance that the nearest points do not exceed, up to rounding. Between edges it may be greater than the least
    /// one where an end of an edge is nearer.
    double distance(const contact::RelativeConfiguration& bodies, const contact::FeaturePair& features);

private:
    std::optional<contact::FaceAtRest> moving_face_;
    std::optional<contact::FaceAtRest> fixed_face_;
};

/// Features that are nearer to each other than `bound`. No other features are nearer than `accuracy` times their
/// distance, unless the search visits so many pairs of nodes that it stops before. Empty if it found none.
std::optional<NearestFeatures> nearest_features(const contact::RelativeConfiguration& bodies, double bound,
                                                double accuracy, Work& work);

} // namespace chasles::search
