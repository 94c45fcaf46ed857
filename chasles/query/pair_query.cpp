#include "chasles/query/pair_query.h"

#include "chasles/base/limit.h"
#include "chasles/contact/relative_configuration.h"
#include "chasles/culling/clearly_apart.h"
#include "chasles/culling/far_apart.h"
#include "chasles/query/report.h"
#include "chasles/query/requirements.h"

#include <algorithm>

namespace chasles::query {

namespace {

using search::PieceContext;
using search::PieceResult;

/// The pairs, unless there are too many to list.
const search::PartPairs* complete(const search::PartPairs& pairs) {
    return pairs.is_complete() ? &pairs : nullptr;
}

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

/// Something comes within the hold distance. Where both events are at once, the answer begins with the earlier one.
void set_clear_until(FirstContact& found, const motion::AnyPiece& piece, const Bracket& tau) {
    found.clear_until = piece.time_of(tau).lower;
    found.time.lower = std::min(found.time.lower, found.clear_until);
    found.tau.lower = std::min(found.tau.lower, piece.tau_of(tau).lower);
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
        : query_(query), options_(query.options), pieces_(query.trajectory.pieces()), orbits_(query.orbits) {
        if (!orbits_ && pieces_->size() > 1)
            orbits_ = &own_orbits_.emplace(query.moving, query.fixed);
    }

    FirstContact run_within(double margin);
    FirstContact run_holding();

private:
    /// The margin that bodies which start within the margin keep.
    struct HeldLevel {
        double distance = 0;
        bool is_reached = false; ///< the bodies are as near as they may be
        bool touches = false;
    };
    [[nodiscard]] HeldLevel held_level(const PieceContext& piece, const ContactMoment& start,
                                       const search::NearFeatures& near) const;
    /// One piece, or the part of it that is searched next.
    struct HeldPiece {
        PieceContext& context;
        search::PartPairs& pairs;
        bool is_first;
        double until; ///< tau after which no contact matters
    };
    [[nodiscard]] search::PartPairs pairs_of(PieceContext& piece, double margin) const {
        return {piece, {*options_.hold, margin}, {query_.neighbours, orbits_}};
    }
    void search_holding(FirstContact& found, const HeldPiece& first, double level, const ContactMoment& start);
    static bool search_holding_piece(const HeldPiece& piece, auto search_part);
    bool search_holding_part(FirstContact& found, const HeldPiece& piece, double level,
                             const search::HeldContacts& held);
    /// What comes within the level in a part.
    struct AtLevel {
        const PieceResult& result;
        const search::HeldContacts& held;
    };
    void search_new(FirstContact& found, const HeldPiece& piece, const search::SearchOptions& near,
                    const AtLevel& level) const;

    [[nodiscard]] PieceContext piece(std::size_t index) const {
        return {query_.moving, query_.fixed, pieces_->at(index)};
    }
    [[nodiscard]] search::SearchOptions search_of(const PieceContext& piece, double margin) const {
        search::SearchOptions search;
        search.tolerance = piece.piece().tau_tolerance(options_.time_tolerance);
        search.finds_any = options_.find == Find::any;
        search.margin = margin;
        search.neighbours = query_.neighbours;
        search.orbits = orbits_;
        return search;
    }
    [[nodiscard]] double resting_slack(const PieceContext& piece) const;
    [[nodiscard]] double least_distance(const ContactMoment& start, const search::NearFeatures& near) const;

    const PairQuery& query_;
    const QueryOptions& options_;
    std::unique_ptr<const motion::AnyPieces> pieces_;
    std::optional<search::OrbitFilter> own_orbits_;
    search::OrbitFilter* orbits_;
};

FirstContact PieceByPiece::run_within(double margin) {
    FirstContact found;
    for (std::size_t i = 0; i < pieces_->size(); ++i) {
        PieceContext context = piece(i);
        if (i > 0 && context.piece().time_of({0, 0}).lower > query_.until)
            break;
        search::SearchOptions search = search_of(context, margin);
        search.check_start = i == 0;
        search.until = tau_after(context.piece(), query_.until);
        const PieceResult result = search_within_limit(context, search);
        found.work += result.work;
        if (has_contact(result)) {
            report(found, context, result, {options_, i == 0, search.margin});
            found.clear_until = options_.find == Find::any ? context.piece().time_of({0, 0}).lower : found.time.lower;
            return found;
        }
    }
    set_clear(found, query_.trajectory, query_.until);
    return found;
}

/// Bodies that start within the margin may move on; their contacts count where they come within a smaller distance. New
/// contacts, which are local minima of the distance, count at the margin where the maps of a piece are the motion.
/// Source: docs/derivations/17-hold.md.
FirstContact PieceByPiece::run_holding() {
    PieceContext first_piece = piece(0);
    // A motion that stopped at the margin ended within it, up to rounding.
    const ContactMoment start(first_piece, 0, true, options_.margin + resting_slack(first_piece), 0);
    search::PartPairs pairs = pairs_of(first_piece, start.scene().margin + start.scene().slack);
    const search::NearFeatures near =
        start.find({.finds_overlaps = true, .neighbours = query_.neighbours, .pairs = complete(pairs)});
    const bool is_held = near.overlap || (!near.pairs.empty() && near.complete_within > 0);
    FirstContact found = is_held ? FirstContact() : run_within(options_.margin);
    found.work += near.work;
    found.work += pairs.take_work();
    if (!is_held)
        return found;
    const HeldLevel level = held_level(first_piece, start, near);
    if (level.touches) {
        report(found, first_piece, contact_of(near), {options_, true, options_.margin});
        return found;
    }
    found.held = start.contacts_of(near.pairs);
    found.contacts_cut = cut_to_most(found.held) || near.is_cut;
    search_holding(found, {first_piece, pairs, true, tau_after(first_piece.piece(), query_.until)}, level.distance,
                   start);
    if (level.is_reached && found.clear_until < query_.until)
        found.clear_until = 0;
    return found;
}

/// `hold` and a small reserve, which is given up where the bodies are that near by rounding; their distance at the
/// start where that is less.
PieceByPiece::HeldLevel PieceByPiece::held_level(const PieceContext& piece, const ContactMoment& start,
                                                 const search::NearFeatures& near) const {
    if (near.overlap)
        return {0, true, true};
    const double rounding = resting_slack(piece);
    const double distance = least_distance(start, near);
    if (distance <= rounding)
        return {0, true, true};
    if (*options_.hold == 0)
        return {0, false, false};
    for (const int reserve : {2, 1, 0})
        if (const double level = *options_.hold + reserve * rounding; level <= distance - rounding / 2)
            return {level, reserve < 2, false};
    return {distance - rounding, true, false};
}

/// The first event, and how long nothing comes within `level`, which may be later than the event.
void PieceByPiece::search_holding(FirstContact& found, const HeldPiece& first, double level,
                                  const ContactMoment& start) {
    const search::HeldContacts held(start.scene());
    const auto search_part = [&](const HeldPiece& piece) { return search_holding_part(found, piece, level, held); };
    bool is_over = search_holding_piece(first, search_part);
    for (std::size_t i = 1; i < pieces_->size() && !is_over; ++i) {
        PieceContext context = piece(i);
        if (context.piece().time_of({0, 0}).lower > query_.until)
            break;
        search::PartPairs pairs = pairs_of(context, start.scene().margin + start.scene().slack);
        is_over = search_holding_piece({context, pairs, false, tau_after(context.piece(), query_.until)}, search_part);
    }
    if (is_over)
        return;
    if (found.verdict == Verdict::unknown)
        set_clear(found, query_.trajectory, query_.until);
    found.clear_until = query_.until;
}

/// Part by part. True as soon as something comes within the level.
bool PieceByPiece::search_holding_piece(const HeldPiece& piece, auto search_part) {
    do
        if (search_part(piece))
            return true;
    while (piece.pairs.part().upper < piece.until && piece.pairs.go_on());
    return false;
}

/// True when something comes within the level. Searches the rest of the piece if there are too many pairs to list.
bool PieceByPiece::search_holding_part(FirstContact& found, const HeldPiece& piece, double level,
                                       const search::HeldContacts& held) {
    search::SearchOptions near = search_of(piece.context, level);
    near.check_start = false;
    near.finds_any = false; // `clear_until` needs the first
    near.pairs = complete(piece.pairs);
    near.from = piece.pairs.part().lower;
    near.until = std::min(piece.until, piece.pairs.part().upper);
    const PieceResult at_level = search_within_limit(piece.context, near);
    found.work += piece.pairs.take_work();
    found.work += at_level.work;
    if (found.verdict == Verdict::unknown)
        search_new(found, piece, near, {at_level, held});
    if (has_contact(at_level))
        set_clear_until(found, piece.context.piece(), enclosing(at_level));
    return has_contact(at_level);
}

/// Reports the first event of a part: a new contact, which begins before something comes within the level, or this.
void PieceByPiece::search_new(FirstContact& found, const HeldPiece& piece, const search::SearchOptions& near,
                              const AtLevel& level) const {
    const auto& [at_level, held] = level;
    search::SearchOptions far = near;
    far.margin = options_.margin;
    far.held = &held;
    if (has_contact(at_level))
        far.until = enclosing(at_level).upper;
    const bool tells_new = !query_.trajectory.is_of_enclosed_kind();
    const PieceResult new_contacts = tells_new ? search_within_limit(piece.context, far) : PieceResult();
    found.work += new_contacts.work;
    const bool is_new = has_contact(new_contacts) &&
                        (!has_contact(at_level) || enclosing(new_contacts).upper < enclosing(at_level).upper);
    if (is_new || has_contact(at_level))
        report(found, piece.context, is_new ? new_contacts : at_level,
               {options_, piece.is_first, is_new ? far.margin : near.margin, is_new ? &held : nullptr, near.pairs});
}

/// A hundred times as much as the rounding of poses to doubles moves bodies.
double PieceByPiece::resting_slack(const PieceContext& piece) const {
    constexpr double rounding_of_poses = 0x1p-44;
    return rounding_of_poses * piece.error_scale(options_.margin).length;
}

/// The least distance at the start, which is one of the local minima.
double PieceByPiece::least_distance(const ContactMoment& start, const search::NearFeatures& near) const {
    double least = near.is_cut ? std::min(near.complete_within, options_.margin) : options_.margin;
    for (const contact::FeaturePair& features : near.pairs)
        least = std::min(least, start.scene().bodies.nearest(features).apart().norm());
    return least;
}

} // namespace

FirstContact answer(const PairQuery& query) {
    const auto& [moving, fixed, trajectory, options, until, neighbours, orbits] = query;
    require_near(moving, fixed, trajectory);
    if (culling::are_far_apart(moving, fixed, trajectory, options.margin) ||
        culling::are_clearly_apart(moving, fixed, trajectory, options.margin)) {
        FirstContact clear;
        set_clear(clear, trajectory, until);
        return clear;
    }
    PieceByPiece pieces(query);
    return query.options.hold ? pieces.run_holding() : pieces.run_within(query.options.margin);
}

FirstContact answer_or_unknown(const PairQuery& query) {
    try {
        return answer(query);
    } catch (const Cancelled& cancelled) {
        FirstContact found;
        found.clear_until = std::min(cancelled.clear_until, query.until);
        found.pose = query.trajectory.pose_at(found.clear_until);
        found.fixed_pose = query.trajectory.fixed_pose_at(found.clear_until);
        return found;
    }
}

} // namespace chasles::query
