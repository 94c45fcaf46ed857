#include "chasles/search/nearest_at_start.h"

#include "chasles/contact/near_pair.h"
#include "chasles/search/nearest_features.h"
#include "chasles/search/owned_pairs.h"

#include <algorithm>
#include <array>
#include <span>

namespace chasles::search {

namespace {

/// The faces around the vertices of a feature, which own what is beside it. Some of them if there are many.
std::vector<std::uint32_t> faces_beside(const Body& body, FeatureKind kind, const Feature& feature) {
    constexpr std::size_t many = 32;
    const std::array<std::uint32_t, 2> ends{feature.first, feature.second};
    const auto vertices = kind == FeatureKind::face ? body.face(feature.first) : std::span(ends);
    std::vector<std::uint32_t> faces;
    for (const std::uint32_t vertex : vertices)
        for (const std::uint32_t face : body.faces_around(vertex))
            if (faces.size() < many && std::ranges::find(faces, face) == faces.end())
                faces.push_back(face);
    return faces;
}

/// The features of two faces that are within the margin of a scene.
class NearPairsOfFaces {
public:
    explicit NearPairsOfFaces(const contact::ContactScene& scene) : scene_(scene), test_(scene) {}

    void find(const TwoFaces& faces) {
        for_each_owned_pair<true>(scene_.bodies.moving(), scene_.bodies.fixed(), faces, AllFeatures(), AllFeatures(),
                                  [&](const contact::FeaturePair& features) {
                                      if (test_.are_near(features))
                                          found_.push_back(features);
                                  });
    }
    [[nodiscard]] const std::vector<contact::FeaturePair>& found() const { return found_; }

private:
    const contact::ContactScene& scene_;
    contact::NearTest test_;
    std::vector<contact::FeaturePair> found_;
};

} // namespace

/// The nearest points may be on the rim of a feature, where others meet them inside.
std::vector<contact::FeaturePair> nearest_at_start(PieceContext& context, double margin, Work& work) {
    constexpr double rough = 0.5;
    constexpr std::uint64_t most_work = 1 << 12;
    const contact::RelativeConfiguration bodies = context.configuration_at(0);
    const auto nearest = nearest_features(bodies, {margin, rough, most_work}, work);
    if (!nearest)
        return {};
    const contact::ContactScene scene{bodies, true, nearest->distance,
                                      contact::touch_slack(bodies, context.error_scale(margin), 0)};
    NearPairsOfFaces pairs(scene);
    const auto& [kind, moving, fixed] = nearest->features;
    const std::vector<std::uint32_t> fixed_faces = faces_beside(bodies.fixed(), fixed_feature_kind(kind), fixed);
    for (const std::uint32_t face : faces_beside(bodies.moving(), moving_feature_kind(kind), moving))
        for (const std::uint32_t other : fixed_faces)
            pairs.find({face, other});
    return pairs.found();
}

/// Four times the bound of the roundings of both points.
bool are_within(const PieceContext& context, double tau, const contact::FeaturePair& features, double margin) {
    const contact::RelativeConfiguration bodies = context.configuration_at(tau);
    const double rounding = 4 * contact::touch_slack(bodies, context.error_scale(margin), 0);
    return NearestAtRest().points(bodies, features).distance + rounding <= margin;
}

} // namespace chasles::search
