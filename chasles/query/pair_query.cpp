#include "chasles/query/pair_query.h"

#include "chasles/base/limit.h"
#include "chasles/contact/relative_configuration.h"
#include "chasles/culling/clearly_apart.h"
#include "chasles/culling/far_apart.h"
#include "chasles/memory/orbit_filter.h"
#include "chasles/query/report.h"
#include "chasles/query/requirements.h"
#include "chasles/search/nested.h"

#include <algorithm>

namespace chasles::query {

namespace {

using search::PieceContext;
using search::PieceResult;

/// A contact at the start, made of what is near there.
PieceResult contact_of(const search::NearFeatures& near) {
    PieceResult result;
    for (const contact::FeaturePair& features : near.pairs)
        result.candidates.push_back({features, {0, 0, true}});
    result.overlap = near.overlap;
    return result;
}

/// Proven clear up to a time.
void set_clear(FirstContact& answer, const motion::AnyTrajectory& trajectory, double until) {
    answer.verdict = Verdict::clear;
    answer.certain = true;
    answer.clear_until = until;
    answer.pose = trajectory.pose_at(until);
    answer.fixed_pose = trajectory.fixed_pose_at(until);
}

/// A tau of the piece that is not before the time: a clock may run unevenly.
double tau_after(const motion::AnyPiece& piece, double time) {
    const double start = piece.time_of({0, 0}).upper;
    const double end = piece.time_of({1, 1}).lower;
    if (time >= end)
        return 1;
    const double tau = std::clamp((time - start) / (end - start), 0.0, 1.0);
    return piece.time_of({tau, tau}).lower >= time ? tau : 1;
}

/// The answer of a search of a piece. Throws Cancelled with the time that is proven.
PieceResult search_within_limit(PieceContext& context, const search::SearchOptions& options) {
    try {
        return search_piece(context, options);
    } catch (const search::Stopped& stopped) {
        throw Cancelled(context.piece().time_of({stopped.clear_until, stopped.clear_until}).lower);
    }
}

/// One question, piece by piece.
class PieceByPiece {
public:
    explicit PieceByPiece(const PairQuery& query)
        : query_(query), options_(query.options), pieces_(query.trajectory.pieces()),
          first_(query.moving, query.fixed, pieces_->at(0)), orbits_(query.moving, query.fixed),
          memory_(&query.memory == &search::no_memory() && pieces_->size() > 1 ? orbits_ : query.memory) {}

    FirstContact run();

private:
    /// What a pair is reported at.
    struct Level {
        double distance;         ///< of the polyhedra
        bool is_reached = false; ///< the bodies start as near as they may be
    };
    [[nodiscard]] std::optional<PieceResult> contact_in(PieceContext& context, search::SearchOptions options,
                                                        double until, Work& work) const;
    FirstContact run_within(double level, bool checks_start, double until);
    FirstContact run_on_surfaces();
    [[nodiscard]] FirstContact inside_at_start(const search::Nested& nested, const Work& work) const;
    FirstContact run_from_within();
    [[nodiscard]] std::optional<Level> level_of(const ContactMoment& start, const search::NearFeatures& near) const;

    [[nodiscard]] double of_polyhedra(double distance) const {
        return distance_of_polyhedra(query_.moving, query_.fixed, distance);
    }
    [[nodiscard]] double resting_slack() const;
    [[nodiscard]] double least_distance(const ContactMoment& start, const search::NearFeatures& near) const;

