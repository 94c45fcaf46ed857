#include "chasles/scene/nearest_pair.h"

#include "chasles/base/invalid_input.h"
#include "chasles/base/limit.h"
#include "chasles/query/nearest_of.h"
#include "chasles/query/requirements.h"

namespace chasles::scene {

namespace {

std::optional<LeastDistance> ask(query::NearestOf& nearest, const Mover& moving, const Mover& fixed) {
    return along(moving, fixed, [&](const motion::AnyTrajectory& trajectory) {
        return nearest.ask(moving.shape.body(), fixed.shape.body(), trajectory);
    });
}

} // namespace

SceneDistance nearest_pair(const Scene& scene, const NearestPairQuery& query) {
    query::check_options(query.options);
    query::NearestOf nearest(query.options);
    PairsByDistance pairs(scene, query.pairs);
    SceneDistance found;
    while (const auto pair = pairs.next(nearest.upper())) {
        if (pair->bound > Pose::largest_length)
            throw InvalidInput("distance: all objects are farther apart than 1e+30");
        try {
            auto distance = ask(nearest, mover(scene, pair->moving), mover(scene, pair->fixed));
            ++found.pairs;
            if (distance && nearest.take(std::move(*distance)))
                found.pair = {pair->moving, pair->fixed};
        } catch (const Cancelled&) {
            nearest.leave(pair->bound);
            break;
        }
    }
    found.nearest = nearest.result();
    return found;
}

} // namespace chasles::scene

namespace chasles {

SceneDistance Scene::least_distance(const LeastDistanceOptions& options) const {
    SceneDistance found = scene::nearest_pair(*this, {scene::all_pairs(*this), options});
    found.untested = numbers_of_untested({});
    return found;
}

} // namespace chasles
