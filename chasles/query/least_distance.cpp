#include "chasles/query/least_distance.h"

#include "chasles/base/limit_of_thread.h"
#include "chasles/query/all_answers.h"
#include "chasles/query/pair_query.h"
#include "chasles/query/report.h"
#include "chasles/query/requirements.h"
#include "chasles/query/swap_roles.h"
#include "chasles/search/descent.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace chasles {

namespace {

using query::ContactMoment;
using search::NearMoment;
using search::PieceContext;
using search::PieceResult;

/// One question. A descent gives an upper bound. A search with a margin just below the bound proves that nothing comes
/// nearer. If it finds something that does, a descent from there gives a smaller bound for the next search.
/// Source: docs/derivations/21-least-distance.md.
class LeastDistanceSearch {
public:
    explicit LeastDistanceSearch(const query::LeastPairQuery& question);

    LeastDistance run();

private:
    /// Near features in one of the pieces.
    struct Moment {
        std::size_t piece = 0;
        NearMoment at;
    };

    void descend_from_samples();
    void descend(std::size_t piece, double tau, const contact::FeaturePair& features);
    /// The distance found.
    [[nodiscard]] double found() const { return nearest_.at.near.distance - radii_; }
    [[nodiscard]] double upper() const { return std::max(0.0, found() + rounding_); }
    [[nodiscard]] bool is_narrow() const {
        return lower_ > 0 && upper() - lower_ <= question_.options.tolerance * upper();
    }
    [[nodiscard]] double next_level() const;
    void narrow();
    void prove_rough_brackets();
    void prove(double level);
    bool is_clear_of(double level);
    std::optional<FirstContact> first_touch();
    std::optional<PieceResult> first_within(double level);
    [[nodiscard]] LeastDistance of_touch(const FirstContact& touch) const;
    [[nodiscard]] LeastDistance of_nearest();
    void list_contacts(LeastDistance& answer, const ContactMoment& moment);