    const PairQuery& query_;
    const QueryOptions& options_;
    std::unique_ptr<const motion::AnyPieces> pieces_;
    PieceContext first_;
    memory::OrbitFilter orbits_; ///< of this question, from piece to piece
    search::Memory& memory_;
};

/// A body inside of the other one touches it, also where no surface does. Surfaces that meet at the start say more.
FirstContact PieceByPiece::run() {
    const std::optional<search::Nested> nested = nested_at_start(first_);
    if (!nested)
        return run_on_surfaces();
    const FirstContact met = run_within(of_polyhedra(0), true, 0);
    if (met.verdict != Verdict::contact_at_start)
        return inside_at_start(*nested, met.work);
    const bool is_answer = met.certain && options_.margin == 0 && options_.find != Find::any;
    return is_answer ? met : run_on_surfaces();
}

FirstContact PieceByPiece::run_on_surfaces() {
    return options_.hold ? run_from_within() : run_within(of_polyhedra(options_.margin), true, query_.until);
}

FirstContact PieceByPiece::inside_at_start(const search::Nested& nested, const Work& work) const {
    FirstContact found;
    found.verdict = Verdict::contact_at_start;
    found.certain = nested.certain;
    found.work = work;
    found.tau = first_.piece().tau_of({0, 0});
    found.pose = first_.piece().pose_at(0);
    found.fixed_pose = first_.piece().fixed_pose_at(0);
    const Body& body = nested.moving_is_inside ? query_.moving : query_.fixed;
    const Eigen::Isometry3d place = (nested.moving_is_inside ? found.pose : found.fixed_pose).isometry();
    found.inside = Inside{nested.moving_is_inside,
                          {nested.vertex, nested.vertex},
                          contact::product(place.linear(), body.vertices()[nested.vertex]) + place.translation()};
    return found;
}

/// A contact in a piece that begins no later than asked for: the tau of that time is rounded up. A search for any
/// contact may come upon a later one first.
std::optional<PieceResult> PieceByPiece::contact_in(PieceContext& context, search::SearchOptions options, double until,
                                                    Work& work) const {
    for (;; options.finds_any = false) {
        PieceResult result = search_within_limit(context, options);
        work += result.work;
        if (!has_contact(result))
            return std::nullopt;
        if (context.piece().time_of(enclosing(result)).lower <= until)
            return result;
        if (!options.finds_any)
            return std::nullopt;
    }
}

/// The first time at which the polyhedra are within the level. `checks_start`: they may be at time 0.
FirstContact PieceByPiece::run_within(double level, bool checks_start, double until) {
    FirstContact found;
    const bool finds_any = options_.find == Find::any && checks_start;
    const auto ends_in = [&](PieceContext& context, bool is_first) {
        const auto result = contact_in(context,
                                       {.tolerance = context.piece().tau_tolerance(options_.time_tolerance),
                                        .finds_any = finds_any,
                                        .margin = level,
                                        .check_start = checks_start && is_first,
                                        .until = tau_after(context.piece(), until),
                                        .memory = memory_},
                                       until, found.work);
        if (!result)
            return false;
        report(found, context, *result, {options_, is_first, level});
        found.clear_until = finds_any ? context.piece().time_of({0, 0}).lower : found.time.lower;
        return true;
    };
    if (ends_in(first_, true))
        return found;
    for (std::size_t i = 1; i < pieces_->size(); ++i) {
        PieceContext context(query_.moving, query_.fixed, pieces_->at(i));
        if (context.piece().time_of({0, 0}).lower > until)
            break;
        if (ends_in(context, false))
            return found;
    }
    set_clear(found, query_.trajectory, until);
    return found;
}

/// Bodies that start within the margin may move on, and are reported at a smaller level.
/// Source: docs/derivations/17-hold.md.
FirstContact PieceByPiece::run_from_within() {
    // A motion that stopped at the margin ended within it, up to rounding.
    const double margin = of_polyhedra(options_.margin);
    const ContactMoment start(first_, 0, true, margin + resting_slack(), 0);
    const search::NearFeatures near = start.find({.finds_overlaps = true, .memory = memory_});
    const bool is_within = near.overlap || (!near.pairs.empty() && near.complete_within > 0);
    const std::optional<Level> level = is_within ? level_of(start, near) : Level{margin};
    FirstContact found;
    if (level)
        found = run_within(level->distance, !is_within, query_.until);
    else
        report(found, first_, contact_of(near), {options_, true, margin});
    found.work += near.work;
    if (!is_within || !level)
        return found;
    found.held = start.contacts_of(near.pairs);
    found.contacts_cut = cut_to_nearest(found.held) || near.is_cut || found.contacts_cut;
    if (level->is_reached && found.clear_until < query_.until)
        found.clear_until = 0;
    return found;
}

/// `hold` and a small reserve, which is given up where the bodies are that near by rounding; their distance at the
/// start where that is less. Empty if they touch.
std::optional<PieceByPiece::Level> PieceByPiece::level_of(const ContactMoment& start,
                                                          const search::NearFeatures& near) const {
    if (near.overlap)
        return std::nullopt;
    const double rounding = resting_slack();
    const double distance = least_distance(start, near);
    if (distance - of_polyhedra(0) <= rounding)
        return std::nullopt;
    if (*options_.hold == 0)
        return Level{of_polyhedra(0)};
    for (const int reserve : {2, 1, 0})
        if (const double level = of_polyhedra(*options_.hold) + reserve * rounding; level <= distance - rounding / 2)
            return Level{level, reserve < 2};
    return Level{distance - rounding, true};
}

/// A hundred times as much as the rounding of poses to doubles moves bodies.
double PieceByPiece::resting_slack() const {
    constexpr double rounding_of_poses = 0x1p-44;
    return rounding_of_poses * first_.error_scale(of_polyhedra(options_.margin)).length;
}

/// The least distance of the polyhedra at the start, which is one of the local minima.
double PieceByPiece::least_distance(const ContactMoment& start, const search::NearFeatures& near) const {
    const double margin = of_polyhedra(options_.margin);
    double least = near.is_cut ? std::min(near.complete_within, margin) : margin;
    for (const contact::FeaturePair& features : near.pairs)
        least = std::min(least, start.scene().bodies.nearest(features).apart().norm());
    return least;
}

} // namespace

FirstContact answer(const PairQuery& query) {
    const auto& [moving, fixed, trajectory, options, until, memory] = query;
    require_near(moving, fixed, trajectory);
    if (culling::are_far_apart(moving, fixed, trajectory, options.margin) ||
        culling::are_clearly_apart(moving, fixed, trajectory, options.margin)) {
        FirstContact clear;
        set_clear(clear, trajectory, until);
        return clear;
    }
    return PieceByPiece(query).run();
}

FirstContact unanswered(const motion::AnyTrajectory& trajectory, double clear_until) {
    FirstContact found;
    found.clear_until = clear_until;
    found.pose = trajectory.pose_at(clear_until);
    found.fixed_pose = trajectory.fixed_pose_at(clear_until);
    return found;
}

FirstContact answer_or_unknown(const PairQuery& query) {
    try {
        return answer(query);
    } catch (const Cancelled& cancelled) {
        return unanswered(query.trajectory, std::min(cancelled.clear_until, query.until));
    }
}

} // namespace chasles::query
