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

/// What a search for the nearest features is to find, and how long it may take.
struct NearestGoal {
    double bound;        ///< of the distance
    double accuracy = 1; ///< no other features are nearer than this times the distance of those that are found
    std::uint64_t most_work = 1 << 15; ///< pairs of nodes or of faces to test. Then the accuracy is not promised
};

/// Features that are nearer to each other than the bound. Empty if the search found none.
std::optional<NearestFeatures> nearest_features(const contact::RelativeConfiguration& bodies, const NearestGoal& goal,
                                                Work& work);

} // namespace chasles::search
