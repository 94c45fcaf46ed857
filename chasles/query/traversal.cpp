#include "chasles/query/traversal.h"

#include "chasles/query/exact_stage.h"
#include "chasles/query/face_planes.h"
#include "chasles/query/time_tree.h"

#include <array>

namespace chasles::query {

namespace {

using Scalar = algebra::DoubleDouble;

/// A pair of nodes, one of each hierarchy.
struct NodePair {
    std::uint32_t moving;
    std::uint32_t fixed;
};

/// Intervals are halved where boxes travel further than this part of their size. Measured on six motions of the bunny
/// pair: about the same from 0.1 to 0.4, up to ten times the time at 1.
constexpr double travel_of_size = 0.4;
/// As short as the tolerance of the answer: not halved. So many halvings of [0, 1] lead there.
constexpr double shortest_interval = 0x1p-40;
constexpr int deepest_level = 40;

double reach(const BoxHierarchy& hierarchy) {
    const BoxNode& root = hierarchy.nodes()[0];
    double result = 0;
    for (int i = 0; i < 3; ++i) {
        const double extent = std::max(std::abs(double(root.lower[i])), std::abs(double(root.upper[i])));
        result = std::max(result, std::abs(hierarchy.centre()[i]) + extent);
    }
    return result;
}

/// One search; `run` is called once.
class Traversal {
public:
    explicit Traversal(const PieceSearch& search)
        : search_(search), exact_maps_(motion::control_maps(search.frame.motion)), maps_(motion::rounded(exact_maps_)),
          scale_(elementary::error_scale(maps_, std::max(reach(search.moving.hierarchy()), search.frame.motion.reach),
                                         reach(search.fixed.hierarchy()))),
          times_(maps_, search.moving.hierarchy().centre(), search.fixed.hierarchy().centre(), scale_),
          planes_(search.moving, search.fixed, scale_), filter_(search.moving, search.fixed, {scale_, {}}),
          refinement_(search.moving, search.fixed, {scale_, {}}), moving_nodes_(search.moving.hierarchy().nodes()),
          fixed_nodes_(search.fixed.hierarchy().nodes()) {
        refinement_.use(exact_maps_, {});
    }

    PieceResult run() {
        levels_[0] = {{0, 0}};
        search_interval(0, 0, 1);
        decide_overlaps();
        const double last = result_.overlap ? 0 : best_;
        std::erase_if(result_.candidates, [&](const Candidate& c) { return c.tau.lower > last; });
        result_.work.elementary_tests = filter_.workspace().elementary_tests;
        result_.work.root_brackets = filter_.workspace().root_brackets;
        return std::move(result_);
    }

private:
    /// All pairs of levels_[level] over one interval; those that travel too far go on to the two halves, the earlier
    /// half first, so that a contact there saves the later one.
    void search_interval(int level, double lower, double upper) {
        TimeInterval interval = times_.interval(lower, upper);
        use(interval);
        std::vector<NodePair>& stack = levels_[level];
        std::vector<NodePair>& halved = levels_[level + 1];
        halved.clear();
        while (!stack.empty() && !stop_ && lower <= best_) {
            if (best_ <= 0.5 * (lower + upper) && may_halve(interval)) { // the later half is behind a contact
                upper = 0.5 * (lower + upper);
                interval = times_.interval(lower, upper);
                use(interval);
            }
            const NodePair pair = stack.back();
            stack.pop_back();
            visit(pair, interval, stack, halved);
        }
        stack.clear();
        if (halved.empty() || stop_)
            return;
        const double middle = 0.5 * (lower + upper);
        const std::vector<NodePair> again = halved;
        search_interval(level + 1, lower, middle);
        if (stop_ || best_ < middle)
            return;
        levels_[level + 1] = again;
        search_interval(level + 1, middle, upper);
    }

    static bool may_halve(const TimeInterval& interval) { return interval.upper - interval.lower > shortest_interval; }

    /// Planes and filter refer to the interval from now on.
    void use(const TimeInterval& interval) {
        planes_.use(interval.maps);
        filter_.use(interval.maps, filter_tolerance(search_.tolerance / (interval.upper - interval.lower)));
    }

