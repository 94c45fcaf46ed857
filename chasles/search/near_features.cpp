#include "chasles/search/near_features.h"

#include "chasles/algebra/arc_tangent.h"
#include "chasles/contact/contact_set.h"
#include "chasles/contact/near_pair.h"
#include "chasles/culling/bvh_traversal.h"
#include "chasles/culling/face_planes.h"
#include "chasles/search/nearest_features.h"
#include "chasles/search/owned_pairs.h"
#include "chasles/search/start_overlaps.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace chasles::search {

namespace {

using contact::ContactScene;
using culling::CornerSides;
using Eigen::Vector3d;

/// Culls pairs of nodes in whose boxes no connection between near features is along a normal of both surfaces.
class ConeTest {
public:
    explicit ConeTest(const ContactScene& scene)
        : scene_(scene), slope_(algebra::arc_sine(std::max(scene.slopes.vertex_face, scene.slopes.others))) {}

    [[nodiscard]] bool separates(const culling::NodePair& pair) const {
        const RelativeBox moving(scene_.bodies.moving().bvh(), pair.moving);
        const RelativeBox fixed(scene_.bodies.fixed().bvh(), pair.fixed);
        const Vector3d apart = scene_.bodies.moved(moving.centre) - fixed.centre;
        const double distance = apart.norm();
        const double spread = moving.radius + fixed.radius;
        if (distance - spread <= least_distance * scene_.slack)
            return false;
        const double deviation = algebra::arc_sine(spread / distance);
        const auto excludes = [&](const NormalCone& cone, const Vector3d& along) {
            const double angle = double(cone.angle) + deviation + tolerance + slope_;
            return angle < right_angle &&
                   std::abs(cone.axis.cast<double>().dot(along)) < algebra::cosine(angle) * distance;
        };
        return excludes(scene_.bodies.fixed().normal_cones()[pair.fixed], apart) ||
               excludes(scene_.bodies.moving().normal_cones()[pair.moving], scene_.bodies.turned_back(apart));
    }

private:
    static constexpr double right_angle = 1.5707963;
    /// In radians: what counts as a local minimum at distances of at least `least_distance` slacks, and roundings.
    static constexpr double tolerance = 2e-3;
    static constexpr double least_distance = 4e3;

    struct RelativeBox {
        Vector3d centre; ///< in the frame of the body
        double radius;

        RelativeBox(const Bvh& bvh, std::uint32_t node) {
            const BoxMiddle box = middle_of(bvh.nodes()[node]);
            centre = bvh.centre() + box.centre.cast<double>();
            radius = double(box.half.norm()) * (1 + 1e-6) + 1e-7 * bvh.radius();
        }
    };

    const ContactScene& scene_;
    double slope_; ///< of what counts as a local minimum, in radians
};

/// The leaf tests of a traversal at rest.
class NearLeaves {
public:
    NearLeaves(PieceContext& context, const ContactScene& scene, const NearSearch& search)
        : context_(context), scene_(scene), search_(search), uses_cones_(scene.at_start && scene.margin > 0),
          cones_(scene), scale_(context.error_scale(0)), filter_(context.moving(), context.fixed(), scale_),
          overlaps_(context, scale_), near_test_(scene) {
        if (search.finds_overlaps)
            filter_.use(context.maps(), {});
    }

    // The functions that a traversal requires of its leaves.
    [[nodiscard]] static double best() { return 1; }
    [[nodiscard]] bool is_over() const { return found_.is_cut || overlaps_.found(); }
    /// The traversal asks this once for each pair that it visits.
    [[nodiscard]] bool is_kept_apart(const culling::NodePair& pair, double /*first*/) {
        found_.is_cut = found_.is_cut || ++visits_ > search_.most_visits;
        return uses_cones_ && cones_.separates(pair);
    }
    void test(const culling::FacePair& pair) {
        ++found_.work.face_pairs;
        const TwoFaces faces{pair.moving, pair.fixed};
        const CornerSides moving(context_.moving().face(pair.moving), moving_sides_, [&](std::uint32_t corner) {
            return near_test_.side_on_fixed_face(pair.fixed, corner);
        });
        if (moving.all_on_one_side())
            return;
        const CornerSides fixed(context_.fixed().face(pair.fixed), fixed_sides_, [&](std::uint32_t corner) {
            return near_test_.side_on_moving_face(pair.moving, corner);
        });
        if (fixed.all_on_one_side())
            return;
        if (search_.finds_overlaps && overlaps_.collect(filter_, faces))
            return;
        if (search_.finds_crossing_faces && moving.some_on_each_side() && fixed.some_on_each_side() &&
            overlaps_.collect_crossing(faces))
            return;
        const auto visit = [&](const contact::FeaturePair& features) { add(features); };
        if (scene_.margin > 0)
            for_each_owned_pair<true>(context_.moving(), context_.fixed(), faces, moving, fixed, visit);
        else
            for_each_owned_pair<false>(context_.moving(), context_.fixed(), faces, moving, fixed, visit);
    }

