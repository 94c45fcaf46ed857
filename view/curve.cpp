#include "view/curve.h"

#include "view/page_data.h"

namespace chasles::view {

Json curve_json(const Curve& curve) {
    const DistanceProfile& distance = curve.distance;
    Json json = {{"times", packed(distance.times)}, {"lower", packed(distance.lower)},
                 {"upper", packed(distance.upper)}, {"nearest", distance.nearest},
                 {"pairs", Json::array()},          {"margins", curve.margins}};
    for (const auto& [first, second] : curve.pairs)
        json["pairs"].push_back({first, second});
    return json;
}

} // namespace chasles::view