    void visit(const NodePair& pair, const TimeInterval& interval, std::vector<NodePair>& stack,
               std::vector<NodePair>& halved) {
        const BoxNode& moving = moving_nodes_[pair.moving];
        const BoxNode& fixed = fixed_nodes_[pair.fixed];
        ++result_.work.node_pairs;
        const SweptBoxes::Relation relation = interval.boxes.relation(moving, fixed);
        if (relation.apart)
            return;
        if (may_halve(interval) && relation.travel > travel_of_size * relation.size)
            halved.push_back(pair);
        else if (moving.is_leaf() && fixed.is_leaf())
            test_faces(moving.first, fixed.first, interval);
        else if (fixed.is_leaf() || (!moving.is_leaf() && side(moving) > side(fixed)))
            stack.insert(stack.end(), {{moving.first, pair.fixed}, {moving.first + 1, pair.fixed}});
        else
            stack.insert(stack.end(), {{pair.moving, fixed.first}, {pair.moving, fixed.first + 1}});
    }

    static float side(const BoxNode& node) {
        return std::max({node.upper[0] - node.lower[0], node.upper[1] - node.lower[1], node.upper[2] - node.lower[2]});
    }

    /// Features are asked about unless a face's plane keeps them apart; answers would be the same (note 13).
    void test_faces(std::uint32_t moving_face, std::uint32_t fixed_face, const TimeInterval& interval) {
        ++result_.work.face_pairs;
        const Polyhedron& moving = search_.moving;
        const Polyhedron& fixed = search_.fixed;
        const CornerSides moving_sides = planes_.sides_of_moving(moving_face, fixed_face);
        if (moving_sides.all_on_one_side())
            return;
        const CornerSides fixed_sides = planes_.sides_of_fixed(moving_face, fixed_face);
        if (fixed_sides.all_on_one_side())
            return;
        if (search_.check_start && interval.lower <= 0)
            look_for_overlap(moving_face, fixed_face);
        for (const std::uint32_t vertex : moving.owned_vertices(moving_face))
            if (moving_sides.may_meet(vertex))
                if (const auto found = filter_.vertex_face(vertex, fixed_face))
                    add({ContactKind::vertex_face, {vertex, vertex}, {fixed_face, fixed_face}, *found}, interval);
        for (const std::uint32_t vertex : fixed.owned_vertices(fixed_face))
            if (fixed_sides.may_meet(vertex))
                if (const auto found = filter_.face_vertex(moving_face, vertex))
                    add({ContactKind::face_vertex, {moving_face, moving_face}, {vertex, vertex}, *found}, interval);
        for (const Edge& moving_edge : moving.owned_edges(moving_face)) {
            if (!moving_sides.may_meet(moving_edge))
                continue;
            const auto path = filter_.path_of(moving_edge);
            for (const Edge& fixed_edge : fixed.owned_edges(fixed_face)) {
                if (!fixed_sides.may_meet(fixed_edge))
                    continue;
                if (const auto found = filter_.edge_edge(path, fixed_edge))
                    add({ContactKind::edge_edge,
                         {moving_edge.from, moving_edge.to},
                         {fixed_edge.from, fixed_edge.to},
                         *found},
                        interval);
            }
        }
    }

    /// Keeps a candidate of the filter, in terms of the whole piece, unless a later stage proves that it is none.
    void add(Candidate candidate, const TimeInterval& interval) {
        const double width = interval.upper - interval.lower;
        candidate.tau.lower = interval.lower + candidate.tau.lower * width;
        candidate.tau.upper = std::min(interval.upper, interval.lower + candidate.tau.upper * width);
        if (stop_ || candidate.tau.lower > best_)
            return;
        if (!is_decided(candidate.tau) && (is_behind_a_proven_contact(candidate.tau) || !decide(candidate)))
            return;
        result_.candidates.push_back(candidate);
        best_ = std::min(best_, candidate.tau.upper);
        if (candidate.tau.certain) {
            certain_.lower = std::min(certain_.lower, candidate.tau.lower);
            certain_.upper = std::min(certain_.upper, candidate.tau.upper);
        }
        stop_ = search_.find == Find::any || (search_.find == Find::first && may_be_at_start(candidate.tau));
    }

    /// A lower end of 0 is not enough: whether bodies touch at 0 or right after it makes another verdict.
    [[nodiscard]] bool is_decided(const FeasibleInterval& tau) const {
        return tau.certain && tau.upper - tau.lower <= search_.tolerance && tau.lower > 0;
    }

