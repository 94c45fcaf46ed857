#include "chasles/query/first_contact.h"

#include "chasles/algebra/rounding_mode.h"
#include "chasles/base/invalid_input.h"
#include "chasles/contact/contact_set.h"
#include "chasles/culling/far_apart.h"
#include "chasles/motion/screw_piece.h"
#include "chasles/search/near_search.h"
#include "chasles/search/piece_context.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <string>

namespace chasles {

namespace {

/// The clock of one piece of the motion: piece `index` of `count` runs over an equal part of the whole time.
struct PieceClock {
    std::size_t index = 0;
    std::size_t count = 1;

    [[nodiscard]] double whole(double part) const { return (double(index) + part) / double(count); }
};

/// Roundings of tau, of two arc tangents good to two units each, and of the sum with the piece's index: 15 of 16 units
/// at most (docs/derivations/10-error-bounds.md, "Time").
constexpr double clock_slack = 0x1p-49;
/// What is lost to underflow at most, in a tau or time that is not 0.
constexpr double underflow_slack = 0x1p-1022;

/// As far as coordinates of scenes may go (docs/decisions/0012-range-of-coordinates.md).
constexpr double greatest_margin = 1e30;

[[noreturn]] void refuse(const char* option, const char* why) {
    throw InvalidInput(std::string("query: ") + option + ": " + why);
}

void require(bool holds, const char* option, const char* why) {
    if (!holds)
        refuse(option, why);
}

void validate(const FirstContactQuery& query) {
    require(algebra::rounds_to_nearest(), "floating point", "must round to nearest; it is set to round otherwise");
    require(query.margin >= 0 && query.margin <= greatest_margin, "margin", "must be in [0, 1e30]");
    require(!query.hold || (*query.hold >= 0 && *query.hold < query.margin), "hold",
            "must be at least 0 and less than the margin");
    require(query.time_tolerance >= 1e-15 && query.time_tolerance <= 1, "time_tolerance", "must be in [1e-15, 1]");
    require(query.max_turn >= ScrewMotion::least_max_turn, "max_turn",
            "must be at least 1e-4 radians (0.00573 degrees)");
}

/// The first contact is not before any lower end nor after any upper end.
Bracket enclosing(const search::PieceResult& result) {
    if (result.overlap)
        return {0, 0};
    Bracket bracket{result.open_after, 1};
    for (const search::Candidate& candidate : result.candidates) {
        bracket.lower = std::min(bracket.lower, candidate.tau.lower);
        bracket.upper = std::min(bracket.upper, candidate.tau.upper);
    }
    return bracket;
}

bool is_certain(const std::vector<search::Candidate>& candidates, const Bracket& tau) {
    return std::ranges::any_of(candidates, [&](const search::Candidate& candidate) {
        return candidate.tau.certain && candidate.tau.upper <= tau.upper;
    });
}

bool is_contact(const search::PieceResult& result) {
    return result.overlap || !result.candidates.empty();
}

/// Proven before in doubt, then the earliest: by the end of what is proven, as that is where the answer's bracket ends.
std::pair<bool, double> rank(const search::Candidate& candidate) {
    const auto& [lower, upper, certain] = candidate.tau;
    return {!certain, certain ? upper : lower};
}

/// Of each feature pair the surest.
std::vector<search::Candidate> without_repeated(std::vector<search::Candidate> candidates) {
    const auto features = [](const search::Candidate& c) -> const contact::FeaturePair& { return c; };
    std::ranges::sort(candidates, {}, [&](const search::Candidate& c) { return std::pair(features(c), rank(c)); });
    // An edge or a vertex is met again in each interval of time that its contact borders on.
    const auto repeated = std::ranges::unique(candidates, {}, features);
    candidates.erase(repeated.begin(), repeated.end());
    return candidates;
}

const search::Candidate& first_of(const std::vector<search::Candidate>& candidates) {
    return *std::ranges::min_element(candidates, {}, rank);
}

/// One query, piece by piece.
class Query {
public:
    explicit Query(const FirstContactQuery& query)
        : query_(query), moving_(query.moving.body()), fixed_(query.fixed.body()) {}

