#include "chasles/query/first_contact.h"

#include "chasles/algebra/rounding_mode.h"
#include "chasles/invalid_input.h"
#include "chasles/motion/screw_piece.h"
#include "chasles/query/contact_details.h"
#include "chasles/query/far_apart.h"

#include <Eigen/Geometry>
#include <string>
#include <tuple>

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

[[noreturn]] void refuse(const char* option, const char* why) {
    throw InvalidInput(std::string("query: ") + option + ": " + why);
}

void require(bool holds, const char* option, const char* why) {
    if (!holds)
        refuse(option, why);
}

void validate(const FirstContactQuery& query) {
    require(algebra::rounds_to_nearest(), "floating point", "must round to nearest; it is set to round otherwise");
    require(query.margin == 0, "margin", "must be 0; distances above 0 are not supported by this version");
    require(!query.hold, "hold", "must be 0; it belongs to a margin, which this version does not support");
    require(query.time_tolerance >= 1e-15 && query.time_tolerance <= 1, "time_tolerance", "must be in [1e-15, 1]");
    require(query.max_turn >= ScrewMotion::least_max_turn, "max_turn",
            "must be at least 1e-4 radians (0.00573 degrees)");
}

/// One query, piece by piece.
class Query {
public:
    explicit Query(const FirstContactQuery& query) : query_(query) {}

    /// `piece_at` gives the pieces of the motion in order.
    template <class PieceAt>
    FirstContact answer(std::size_t count, PieceAt piece_at) const {
        FirstContact found;
        for (std::size_t i = 0; i < count; ++i) {
            const auto& piece = piece_at(i);
            const double tolerance = query_.time_tolerance * double(count) / greatest_time_rate(piece);
            const query::PieceResult result = query::search_piece(
                {query_.moving, query_.fixed, piece.frame(), std::min(tolerance, 1.0), query_.find, i == 0});
            found.work += result.work;
            if (result.overlap || !result.candidates.empty()) {
                report(found, piece, {i, count}, result);
                return found;
            }
            if (i + 1 == count)
                found.pose = piece.pose_at(1);
        }
        return found;
    }

private:
    /// tau as a function of time is convex, so that dtime/dtau is greatest at tau = 0.
    template <class AnyMotion>
    static double greatest_time_rate(const AnyMotion& piece) {
        return std::max(1.0, 1 / piece.tau_rate(0));
    }

    template <class AnyMotion>
    void report(FirstContact& found, const AnyMotion& piece, const PieceClock& clock,
                const query::PieceResult& result) const {
        const Bracket tau = result.overlap ? Bracket{0, 0} : enclosing(result);
        const double tiny = tau.upper > 0 ? underflow_slack : 0;
        found.tau = {std::max(0.0, clock.whole(tau.lower) * (1 - clock_slack)),
                     std::min(1.0, clock.whole(tau.upper) * (1 + clock_slack) + tiny)};
        found.time = {std::max(0.0, clock.whole(piece.time_at(tau.lower)) * (1 - clock_slack)),
                      std::min(1.0, clock.whole(piece.time_at(tau.upper)) * (1 + clock_slack) + tiny)};
        found.certain = result.overlap ? result.overlap->certain : is_certain(result.candidates, tau);
        found.verdict = clock.index == 0 && query::may_be_at_start({tau.lower, tau.upper, found.certain})
                            ? Verdict::contact_at_start
                            : Verdict::contact;
        found.pose = piece.pose_at(piece.time_at(tau.lower));
        const Eigen::Isometry3d to_world = piece.frame().fixed_pose_at(piece.time_at(tau.lower)).isometry();
        found.overlap = result.overlap;
        if (found.overlap) {
            found.overlap->point = query::product(to_world.linear(), found.overlap->point) + to_world.translation();
            name_face(found.overlap->face, found.overlap->edge_is_moving ? query_.fixed : query_.moving);
        }
        const double rate = piece.tau_rate(tau.lower) * double(clock.count);
        const query::ContactDetails details(query_.moving, query_.fixed, motion::double_maps(piece.frame().motion),
                                            tau.lower, found.verdict == Verdict::contact_at_start);
        for (const query::Candidate& candidate : reported(result.candidates)) {
            Contact contact = details.describe(candidate);
            contact.point = query::product(to_world.linear(), contact.point) + to_world.translation();
            contact.normal = query::product(to_world.linear(), contact.normal);
            contact.approach_speed *= rate;
            name_faces(contact);
            found.contacts.push_back(contact);
        }
    }

