#include "tests/attack/check_margin.h"

#include "chasles/base/invalid_input.h"
#include "chasles/query/first_contact.h"
#include "tests/attack/check_inside.h"
#include "tests/attack/check_mesh.h"
#include "tests/attack/contact_geometry.h"
#include "tests/attack/piecewise_tau.h"
#include "tests/attack/two_bodies.h"
#include "tests/support/margin_reference.h"
#include "tests/support/sampled_distance.h"

#include <chrono>

namespace chasles::attack {

namespace {

using reference::MarginScene;
using reference::Surface;

/// The error bound of a distance that is not decided exactly, relative to the size of the scene.
constexpr double resolution = 1e-13;
/// The largest width of a certain bracket: the default tolerance, plus the conversion to time.
constexpr double widest_bracket = 1.1e-12;

double now() {
    return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

/// The exact answer, also for slightly larger and smaller margins.
class Truth {
public:
    explicit Truth(const MarginCase& posed)
        : posed_(posed), moving_(Surface::from_convex_faces(posed.mesh.moving.vertices, posed.mesh.moving.faces)),
          fixed_(Surface::from_convex_faces(posed.mesh.fixed.vertices, posed.mesh.fixed.faces)),
          paths_(posed.mesh.posed.paths()) {}

    [[nodiscard]] PiecewiseTau at(double margin) const {
        for (std::size_t i = 0; margin > 0 && i < paths_.size(); ++i)
            if (auto found = MarginScene(moving_, fixed_, paths_[i], margin).first_time())
                return {std::move(found), i, paths_.size()};
        return {std::nullopt, 0, paths_.size()};
    }
    [[nodiscard]] PiecewiseTau exact() const { return at(posed_.margin); }
    /// The first and the last time that an answer within the resolution may have.
    [[nodiscard]] PiecewiseTau earliest() const { return at(posed_.margin + slack()); }
    [[nodiscard]] PiecewiseTau latest() const { return at(posed_.margin - slack()); }

    [[nodiscard]] long double time_of(const PiecewiseTau& tau) const {
        return tau.time(posed_.mesh.posed.kind, paths_[tau.piece]);
    }
    /// The distance minus the margin at the tau of an answer, relative to the size of the scene.
    [[nodiscard]] double clearance_at(double tau) const {
        const double parallel_chunks = tau * double(paths_.size());
        const std::size_t piece = std::min(std::size_t(parallel_chunks), paths_.size() - 1);
        const reference::SampledDistance distance(moving_, fixed_, paths_[piece]);
        return (static_cast<double>(distance.at(parallel_chunks - double(piece))) - posed_.margin) / scene_size();
    }
    [[nodiscard]] double scene_size() const {
        double size = posed_.margin;
        for (const Shape* shape : {&posed_.mesh.moving, &posed_.mesh.fixed})
            for (const Eigen::Vector3d& v : shape->vertices)
                size = std::max(size, v.norm());
        const PosedMotion& motion = posed_.mesh.posed;
        for (const Pose* pose : {&motion.moving_start, &motion.moving_goal, &motion.fixed_start, &motion.fixed_goal})
            size = std::max(size, pose->translation.norm());
        return size;
    }

private:
    [[nodiscard]] double slack() const { return resolution * scene_size(); }

    const MarginCase& posed_;
    Surface moving_;
    Surface fixed_;
    std::vector<MotionPath<Rational>> paths_;
};

bool is_at_start(const PiecewiseTau& tau) {
    return tau.tau && tau.compared_to(0) == 0;
}

/// Compares one answer with the exact answer and counts errors.
class Judge {
public:
    Judge(const MarginCase& posed, const FirstContact& found, Tally& tally)
        : truth_(posed), exact_(truth_.exact()), found_(found), tally_(tally) {}

    std::string judged() {
        tally_.uncertain += found_.certain ? 0 : 1;
        tally_.touches += exact_.tau ? 1 : 0;
        tally_.at_start += is_at_start(exact_) ? 1 : 0;
        if (found_.verdict == Verdict::clear)
            return judged_clear();
        if (!exact_.tau)
            return judged_alarm();
        for (const std::string& wrong : {judged_start(), judged_lower(), judged_upper()})
            if (!wrong.empty())
                return wrong;
        return judged_safe_way();
    }
    [[nodiscard]] const Truth& truth() const { return truth_; }

private:
    /// Counts a difference: as an error, or as within the resolution where the answer may differ by this much.
    std::string counted(bool is_told_apart, std::uint64_t& counter, const char* what) {
        ++(is_told_apart ? counter : tally_.near);
        return is_told_apart ? what : "";
    }

    std::string judged_clear() {
        if (found_.clear_until != 1) // NOLINT: exact comparison
            return counted(true, tally_.misnamed, "clear, and clear_until is not 1");
        return exact_.tau ? counted(truth_.latest().tau.has_value(), tally_.missed, "missed") : "";
    }

    std::string judged_alarm() {
        if (found_.certain)
            return counted(true, tally_.false_alarms, "a false alarm that is certain");
        return counted(!truth_.earliest().tau, tally_.loose, "a false alarm");
    }

    std::string judged_start() {
        const bool is_told = found_.verdict == Verdict::contact_at_start;
        if (is_told == is_at_start(exact_))
            return "";
        const bool is_told_apart = is_told ? !is_at_start(truth_.earliest()) : is_at_start(truth_.latest());
        return counted(is_told_apart, tally_.misnamed,
                       is_told ? "called a contact at the start" : "not called a contact at the start");
    }

    std::string judged_lower() {
        if (exact_.compared_to(found_.tau.lower) >= 0 && truth_.time_of(exact_) >= found_.time.lower - 1e-18L)
            return "";
        if (found_.certain)
            return counted(true, tally_.late, "late, and certain");
        const PiecewiseTau latest = truth_.latest();
        return counted(latest.tau && latest.compared_to(found_.tau.lower) < 0, tally_.late, "late");
    }

    std::string judged_upper() {
        const bool behind = exact_.compared_to(found_.tau.upper) > 0 ||
                            truth_.time_of(exact_) > static_cast<long double>(found_.time.upper) + 1e-18L;
        if (found_.certain) {
            tally_.widest =
                std::max({tally_.widest, found_.tau.upper - found_.tau.lower, found_.time.upper - found_.time.lower});
            // Where the distance grazes the margin, a proof may require a wide bracket.
            if (found_.time.upper - found_.time.lower > widest_bracket && !grazes())
                return counted(true, tally_.outside, "a bracket that is certain and wide");
            return behind ? counted(true, tally_.outside, "certain of a bracket that the contact is not in") : "";
        }
        if (!behind)
            return "";
        const PiecewiseTau earliest = truth_.earliest();
        return counted(earliest.compared_to(found_.tau.upper) > 0, tally_.loose, "a bracket that ends too early");
    }

    /// Whether the distance is within the resolution of the margin from about the lower end on.
    [[nodiscard]] bool grazes() const {
        const PiecewiseTau earliest = truth_.earliest();
        return earliest.tau && truth_.time_of(earliest) <= found_.time.lower + widest_bracket;
    }

    /// Checks that clear_until is before the first contact.
    std::string judged_safe_way() {
        if (truth_.time_of(exact_) >= static_cast<long double>(found_.clear_until) - 1e-18L)
            return "";
        const PiecewiseTau latest = truth_.latest();
        return counted(found_.certain || (latest.tau && truth_.time_of(latest) < found_.clear_until), tally_.late,
                       "clear_until is behind the contact");
    }

    Truth truth_;
    PiecewiseTau exact_;
    const FirstContact& found_;
    Tally& tally_;
};

} // namespace

std::string check(const MarginCase& posed, Tally& tally) {
    const PosedMotion& motion = posed.mesh.posed;
    const auto bodies = bodies_of(posed.mesh.moving, posed.mesh.fixed, tally);
    if (!bodies)
        return "";
    const auto& [moving, fixed] = *bodies;
    const FirstContactQuery query{
        .moving = moving, .fixed = fixed, .motion = motion.motion(), .options = {.margin = posed.margin}};
    double before = now();
    const FirstContact found = first_contact(query);
    tally.seconds += now() - before;
    ++tally.queries;
    tally.tests += found.work.elementary_tests;
    tally.refined += found.work.refined;
    tally.exact += found.work.exact;
    before = now();
    Judge judge(posed, found, tally);
    std::string wrong = judge.judged();
    if (wrong.empty())
        wrong = check_inside(query, found, tally);
    if (wrong.empty() && found.certain) {
        wrong = misplaced(query, found, judge.truth().scene_size());
        tally.misplaced += wrong.empty() ? 0 : 1;
    }
    tally.reference_seconds += now() - before;
    if (!wrong.empty()) {
        char buffer[300];
        std::snprintf(
            buffer, sizeof buffer,
            "%s certain, tau in [%.17g, %.17g], time in [%.17g, %.17g], clearance %.2g of the scene at its end",
            found.certain ? "," : ", not", found.tau.lower, found.tau.upper, found.time.lower, found.time.upper,
            judge.truth().clearance_at(found.tau.upper));
        wrong += buffer;
    }
    return wrong;
}

std::string described(const MarginCase& posed) {
    char buffer[60];
    std::snprintf(buffer, sizeof buffer, "margin %a\n", posed.margin);
    return buffer + described(posed.mesh);
}

} // namespace chasles::attack