    NearFeatures take() {
        // No face owns an edge inside a flat part, so an overlap there may have no pair that stands for it.
        if (found_.pairs.empty() || search_.finds_overlaps)
            overlaps_.decide();
        found_.work += overlaps_.work();
        found_.overlap = overlaps_.found();
        return std::move(found_);
    }

private:
    void add(const contact::FeaturePair& features) {
        ++found_.work.elementary_tests;
        if (is_over() || !near_test_.are_in_contact(features))
            return;
        if (found_.pairs.size() < search_.most_pairs)
            found_.pairs.push_back(features);
        else
            found_.is_cut = true;
    }

    PieceContext& context_;
    const ContactScene& scene_;
    const NearSearch& search_;
    bool uses_cones_; ///< where no features are nearer than the margin, boxes tell as much
    ConeTest cones_;
    elementary::ErrorScale scale_;
    FeatureTests<double> filter_;
    StartOverlaps overlaps_;
    contact::NearTest near_test_;
    std::vector<int> moving_sides_;
    std::vector<int> fixed_sides_;
    std::uint64_t visits_ = 0;
    NearFeatures found_;
};

NearFeatures search_once(PieceContext& context, const ContactScene& scene, double tau, const NearSearch& search) {
    const double reach = scene.margin + scene.slack;
    const culling::TimeRange moment{tau, tau};
    Work work;
    const auto pairs = search.memory.pairs_worth_testing(context, reach, moment, work);
    NearLeaves leaves(context, scene, search);
    const culling::TimeTree times = context.time_tree(reach, context.parts(reach));
    culling::BvhTraversal traversal(context.moving().bvh(), context.fixed().bvh(), times, reach, false, leaves);
    work.node_pairs += pairs ? traversal.run_among(*pairs, moment) : traversal.run(moment);
    NearFeatures found = leaves.take();
    found.work += work;
    return found;
}

/// Searches within parts of a margin, of which the whole was cut.
class NearerSearch {
public:
    NearerSearch(PieceContext& context, const ContactScene& scene, double tau, const NearSearch& search)
        : context_(context), scene_(scene), tau_(tau), search_(search), least_cut_(scene.margin) {}

    /// The answer within the greatest part for which no bound of the search is reached. If all parts are cut in which
    /// something is near: the nearest features, and what was found within the smallest of these parts.
    NearFeatures run(const NearFeatures& whole) {
        nearest_ = whole;
        work_ = whole.work;
        search_above(0);
        if (!has_list_ && !nearest_.overlap)
            search_above_nearest();
        for (int i = 0; i < search_.refinements && !nearest_.overlap; ++i)
            search_within(complete_within_ + (least_cut_ - complete_within_) / 2);
        nearest_.is_cut = !nearest_.overlap || nearest_.is_cut;
        nearest_.complete_within = complete_within_;
        nearest_.work = work_;
        return nearest_;
    }

private:
    /// Within growing distances, until a search is cut.
    void search_above(double distance) {
        constexpr int doublings = 6;
        bool is_over = false;
        for (int step = doublings; step > 0 && !is_over; --step)
            is_over = search_within(distance + std::ldexp(scene_.margin - distance, -step));
    }

    /// Nothing is nearer than the nearest features, which the answer lists whatever is cut.
    void search_above_nearest() {
        constexpr std::uint64_t most_work = 1 << 18;
        Work work;
        const auto nearest = nearest_features(scene_.bodies, {scene_.margin + scene_.slack, 1, most_work}, work);
        work_ += work;
        if (!nearest)
            return;
        const auto points = NearestAtRest().points(scene_.bodies, nearest->features);
        const contact::FeaturePair features = contact::features_at(scene_, nearest->features, points);
        if (std::max(work.node_pairs, work.face_pairs) < most_work) {
            nearest_.pairs.clear();
            complete_within_ = std::max(complete_within_, nearest->distance - scene_.slack);
            search_above(std::min(nearest->distance, scene_.margin));
        }
        if (!has_list_ && std::ranges::find(nearest_.pairs, features) == nearest_.pairs.end())
            nearest_.pairs.push_back(features);
    }

    /// True if the search is over: it is cut, or there is an overlap.
    bool search_within(double margin) {
        ContactScene nearer = scene_;
        nearer.margin = margin;
        NearFeatures found = search_once(context_, nearer, tau_, search_);
        work_ += found.work;
        (found.is_cut ? least_cut_ : complete_within_) = margin;
        const bool is_over = found.is_cut || found.overlap;
        const bool is_list = !found.is_cut && !found.pairs.empty();
        if (found.overlap || is_list)
            nearest_ = std::move(found);
        else if (!has_list_ && !found.pairs.empty())
            nearest_.pairs = std::move(found.pairs); // nearer than those of a greater part
        has_list_ = has_list_ || is_list;
        return is_over;
    }

    PieceContext& context_;
    const ContactScene& scene_;
    double tau_;
    const NearSearch& search_;
    double complete_within_ = 0;
    double least_cut_;
    bool has_list_ = false; ///< all features within some part
    NearFeatures nearest_;
    Work work_;
};

} // namespace

NearFeatures near_features(PieceContext& context, const ContactScene& scene, double tau, const NearSearch& search) {
    NearFeatures near = search_once(context, scene, tau, search);
    const bool may_be_much_nearer = scene.at_start && scene.margin > 0;
    if (near.is_cut && may_be_much_nearer)
        return NearerSearch(context, scene, tau, search).run(near);
    near.complete_within = near.is_cut ? 0 : scene.margin;
    return near;
}

} // namespace chasles::search
