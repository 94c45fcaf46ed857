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

/// Points of two features that are near each other, in the frame of the fixed body.
struct NearPoints : contact::NearestPoints {
    double distance = 0; ///< of the features at most, up to rounding
};

/// The nearest points of features at one moment, or at one after another. Between edges their distance may be greater
/// than the least one where an end of an edge is nearer.
class NearestAtRest {
public:
    NearPoints points(const contact::RelativeConfiguration& bodies, const contact::FeaturePair& features);

private:
    contact::LastFaceAtRest moving_face_;
    contact::LastFaceAtRest fixed_face_;
};

/// Features that are nearer to each other than `bound`. No other features are nearer than `accuracy` times their
/// distance; this is not promised where the search reaches its bound of visited nodes. Empty if it found none.
std::optional<NearestFeatures> nearest_features(const contact::RelativeConfiguration& bodies, double bound,
                                                double accuracy, Work& work);

} // namespace chasles::search