    /// What is not certain or not tight in double precision is asked again in double-double, and what still is not,
    /// exactly; false if there is no contact before best_.
    bool decide(Candidate& candidate) {
        ++result_.work.refined;
        refinement_.use(exact_maps_, refinement_tolerance(search_.tolerance, candidate.tau));
        const auto refined = first_contact_of(refinement_, candidate);
        if (!refined || refined->lower > best_)
            return false;
        candidate.tau = *refined;
        if (is_decided(candidate.tau))
            return true;
        if (is_beside_a_proven_contact(candidate.tau)) { // as it may be none, it ends nothing
            candidate.tau.upper = std::max(candidate.tau.upper, best_);
            return true;
        }
        ++result_.work.exact;
        const auto decided = exact_stage().first_contact_of(candidate, search_.tolerance);
        if (!decided)
            return false;
        if (decided->certain || decided->lower > candidate.tau.lower)
            candidate.tau = *decided;
        return candidate.tau.lower <= best_;
    }

    /// Whatever it is, it changes nothing but the list of all contacts.
    [[nodiscard]] bool is_behind_a_proven_contact(const FeasibleInterval& tau) const {
        return search_.find != Find::first_with_all_contacts && certain_.lower <= tau.lower &&
               (tau.lower > 0 || certain_.upper <= 0);
    }

    /// Whatever it is, the bracket of the answer holds a proven contact and is no wider than asked for.
    [[nodiscard]] bool is_beside_a_proven_contact(const FeasibleInterval& tau) const {
        return certain_.upper - tau.lower <= search_.tolerance && (tau.lower > 0 || certain_.upper <= 0);
    }

    ExactStage& exact_stage() {
        if (!exact_stage_)
            exact_stage_.emplace(search_.moving, search_.fixed, search_.frame);
        return *exact_stage_;
    }

    void look_for_overlap(std::uint32_t moving_face, std::uint32_t fixed_face) {
        using elementary::Ends;
        for (const Edge& edge : search_.moving.owned_edges(moving_face))
            if (filter_.moving_edge_passage(edge, fixed_face, Ends::not_proven_on_one_side))
                report_overlap({true, {edge.from, edge.to}, {fixed_face, fixed_face}, {}, false});
        for (const Edge& edge : search_.fixed.owned_edges(fixed_face))
            if (filter_.fixed_edge_passage(edge, moving_face, Ends::not_proven_on_one_side))
                report_overlap({false, {edge.from, edge.to}, {moving_face, moving_face}, {}, false});
    }

    /// An overlap ends the search: nothing is earlier. Double-double leaves doubt where an end of the edge is hardly
    /// off the face's plane, or the edge hardly within its rim.
    void report_overlap(Overlap overlap) {
        const auto passage = passage_of(refinement_, overlap, elementary::Ends::not_proven_on_one_side);
        if (!passage || stop_)
            return;
        Vector3<Scalar> point = passage->point;
        if (!overlap.edge_is_moving)
            point = search_.frame.motion.orientation * point + search_.frame.motion.origin;
        overlap.point = {double(point.x), double(point.y), double(point.z)};
        const auto proven = passage_of(refinement_, overlap, elementary::Ends::proven_opposite);
        overlap.certain = proven && proven->certain;
        if (!overlap.certain) {
            doubtful_overlaps_.push_back(overlap);
            return;
        }
        result_.overlap = overlap;
        stop_ = true;
    }

    /// Exactly, and last: where the bodies just touch at the start, their features have been found to.
    void decide_overlaps() {
        for (Overlap& overlap : doubtful_overlaps_) {
            if (result_.overlap || certain_.upper <= 0)
                return;
            ++result_.work.exact;
            if (exact_stage().passes(overlap)) {
                overlap.certain = true;
                result_.overlap = overlap;
            }
        }
    }

    const PieceSearch& search_;
    const motion::ControlMaps<Scalar> exact_maps_;
    const motion::ControlMaps<double> maps_;
    const elementary::ErrorScale scale_;
    const TimeTree times_;
    FacePlanes planes_;
    FeaturePairs<double> filter_;
    FeaturePairs<Scalar> refinement_;
    std::optional<ExactStage> exact_stage_; ///< made when it is first asked
    std::span<const BoxNode> moving_nodes_;
    std::span<const BoxNode> fixed_nodes_;
    std::array<std::vector<NodePair>, deepest_level + 2> levels_;
    double best_ = 1;       ///< an upper end of the first contact found so far
    Bracket certain_{2, 2}; ///< the least ends of contacts that are proven
    bool stop_ = false;
    std::vector<Overlap> doubtful_overlaps_;
    PieceResult result_;
};

} // namespace

PieceResult search_piece(const PieceSearch& search) {
    return Traversal(search).run();
}

} // namespace chasles::query
