#include "chasles/query/witnesses.h"

#include "chasles/base/limit_of_thread.h"
#include "chasles/query/report.h"
#include "chasles/search/descent.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace chasles::query {

namespace {

using contact::FeaturePair;
using search::NearMoment;
using search::PieceContext;

/// Features that are near each other in one of the pieces.
struct Place {
    std::size_t piece = 0;
    NearMoment at;

    [[nodiscard]] double distance() const { return at.near.distance; }
    [[nodiscard]] double tau() const { return at.tau; }
};

/// A part of a piece.
struct Part {
    std::size_t piece;
    Bracket taus;
};

/// One question. The least minimum known is followed to its bottom. Then everything within a level just above it is
/// looked for: at other times by searches, and in a short window about its time by the features that may come so near.
class WitnessSearch {
public:
    explicit WitnessSearch(const WitnessQuery& query);

    Witnesses run(double time);

private:
    enum class Outcome : std::uint8_t { complete, incomplete, nearer };

    [[nodiscard]] Place located(double time) const;
    [[nodiscard]] Place bottom_from(Place place);
    void set_level();
    [[nodiscard]] double most_width() const;
    [[nodiscard]] bool is_wide_enough() const;
    [[nodiscard]] std::vector<Part> window() const;
    [[nodiscard]] std::vector<Part> outside() const;
    [[nodiscard]] std::optional<Place> within_level(const Part& part);
    [[nodiscard]] std::optional<Place> within_level_outside();
    [[nodiscard]] bool is_beside(const Place& other) const;
    Outcome look_outside();
    Outcome look_inside();
    void keep(const Place& place);
    [[nodiscard]] double time_at(std::size_t piece, double tau) const;
    [[nodiscard]] Witness witness_at(const Place& place) const;