    /// From the body's own numbering of faces to that of its input.
    static void name_face(Feature& feature, const Polyhedron& body) {
        feature.first = feature.second = body.source_face(feature.first);
    }
    void name_faces(Contact& contact) const {
        if (moving_feature_kind(contact.kind) == FeatureKind::face)
            name_face(contact.moving, query_.moving);
        if (fixed_feature_kind(contact.kind) == FeatureKind::face)
            name_face(contact.fixed, query_.fixed);
    }

    /// The first contact is not before any lower end nor after any upper end.
    static Bracket enclosing(const query::PieceResult& result) {
        Bracket bracket{result.open_after, 1};
        for (const query::Candidate& candidate : result.candidates) {
            bracket.lower = std::min(bracket.lower, candidate.tau.lower);
            bracket.upper = std::min(bracket.upper, candidate.tau.upper);
        }
        return bracket;
    }

    static bool is_certain(const std::vector<query::Candidate>& candidates, const Bracket& tau) {
        return std::any_of(candidates.begin(), candidates.end(), [&](const query::Candidate& candidate) {
            return candidate.tau.certain && candidate.tau.upper <= tau.upper;
        });
    }

    [[nodiscard]] std::vector<query::Candidate> reported(std::vector<query::Candidate> candidates) const {
        std::sort(candidates.begin(), candidates.end(), [](const query::Candidate& a, const query::Candidate& b) {
            const auto key = [](const query::Candidate& c) {
                return std::tuple(c.kind, c.moving.first, c.moving.second, c.fixed.first, c.fixed.second);
            };
            return key(a) < key(b);
        });
        // An edge or a vertex is met again in each interval of time that its contact borders on.
        const auto same = [](const query::Candidate& a, const query::Candidate& b) {
            return a.kind == b.kind && a.moving == b.moving && a.fixed == b.fixed;
        };
        candidates.erase(std::unique(candidates.begin(), candidates.end(), same), candidates.end());
        if (query_.find != Find::first_with_all_contacts && candidates.size() > 1) {
            const auto key = [](const query::Candidate& c) { return std::pair(!c.tau.certain, c.tau.lower); };
            const auto first =
                std::min_element(candidates.begin(), candidates.end(),
                                 [&](const query::Candidate& a, const query::Candidate& b) { return key(a) < key(b); });
            candidates = {*first};
        }
        return candidates;
    }

    const FirstContactQuery& query_;
};

const MotionEnds& ends_of(const Motion& motion) {
    return std::visit([](const auto& any) -> const MotionEnds& { return any.ends(); }, motion);
}

FirstContact clear_to_the_goal(const MotionEnds& ends) {
    FirstContact clear;
    clear.pose = ends.pose_at_end(1);
    return clear;
}

FirstContact search(const FirstContactQuery& query) {
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

FeatureKind moving_feature_kind(ContactKind kind) {
    switch (kind) {
    case ContactKind::vertex_face:
    case ContactKind::vertex_edge:
    case ContactKind::vertex_vertex:
        return FeatureKind::vertex;
    case ContactKind::edge_edge:
    case ContactKind::edge_vertex:
        return FeatureKind::edge;
    case ContactKind::face_vertex:
        break;
    }
    return FeatureKind::face;
}

FeatureKind fixed_feature_kind(ContactKind kind) {
    switch (kind) {
    case ContactKind::face_vertex:
    case ContactKind::edge_vertex:
    case ContactKind::vertex_vertex:
        return FeatureKind::vertex;
    case ContactKind::edge_edge:
    case ContactKind::vertex_edge:
        return FeatureKind::edge;
    case ContactKind::vertex_face:
        break;
    }
    return FeatureKind::face;
}

Work& Work::operator+=(const Work& other) {
    node_pairs += other.node_pairs;
    face_pairs += other.face_pairs;
    elementary_tests += other.elementary_tests;
    root_brackets += other.root_brackets;
    refined += other.refined;
    exact += other.exact;
    return *this;
}

FirstContact first_contact(const FirstContactQuery& query) {
    validate(query);
    const MotionEnds& ends = ends_of(query.motion);
    return query::are_far_apart(query.moving, query.fixed, ends) ? clear_to_the_goal(ends) : search(query);
}

} // namespace chasles