    /// `piece_at` gives the pieces of the motion in order.
    template <class PieceAt>
    FirstContact answer(std::size_t count, PieceAt piece_at) const {
        if (query_.hold)
            return answer_holding(count, piece_at);
        return answer_within(query_.margin, count, piece_at);
    }

private:
    using PieceResult = search::PieceResult;

    template <class PieceAt>
    FirstContact answer_within(double margin, std::size_t count, PieceAt piece_at) const {
        FirstContact found;
        for (std::size_t i = 0; i < count; ++i) {
            const auto& piece = piece_at(i);
            search::PieceSearch search = search_of(piece, {i, count}, margin);
            search.check_start = i == 0;
            const PieceResult result = search_piece(search);
            found.work += result.work;
            if (is_contact(result)) {
                report(found, piece, {i, count}, result, margin);
                found.clear_until = query_.find == Find::any ? in_whole({i, count}, {0, 0}).lower : found.time.lower;
                return found;
            }
            if (i + 1 == count)
                found.pose = piece.pose_at(1);
        }
        return found;
    }

    /// Bodies that start within the margin go on; their contacts count where they come within a lesser distance. What
    /// is new, by local minima of the distance, counts at the margin. Source: docs/derivations/17-hold.md.
    template <class PieceAt>
    FirstContact answer_holding(std::size_t count, PieceAt piece_at) const {
        FirstContact found;
        const PieceResult start = contacts_at_start(piece_at(0), count);
        found.work += start.work;
        if (!start.overlap && start.candidates.empty())
            return answer_within(query_.margin, count, piece_at);
        const HeldLevel level = held_level(piece_at(0), start, count);
        if (level.touches) {
            report(found, piece_at(0), {0, count}, start, query_.margin);
            found.clear_until = 0;
            return found;
        }
        found.held = contacts_of(piece_at(0), {0, 0}, start.candidates, {0, count}, query_.margin, true);
        search_holding(found, level.distance, search::HeldContacts({start.candidates.begin(), start.candidates.end()}),
                       count, piece_at);
        if (level.is_reached && found.clear_until < 1)
            found.clear_until = 0;
        return found;
    }

    /// What bodies that start within the margin are to keep.
    struct HeldLevel {
        double distance = 0;
        bool is_reached = false; ///< they are as near as may be
        bool touches = false;
    };

    /// `hold` and a little more, less and less of it as they come nearer by rounding; what they have, if that is less
    /// yet.
    template <class AnyMotion>
    HeldLevel held_level(const AnyMotion& piece, const PieceResult& start, std::size_t count) const {
        if (start.overlap)
            return {0, true, true};
        const double rounding = resting_slack(piece, count);
        const double distance = nearest(piece, start);
        if (distance <= rounding)
            return {0, true, true};
        if (*query_.hold == 0)
            return {0, false, false};
        for (const int reserve : {2, 1, 0})
            if (const double level = *query_.hold + reserve * rounding; level <= distance - rounding / 2)
                return {level, reserve < 2, false};
        return {distance - rounding, true, false};
    }