    std::vector<PieceContext> pieces_;
    double rounding_ = 0; ///< a bound of the rounding of distances at rest
    Place least_;         ///< the least minimum known
    double level_ = 0;
    double width_ = 0;          ///< half of the window about its tau
    std::vector<Place> inside_; ///< all minima in the window, the least one first
    Work work_;
};

WitnessSearch::WitnessSearch(const WitnessQuery& query) {
    const auto pieces = query.trajectory.pieces();
    pieces_.reserve(pieces->size());
    for (std::size_t i = 0; i < pieces->size(); ++i) {
        const PieceContext& piece = pieces_.emplace_back(query.moving, query.fixed, pieces->at(i));
        rounding_ = std::max(rounding_, 4 * elementary::position_error<double>(piece.error_scale(0)));
    }
}

/// Exact at both ends of the motion.
double WitnessSearch::time_at(std::size_t piece, double tau) const {
    if ((piece == 0 && tau == 0) || (piece + 1 == pieces_.size() && tau == 1))
        return tau;
    return std::clamp(pieces_[piece].piece().time_of({tau, tau}).lower, 0.0, 1.0);
}

/// The nearest features at a time.
Place WitnessSearch::located(double time) const {
    std::size_t piece = 0;
    while (piece + 1 < pieces_.size() && time_at(piece, 1) < time)
        ++piece;
    double tau = 0, end = 1;
    for (int halvings = 0; halvings < 40; ++halvings) { // the bottom is looked for afterwards
        const double middle = 0.5 * (tau + end);
        (time_at(piece, middle) < time ? tau : end) = middle;
    }
    Place place{piece, {end, {}}};
    Work work;
    const double infinity = std::numeric_limits<double>::infinity();
    const auto near = search::nearest_features(pieces_[piece].configuration_at(end), {infinity, 1}, work);
    place.at.near = *near; // every body has features
    return place;
}

/// Downhill, also from piece to piece.
Place WitnessSearch::bottom_from(Place place) {
    place.at = local_minimum(pieces_[place.piece], place.tau(), place.at.near.features, work_);
    while (!is_cancelled()) {
        const bool is_at_end = place.tau() == 1 && place.piece + 1 < pieces_.size();
        const bool is_at_start = place.tau() == 0 && place.piece > 0;
        if (!is_at_end && !is_at_start)
            break;
        Place next{is_at_end ? place.piece + 1 : place.piece - 1, {}};
        next.at = local_minimum(pieces_[next.piece], is_at_end ? 0 : 1, place.at.near.features, work_);
        if (!(next.distance() < place.distance()))
            break;
        place = next;
    }
    return place;
}

/// Above the least distance by a billionth, and by what rounding may hide. The window is narrow, but the two features
/// are farther apart than the level at its ends.
void WitnessSearch::set_level() {
    constexpr double share = 0x1p-30, narrowest = 0x1p-22;
    level_ = least_.distance() + std::max(share * least_.distance(), 4 * rounding_);
    width_ = narrowest;
    while (width_ <= most_width() && !is_wide_enough())
        width_ *= 2;
}

/// The rates of enclosed motions are less precise.
double WitnessSearch::most_width() const {
    return pieces_[least_.piece].is_enclosed() ? 0x1p-6 : 0x1p-4;
}

bool WitnessSearch::is_wide_enough() const {
    search::NearestAtRest nearest;
    for (const double tau : {least_.tau() - width_, least_.tau() + width_})
        if (tau > 0 && tau < 1 &&
            !(nearest.points(pieces_[least_.piece].configuration_at(tau), least_.at.near.features).distance > level_))
            return false;
    return true;
}

std::vector<Part> WitnessSearch::window() const {
    const double lower = least_.tau() - width_, upper = least_.tau() + width_;
    std::vector<Part> parts;
    if (lower <= 0 && least_.piece > 0)
        parts.push_back({least_.piece - 1, {1 - width_, 1}});
    parts.push_back({least_.piece, {std::max(0.0, lower), std::min(1.0, upper)}});
    if (upper >= 1 && least_.piece + 1 < pieces_.size())
        parts.push_back({least_.piece + 1, {0, width_}});
    return parts;
}

std::vector<Part> WitnessSearch::outside() const {
    const std::vector<Part> inside = window();
    std::vector<Part> parts;
    for (std::size_t piece = 0; piece < pieces_.size(); ++piece) {
        const auto found = std::ranges::find(inside, piece, &Part::piece);
        if (found == inside.end()) {
            parts.push_back({piece, {0, 1}});
            continue;
        }
        if (found->taus.lower > 0)
            parts.push_back({piece, {0, found->taus.lower}});
        if (found->taus.upper < 1)
            parts.push_back({piece, {found->taus.upper, 1}});
    }
    return parts;
}

/// What comes within the level in a part, followed to its bottom; empty if it is proven that nothing does.
std::optional<Place> WitnessSearch::within_level(const Part& part) {
    PieceContext& context = pieces_[part.piece];
    if (part.taus.lower > 0) // a search takes for granted that nothing is near there
        if (const auto near = search::nearest_features(context.configuration_at(part.taus.lower), {level_, 1}, work_))
            return bottom_from(Place{part.piece, {part.taus.lower, *near}});
    search::SearchOptions options;
    options.tolerance = 0x1p-20;
    options.margin = level_;
    options.check_start = part.piece == 0 && part.taus.lower == 0;
    options.from = part.taus.lower;
    options.until = part.taus.upper;
    const search::PieceResult result = search_piece(context, options);
    work_ += result.work;
    std::optional<Place> nearest;
    for (const search::Candidate& candidate : result.candidates)
        if (candidate.tau.lower <= part.taus.upper) {
            const Place place = bottom_from({part.piece, {candidate.tau.lower, {candidate, 0}}});
            if (!nearest || place.distance() < nearest->distance())
                nearest = place;
        }
    return nearest;
}

std::optional<Place> WitnessSearch::within_level_outside() {
    for (const Part& part : outside())
        if (const auto found = within_level(part))
            return found;
    return std::nullopt;
}

/// Whether it is in the window, or near it.
bool WitnessSearch::is_beside(const Place& other) const {
    const double tau = double(least_.piece) + least_.tau(), of_other = double(other.piece) + other.tau();
    return std::abs(tau - of_other) <= 4 * width_;
}

/// What is found beside the window may end in its minimum: then the window is too narrow.
WitnessSearch::Outcome WitnessSearch::look_outside() {
    for (; width_ <= most_width(); width_ *= 4) {
        const std::optional<Place> found = within_level_outside();
        if (!found)
            return Outcome::complete;
        if (found->distance() < least_.distance() - rounding_) {
            least_ = *found;
            return Outcome::nearer;
        }
        if (!is_beside(*found))
            break;
    }
    return Outcome::incomplete;
}

/// One minimum for two features.
void WitnessSearch::keep(const Place& place) {
    if (!(place.distance() <= level_))
        return;
    for (Place& known : inside_)
        if (known.at.near.features == place.at.near.features) {
            if (place.distance() < known.distance())
                known = place;
            return;
        }
    inside_.push_back(place);
}

WitnessSearch::Outcome WitnessSearch::look_inside() {
    constexpr std::size_t most_pairs = 256;
    inside_.clear();
    bool is_cut = false;
    for (const Part& part : window()) {
        PieceContext& context = pieces_[part.piece];
        const double tau = part.piece == least_.piece ? least_.tau() : part.piece < least_.piece ? 1 : 0;
        const ContactMoment moment(context, tau, false, level_, width_);
        search::NearFeatures near = moment.find({.most_pairs = most_pairs});
        work_ += near.work;
        is_cut = is_cut || near.is_cut;
        near.pairs.insert(near.pairs.begin(), least_.at.near.features);
        for (const FeaturePair& features : near.pairs)
            keep({part.piece, minimum_between(context, features, part.taus)});
    }
    if (inside_.empty())
        inside_.push_back(least_);
    const auto nearest = std::ranges::min_element(inside_, {}, &Place::distance);
    if (nearest->distance() < least_.distance() - rounding_) {
        least_ = *nearest;
        return Outcome::nearer;
    }
    std::rotate(inside_.begin(), nearest, nearest + 1);
    return is_cut ? Outcome::incomplete : Outcome::complete;
}

Witness WitnessSearch::witness_at(const Place& place) const {
    const PieceContext& context = pieces_[place.piece];
    const contact::RelativeConfiguration bodies = context.configuration_at(place.tau());
    const search::NearPoints points = search::NearestAtRest().points(bodies, place.at.near.features);
    const Eigen::Isometry3d to_world = context.piece().fixed_pose_at(place.tau()).isometry();
    const Eigen::Vector3d normal = points.apart().stableNormalized();
    return {time_at(place.piece, place.tau()), points.apart().stableNorm(), bodies.moved_back(points.on_moving),
            points.on_fixed, contact::product(to_world.linear(), normal)};
}

/// Each round ends at a nearer minimum, or is the last one.
Witnesses WitnessSearch::run(double time) {
    constexpr int most_rounds = 16;
    constexpr double finest = 0x1p-20; // the error of a normal
    Witnesses found;
    least_ = bottom_from(located(time));
    inside_ = {least_};
    Outcome outcome = Outcome::nearer;
    try {
        for (int round = 0; round < most_rounds && outcome == Outcome::nearer; ++round) {
            set_level();
            outcome = look_outside();
            if (outcome == Outcome::complete)
                outcome = look_inside();
        }
    } catch (const search::Stopped&) {
        outcome = Outcome::incomplete;
    }
    for (const Place& place : inside_)
        found.all.push_back(witness_at(place));
    found.are_all = outcome == Outcome::complete && !is_cancelled() && rounding_ <= finest * least_.distance();
    found.level = level_;
    return found;
}

} // namespace

Witnesses witnesses_of(const WitnessQuery& query, double time) {
    return WitnessSearch(query).run(time);
}

} // namespace chasles::query