    const query::LeastPairQuery& question_;
    std::vector<PieceContext> pieces_;
    double radii_ = 0;    ///< of both bodies: distances are less than those of their polyhedra by so much
    double rounding_ = 0; ///< a bound of the rounding of distances at rest, mesh unit
    double lower_ = 0;    ///< proven
    Moment nearest_;
    int finds_ = 0;                ///< searches that found something nearer
    double clear_level_ = 0;       ///< of the last search: nothing is within it
    std::size_t clear_pieces_ = 0; ///< in so many pieces
    double clear_until_ = 0;       ///< and up to this tau of the next one
    Work work_;
};

LeastDistanceSearch::LeastDistanceSearch(const query::LeastPairQuery& question) : question_(question) {
    const auto pieces = question.trajectory.pieces();
    pieces_.reserve(pieces->size());
    for (std::size_t i = 0; i < pieces->size(); ++i) {
        const PieceContext& piece = pieces_.emplace_back(question.moving, question.fixed, pieces->at(i));
        rounding_ = std::max(rounding_, 4 * elementary::position_error<double>(piece.error_scale(0)));
    }
    radii_ = distance_of_polyhedra(question.moving, question.fixed, 0);
    constexpr double rounding_of_sums = 0x1p-51;
    rounding_ += rounding_of_sums * radii_;
    nearest_.at.near.distance = std::numeric_limits<double>::infinity();
}

/// At the limit of the thread, what is known so far.
LeastDistance LeastDistanceSearch::run() {
    const std::optional<FirstContact> touch = first_touch();
    const bool touches = touch && touch->verdict != Verdict::clear;
    if (touches && touch->certain)
        return of_touch(*touch);
    descend_from_samples();
    if (touches)
        return of_touch(*touch);
    if (touch)
        narrow();
    return of_nearest();
}

/// The bracket of the distance, until it is narrow or the limit is reached.
void LeastDistanceSearch::narrow() {
    constexpr int most_searches = 64;
    try {
        prove_rough_brackets();
        for (int searches = 0; !is_narrow() && next_level() > 0 && searches < most_searches; ++searches)
            prove(next_level());
    } catch (const search::Stopped&) {
    }
}

/// The narrow bracket of surfaces that stay near each other takes far longer than a rough one. It may come too late.
void LeastDistanceSearch::prove_rough_brackets() {
    const Limit* const limit = LimitOfThread::get();
    if (!limit || !limit->has_end())
        return;
    for (const double share : {0.5, 0.9, 0.99})
        if (const double level = share * upper(); level < next_level())
            prove(level);
}

/// Nothing is nearer than the level, or what is nearer has been found.
void LeastDistanceSearch::prove(double level) {
    if (is_clear_of(level))
        lower_ = std::max(lower_, level);
}

void LeastDistanceSearch::descend_from_samples() {
    const auto is_enough = [&] { return std::isfinite(nearest_.at.near.distance) && is_cancelled(); };
    for (std::size_t i = 0; i < pieces_.size() && !is_enough(); ++i)
        if (const auto near = search::nearest_of_samples(pieces_[i], nearest_.at.near.distance, work_))
            nearest_ = {i, *near};
    descend(nearest_.piece, nearest_.at.tau, nearest_.at.near.features);
}

/// To the end of a piece and on.
void LeastDistanceSearch::descend(std::size_t piece, double tau, const contact::FeaturePair& features) {
    const NearMoment found = search::local_minimum(pieces_[piece], tau, features, work_);
    if (found.near.distance < nearest_.at.near.distance)
        nearest_ = {piece, found};
}

/// Just below the upper bound, and below the least distance found, whose rounding is far below its bound. Where many
/// searches found something nearer, levels fall faster and faster.
double LeastDistanceSearch::next_level() const {
    constexpr int patience = 8;
    const double step = std::ldexp(question_.options.tolerance, std::max(0, finds_ - patience));
    const double below = found() - rounding_ / 8;
    const double level = std::min(upper() * (1 - 0.875 * step), below * (1 - 0.25 * step));
    return finds_ < patience ? level : std::max(level, 0.5 * (lower_ + upper()));
}

/// Whether the bodies are proven to stay farther apart than the level. If not, goes on to where they come nearer.
bool LeastDistanceSearch::is_clear_of(double level) {
    const auto found = first_within(level);
    if (!found)
        return true;
    ++finds_;
    for (const search::Candidate& candidate : found->candidates) {
        if (is_cancelled())
            break;
        descend(clear_pieces_, candidate.tau.lower, candidate);
    }
    return false;
}

/// Empty at the limit.
std::optional<FirstContact> LeastDistanceSearch::first_touch() {
    const QueryOptions options{.time_tolerance = question_.options.time_tolerance, .find = question_.options.find};
    FirstContact touch = query::answer_or_unknown({question_.moving, question_.fixed, question_.trajectory, options});
    work_ += touch.work;
    return touch.verdict == Verdict::unknown ? std::nullopt : std::optional(std::move(touch));
}

/// What comes within the level first, from where larger levels are not yet excluded.
std::optional<PieceResult> LeastDistanceSearch::first_within(double level) {
    if (level > clear_level_) {
        clear_pieces_ = 0;
        clear_until_ = 0;
    }
    clear_level_ = level;
    for (; clear_pieces_ < pieces_.size(); ++clear_pieces_, clear_until_ = 0) {
        PieceContext& context = pieces_[clear_pieces_];
        search::SearchOptions options;
        options.tolerance = 0x1p-20;
        options.margin = distance_of_polyhedra(question_.moving, question_.fixed, level);
        options.check_start = clear_pieces_ == 0;
        options.from = clear_until_;
        PieceResult result = search_piece(context, options);
        work_ += result.work;
        if (query::has_contact(result)) {
            constexpr double grid = 0x1p20;
            clear_until_ = std::max(clear_until_, std::floor(query::enclosing(result).lower * grid) / grid);
            return result;
        }
    }
    return std::nullopt;
}

LeastDistance LeastDistanceSearch::of_touch(const FirstContact& touch) const {
    LeastDistance answer;
    answer.distance = {0, touch.certain ? 0 : upper()};
    answer.time = touch.time;
    answer.tau = touch.tau;
    answer.certain = touch.certain;
    answer.contacts = touch.contacts;
    answer.contacts_cut = touch.contacts_cut;
    answer.overlap = touch.overlap;
    answer.inside = touch.inside;
    answer.pose = touch.pose;
    answer.fixed_pose = touch.fixed_pose;
    answer.work = work_;
    return answer;
}

LeastDistance LeastDistanceSearch::of_nearest() {
    PieceContext& context = pieces_[nearest_.piece];
    const motion::AnyPiece& piece = context.piece();
    const double tau = nearest_.at.tau;
    LeastDistance answer;
    answer.distance = {lower_, upper()};
    answer.time = piece.time_of({tau, tau});
    answer.tau = piece.tau_of({tau, tau});
    answer.certain = is_narrow();
    answer.pose = piece.pose_at(tau);
    answer.fixed_pose = piece.fixed_pose_at(tau);
    list_contacts(answer, ContactMoment(context, tau, false, nearest_.at.near.distance, 0));
    answer.work = work_;
    return answer;
}

/// The features whose nearest points are inside them. A search that is cut, or that rounding keeps from a rim, may list
/// none: then those of the descent, which may have stopped at a face beside one of its edges.
void LeastDistanceSearch::list_contacts(LeastDistance& answer, const ContactMoment& moment) {
    constexpr std::size_t enough_for_one = 16;
    const bool lists_all = question_.options.find == Find::first_with_all_contacts;
    search::NearSearch search;
    if (!lists_all)
        search.most_pairs = enough_for_one;
    search::NearFeatures near = moment.find(search);
    work_ += near.work;
    if (near.pairs.empty())
        near.pairs = {moment.nearest_parts(nearest_.at.near.features)};
    answer.contacts = moment.contacts_of(near.pairs);
    answer.contacts_cut = lists_all && (query::cut_to_most(answer.contacts) || near.is_cut);
    if (!lists_all)
        answer.contacts.resize(1);
}

} // namespace

LeastDistance query::answer(const LeastPairQuery& query) {
    require_near(query.moving, query.fixed, query.trajectory);
    return LeastDistanceSearch(query).run();
}

LeastDistance least_distance(const LeastDistanceQuery& query) {
    query::check_options(query.options);
    return query::answer({query.moving.body(), query.fixed.body(), query.motion.trajectory(), query.options});
}

std::vector<LeastDistance> least_distance_batch(const LeastDistanceBatchQuery& query) {
    query::check_options(query.options);
    const Body& moving = query.moving.body();
    const Body& fixed = query.fixed.body();
    query::require_near(moving, fixed, query.motions);
    LeastDistance unanswered;
    unanswered.distance.upper = std::numeric_limits<double>::infinity();
    return query::all_answers<LeastDistance>(
        query.motions.size(), query.batch,
        [&](std::size_t i) {
            return query::answer({moving, fixed, query.motions[i].trajectory(), query.options});
        },
        unanswered);
}

LeastDistance LeastDistance::swapped() const {
    LeastDistance other = *this;
    query::swap_roles(other);
    return other;
}

} // namespace chasles