    /// The first event, and how long nothing comes within `level`, which may be later.
    template <class PieceAt>
    void search_holding(FirstContact& found, double level, const search::HeldContacts& held, std::size_t count,
                        PieceAt piece_at) const {
        for (std::size_t i = 0; i < count; ++i) {
            const auto& piece = piece_at(i);
            search::PieceSearch search = search_of(piece, {i, count}, level);
            search.check_start = false;
            search.find = query_.find == Find::any ? Find::first : query_.find; // `clear_until` is of the first
            const PieceResult near = search_piece(search);
            found.work += near.work;
            const bool is_known = found.verdict != Verdict::clear;
            if (!is_known) {
                search.margin = query_.margin;
                search.held = &held;
                const PieceResult fresh = search_piece(search);
                found.work += fresh.work;
                const bool is_fresh =
                    is_contact(fresh) && (!is_contact(near) || enclosing(fresh).upper < enclosing(near).upper);
                if (is_fresh || is_contact(near))
                    report(found, piece, {i, count}, is_fresh ? fresh : near, is_fresh ? query_.margin : level);
            }
            if (is_contact(near)) {
                const Bracket tau = enclosing(near); // where both are at once, the answer begins with the earlier one
                found.clear_until = time_of(piece, {i, count}, tau).lower;
                found.time.lower = std::min(found.time.lower, found.clear_until);
                found.tau.lower = std::min(found.tau.lower, in_whole({i, count}, tau).lower);
                return;
            }
            if (!is_known && i + 1 == count && found.verdict == Verdict::clear)
                found.pose = piece.pose_at(1);
        }
    }

    template <class AnyMotion>
    [[nodiscard]] search::PieceSearch search_of(const AnyMotion& piece, const PieceClock& clock, double margin) const {
        // tau as a function of time is convex, so that dtime/dtau is greatest at tau = 0.
        const double greatest_rate = std::max(1.0, 1 / piece.tau_rate(0));
        const double tolerance = query_.time_tolerance * double(clock.count) / greatest_rate;
        search::PieceSearch search{moving_, fixed_, piece.frame(), std::min(tolerance, 1.0), query_.find};
        search.margin = margin;
        return search;
    }

    /// All feature pairs within the margin, and a little more: what was stopped at the margin is within it.
    template <class AnyMotion>
    PieceResult contacts_at_start(const AnyMotion& piece, std::size_t count) const {
        search::PieceSearch search = search_of(piece, {0, count}, query_.margin + resting_slack(piece, count));
        search.find = Find::first_with_all_contacts;
        search.only_start = true;
        return search_piece(search);
    }

    /// What rounding of poses to doubles moves bodies by at most, and some hundred times as much.
    template <class AnyMotion>
    [[nodiscard]] double resting_slack(const AnyMotion& piece, std::size_t count) const {
        constexpr double rounding_of_poses = 0x1p-44;
        return rounding_of_poses * search::PieceContext(search_of(piece, {0, count}, query_.margin)).scale.length;
    }

    /// The least distance at the start.
    template <class AnyMotion>
    double nearest(const AnyMotion& piece, const PieceResult& start) const {
        const contact::RelativeConfiguration instant(moving_, fixed_, motion::double_maps(piece.frame().motion), 0);
        double least = query_.margin;
        for (const search::Candidate& candidate : start.candidates)
            least = std::min(least, instant.nearest(candidate).apart().norm());
        return least;
    }

    /// A bracket of tau or of time in a piece, in terms of the whole motion.
    static Bracket in_whole(const PieceClock& clock, const Bracket& part) {
        const double tiny = part.upper > 0 ? underflow_slack : 0;
        return {std::max(0.0, clock.whole(part.lower) * (1 - clock_slack)),
                std::min(1.0, clock.whole(part.upper) * (1 + clock_slack) + tiny)};
    }

    template <class AnyMotion>
    static Bracket time_of(const AnyMotion& piece, const PieceClock& clock, const Bracket& tau) {
        return in_whole(clock, {piece.time_at(tau.lower), piece.time_at(tau.upper)});
    }

    template <class AnyMotion>
    void report(FirstContact& found, const AnyMotion& piece, const PieceClock& clock, const PieceResult& result,
                double margin) const {
        const Bracket tau = enclosing(result);
        found.tau = in_whole(clock, tau);
        found.time = time_of(piece, clock, tau);
        found.certain = result.overlap ? result.overlap->certain : is_certain(result.candidates, tau);
        const bool at_start = clock.index == 0 && search::may_be_at_start({tau.lower, tau.upper, found.certain});
        found.verdict = at_start ? Verdict::contact_at_start : Verdict::contact;
        found.pose = piece.pose_at(piece.time_at(tau.lower));
        found.overlap = result.overlap;
        if (found.overlap) {
            const Eigen::Isometry3d to_world = piece.frame().fixed_pose_at(piece.time_at(tau.lower)).isometry();
            found.overlap->point = contact::product(to_world.linear(), found.overlap->point) + to_world.translation();
            name_face(found.overlap->face, found.overlap->edge_is_moving ? fixed_ : moving_);
        }
        found.contacts = contacts_of(piece, tau, result.candidates, clock, margin, at_start);
    }

