// How near do the bodies of a scene come over time? Source: docs/derivations/39-profile.md, "Many pairs".
#include "chasles/base/limit_of_thread.h"
#include "chasles/query/pair_query.h"
#include "chasles/query/requirements.h"
#include "chasles/scene/pairs_by_distance.h"

namespace chasles {

SceneProfile Scene::profile(const ProfileOptions& options) const {
    query::check_options(options);
    SceneProfile found;
    query::LowerEnvelope envelope;
    scene::PairsByDistance pairs(*this, scene::all_pairs(*this));
    while (const auto pair = pairs.next(envelope.greatest_upper())) {
        if (!found.pairs.empty() && is_cancelled()) {
            envelope.leave(pair->bound);
            break;
        }
        const scene::Mover a = scene::mover(*this, pair->moving), b = scene::mover(*this, pair->fixed);
        const auto name = std::uint32_t(found.pairs.size());
        found.pairs.emplace_back(pair->moving, pair->fixed);
        scene::along(a, b, [&](const motion::AnyTrajectory& trajectory) {
            envelope.add(query::answer({a.shape.body(), b.shape.body(), trajectory, options, envelope}), {0, 1}, name);
        });
    }
    found.distance = envelope.result();
    found.pairs = query::used_names(found.distance.nearest, found.pairs);
    found.untested = numbers_of_untested({});
    return found;
}

} // namespace chasles