    /// In the world at the lower end of the bracket.
    template <class AnyMotion>
    std::vector<Contact> contacts_of(const AnyMotion& piece, const Bracket& tau,
                                     std::vector<search::Candidate> candidates, const PieceClock& clock, double margin,
                                     bool at_start) const {
        if (candidates.empty())
            return {};
        candidates = without_repeated(std::move(candidates));
        const search::PieceContext numbers(search_of(piece, clock, margin));
        const contact::RelativeConfiguration instant(moving_, fixed_, numbers.maps, tau.lower);
        const contact::ContactScene scene{
            instant, at_start, margin,
            contact::touch_slack(instant, numbers.scale, std::min(tau.upper - tau.lower, query_.time_tolerance))};
        const bool lists_all = query_.find == Find::first_with_all_contacts || query_.hold;
        std::vector<Contact> contacts =
            lists_all ? contact_set(scene, std::vector<contact::FeaturePair>(candidates.begin(), candidates.end()))
                      : std::vector{described(scene, first_of(candidates))};
        const Eigen::Isometry3d to_world = piece.frame().fixed_pose_at(piece.time_at(tau.lower)).isometry();
        for (Contact& contact : contacts) {
            contact.point = contact::product(to_world.linear(), contact.point) + to_world.translation();
            contact.normal = contact::product(to_world.linear(), contact.normal);
            contact.approach_speed *= piece.tau_rate(tau.lower) * double(clock.count);
            name_faces(contact);
        }
        return contacts;
    }

    /// From the body's own numbering of faces to that of its input.
    static void name_face(Feature& feature, const Body& body) {
        feature.first = feature.second = body.source_face(feature.first);
    }
    void name_faces(Contact& contact) const {
        if (moving_feature_kind(contact.kind) == FeatureKind::face)
            name_face(contact.moving, moving_);
        if (fixed_feature_kind(contact.kind) == FeatureKind::face)
            name_face(contact.fixed, fixed_);
    }

    const FirstContactQuery& query_;
    const Body& moving_;
    const Body& fixed_;
};

const MotionEnds& ends_of(const Motion& motion) {
    return std::visit([](const auto& any) -> const MotionEnds& { return any.ends(); }, motion);
}

FirstContact clear_to_the_goal(const MotionEnds& ends) {
    FirstContact clear;
    clear.pose = ends.pose_at_end(1);
    return clear;
}

FirstContact answer(const FirstContactQuery& query) {
    const Query run(query);
    if (const auto* sweep = std::get_if<SweepMotion>(&query.motion))
        return run.answer(1, [&](std::size_t) -> const SweepMotion& { return *sweep; });
    const motion::ScrewPiece whole(std::get<ScrewMotion>(query.motion).ends());
    const std::size_t count = whole.clock().piece_count(query.max_turn);
    if (count == 1)
        return run.answer(1, [&](std::size_t) -> const motion::ScrewPiece& { return whole; });
    const motion::ScrewPieces pieces(whole.frame(), count);
    return run.answer(count, [&](std::size_t i) { return motion::ScrewPiece(pieces[i]); });
}

} // namespace

FirstContact first_contact(const FirstContactQuery& query) {
    validate(query);
    const MotionEnds& ends = ends_of(query.motion);
    return culling::are_far_apart(query.moving.body(), query.fixed.body(), ends, query.margin) ? clear_to_the_goal(ends)
                                                                                               : answer(query);
}

} // namespace chasles
