#include "chasles/query/traversal.h"

#include "chasles/query/body_ball.h"
#include "chasles/query/face_planes.h"
#include "chasles/query/found_contacts.h"
#include "chasles/query/pair_queue.h"
#include "chasles/query/plane_between.h"
#include "chasles/query/time_tree.h"

#include <array>

namespace chasles::query {

namespace {

/// Intervals are halved for boxes of which the paths bend by more than this part of their size. Measured on the cases
/// of peers_bench: 0.05 takes twice the time for long turns of large meshes and saves a tenth on short motions.
constexpr double bend_of_size = 0.01;
/// As short as the tolerance of the answer: not halved.
constexpr double shortest_interval = 0x1p-40;

/// A node is split together with the other one unless its side is a smaller part of that one's.
constexpr float much_smaller = 0.5F;

/// The largest coordinate of a body.
double reach(const BoxHierarchy& hierarchy) {
    const BoxNode& root = hierarchy.nodes()[0];
    double result = 0;
    for (int i = 0; i < 3; ++i) {
        const double extent = std::max(std::abs(double(root.lower[i])), std::abs(double(root.upper[i])));
        result = std::max(result, std::abs(hierarchy.centre()[i]) + extent);
    }
    return result;
}

/// With all that the maps are made of.
double reach_of_moving(const PieceSearch& search) {
    return std::max(reach(search.moving.hierarchy()), search.frame.motion.reach) +
           motion::double_maps_reach(search.frame.motion);
}

TimeTree time_tree(const PieceSearch& search, const motion::ControlMaps<double>& maps,
                   const elementary::ErrorScale& scale) {
    const motion::Ball moving = ball_around(search.moving.hierarchy());
    const motion::Ball fixed = ball_around(search.fixed.hierarchy());
    return {maps, motion::PathBend(search.frame.motion, moving, fixed), moving, fixed, scale};
}

/// One search; `run` is called once.
class Traversal {
public:
    explicit Traversal(const PieceSearch& search)
        : search_(search), maps_(motion::double_maps(search.frame.motion)),
          scale_(elementary::error_scale(maps_, reach_of_moving(search), reach(search.fixed.hierarchy()))),
          times_(time_tree(search, maps_, scale_)), planes_(search.moving, search.fixed, scale_), plane_maps_(maps_),
          filter_(search.moving, search.fixed, {scale_, {}}), filter_maps_(maps_), contacts_(search, scale_),
          queue_(search.find != Find::any), moving_nodes_(search.moving.hierarchy().nodes()),
          fixed_nodes_(search.fixed.hierarchy().nodes()) {}

    PieceResult run() {
        queue_.push({0, 0, {}}); // the roots, which may well meet
        search_interval({});
        PieceResult result = contacts_.take();
        work_.elementary_tests = filter_.workspace().elementary_tests;
        work_.root_brackets = filter_.workspace().root_brackets;
        result.work += work_;
        return result;
    }

private:
    /// All pairs of the queue over one interval. Those whose paths bend too much go on to the two halves, the earlier
    /// half first, so that a contact there saves the later one.
    void search_interval(const TauRange& range) {
        const TimeInterval interval = times_.interval(range);
        std::vector<NodePair> bent;
        while (!queue_.is_empty() && !contacts_.is_over()) {
            const NodePair pair = queue_.pop();
            if (const double first = range.at(pair.when.lower);
                first <= contacts_.best() && !is_kept_apart(pair, first))
                visit(pair, interval, bent);
        }
        queue_.clear();
        const double middle = range.at(0.5);
        for (const bool later : {false, true}) {
            if (bent.empty() || contacts_.is_over() || (later && contacts_.best() < middle))
                return;
            for (const NodePair& pair : bent)
                if (const Window when = in_half(pair.when, later); !when.is_empty())
                    queue_.push({pair.moving, pair.fixed, when});
            search_interval(later ? TauRange{middle, range.upper} : TauRange{range.lower, middle});
        }
    }

    /// A window of an interval in terms of its earlier or later half. Exact, up to the ends of the half.
    static Window in_half(const Window& when, bool later) {
        const float offset = later ? 1 : 0;
        return {std::max(0.0F, 2 * when.lower - offset), std::min(1.0F, 2 * when.upper - offset)};
    }

    /// A pair that may meet: its features, or its children, or later, in halves of the interval.
    void visit(const NodePair& pair, const TimeInterval& interval, std::vector<NodePair>& bent) {
        const BoxNode& moving = moving_nodes_[pair.moving];
        const BoxNode& fixed = fixed_nodes_[pair.fixed];
        if (is_worth_halving(interval, std::max(side(moving), side(fixed)))) {
            bent.push_back(pair);
        } else if (moving.is_leaf() && fixed.is_leaf()) {
            test_faces(moving.first, fixed.first, interval.range, pair.when);
            if (contacts_.at_once() >= many_at_once_)
                look_for_plane(moving.first, fixed.first, interval.range);
        } else {
            split(pair, interval);
        }
    }

    /// Not where boxes are as wide for their roundings, which halving does not change.
    static bool is_worth_halving(const TimeInterval& interval, double side) {
        return interval.bend > std::max(bend_of_size * side, interval.rounding) &&
               interval.range.width() > shortest_interval;
    }

    /// A node, or its two children.
    struct Part {
        std::uint32_t first;
        std::uint32_t count;

        [[nodiscard]] NodeTwo of(std::span<const BoxNode> nodes) const {
            return {&nodes[first], &nodes[first + count - 1]};
        }
    };

    /// Both nodes, or the one that is much larger. What may meet earlier is visited earlier.
    void split(const NodePair& pair, const TimeInterval& interval) {
        const BoxNode& moving = moving_nodes_[pair.moving];
        const BoxNode& fixed = fixed_nodes_[pair.fixed];
        const float moving_side = side(moving);
        const float fixed_side = side(fixed);
        const bool moving_splits = !moving.is_leaf() && (fixed.is_leaf() || moving_side >= much_smaller * fixed_side);
        const bool fixed_splits = !fixed.is_leaf() && (moving.is_leaf() || fixed_side >= much_smaller * moving_side);
        const Part a = moving_splits ? Part{moving.first, 2} : Part{pair.moving, 1};
        const Part b = fixed_splits ? Part{fixed.first, 2} : Part{pair.fixed, 1};
        const auto when = interval.boxes.meetings(a.of(moving_nodes_), b.of(fixed_nodes_), pair.when);
        work_.node_pairs += a.count * b.count;
        std::array<NodePair, 4> left;
        std::size_t count = 0;
        for (std::uint32_t i = 0; i < a.count; ++i)
            for (std::uint32_t j = 0; j < b.count; ++j)
                if (const Window& window = when[2 * i + j]; !window.is_empty())
                    insert({a.first + i, b.first + j, window}, left, count++);
        for (std::size_t i = 0; i < count; ++i)
            push(left[i]);
    }

    /// Among `count` pairs, the later ones first.
    static void insert(const NodePair& pair, std::array<NodePair, 4>& pairs, std::size_t count) {
        for (; count > 0 && pairs[count - 1].when.lower < pair.when.lower; --count)
            pairs[count] = pairs[count - 1];
        pairs[count] = pair;
    }

    void push(const NodePair& pair) {
        prefetch_children(moving_nodes_, pair.moving);
        prefetch_children(fixed_nodes_, pair.fixed);
        queue_.push(pair);
    }

    /// They are asked for soon, and most often not at hand.
    static void prefetch_children(std::span<const BoxNode> nodes, std::uint32_t node) {
        if (!nodes[node].is_leaf())
            __builtin_prefetch(&nodes[nodes[node].first]);
    }

    static float side(const BoxNode& node) {
        return std::max({node.upper[0] - node.lower[0], node.upper[1] - node.lower[1], node.upper[2] - node.lower[2]});
    }

    /// Features are asked about unless a face's plane keeps them apart; answers would be the same (note 13). Planes are
    /// made once for the interval, features are asked about the part that matters.
    void test_faces(std::uint32_t moving_face, std::uint32_t fixed_face, const TauRange& interval, const Window& when) {
        ++work_.face_pairs;
        const Polyhedron& moving = search_.moving;
        const Polyhedron& fixed = search_.fixed;
        const double first = interval.at(when.lower);
        const TauRange part = part_around(
            interval, {first, std::max(first, std::min(contacts_.best(), interval.at(when.upper)))}, shortest_interval);
        if (plane_maps_.set(interval))
            planes_.use(plane_maps_.maps());
        const FacePlanes::Part in_interval((part.lower - interval.lower) / interval.width(),
                                           (part.upper - interval.lower) / interval.width());
        const CornerSides moving_sides = planes_.sides_of_moving(moving_face, fixed_face, in_interval);
        if (moving_sides.all_on_one_side())
            return;
        const CornerSides fixed_sides = planes_.sides_of_fixed(moving_face, fixed_face, in_interval);
        if (fixed_sides.all_on_one_side())
            return;
        if (filter_maps_.set(part))
            filter_.use(filter_maps_.maps(), filter_tolerance(search_.tolerance / part.width()));
        if (search_.check_start && part.lower <= 0)
            look_for_overlap(moving_face, fixed_face);
        for (const std::uint32_t vertex : moving.owned_vertices(moving_face))
            if (moving_sides.may_meet(vertex))
                if (const auto found = filter_.vertex_face(vertex, fixed_face))
                    add({ContactKind::vertex_face, {vertex, vertex}, {fixed_face, fixed_face}, *found}, part);
        for (const std::uint32_t vertex : fixed.owned_vertices(fixed_face))
            if (fixed_sides.may_meet(vertex))
                if (const auto found = filter_.face_vertex(moving_face, vertex))
                    add({ContactKind::face_vertex, {moving_face, moving_face}, {vertex, vertex}, *found}, part);
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
                        part);
            }
        }
    }

    void add(Candidate candidate, const TauRange& part) {
        candidate.tau.lower = part.at(candidate.tau.lower);
        candidate.tau.upper = std::min(part.upper, part.at(candidate.tau.upper));
        contacts_.add(candidate);
    }

    /// Faces that touch with many others, all at the same time: what keeps these two apart until shortly before may
    /// keep all of them apart.
    void look_for_plane(std::uint32_t moving_face, std::uint32_t fixed_face, const TauRange& interval) {
        many_at_once_ *= 2;
        const auto until = contacts_.early_enough();
        const double first = interval.at(queue_.earliest());
        if (!until || *until <= first)
            return;
        plane_ = PlaneBetween::faces({search_.moving, search_.fixed, contacts_.maps(), scale_, {first, *until}},
                                     moving_face, fixed_face);
        if (plane_)
            contacts_.leave_open_after(*until);
    }

    /// By the plane that was found, if there is one, from `first` on.
    bool is_kept_apart(const NodePair& pair, double first) {
        return plane_ && plane_->range().lower <= first && plane_->keeps_apart(pair.moving, pair.fixed);
    }

    void look_for_overlap(std::uint32_t moving_face, std::uint32_t fixed_face) {
        using elementary::Ends;
        for (const Edge& edge : search_.moving.owned_edges(moving_face))
            if (filter_.moving_edge_passage(edge, fixed_face, Ends::not_proven_on_one_side))
                contacts_.add(Overlap{true, {edge.from, edge.to}, {fixed_face, fixed_face}, {}, false});
        for (const Edge& edge : search_.fixed.owned_edges(fixed_face))
            if (filter_.fixed_edge_passage(edge, moving_face, Ends::not_proven_on_one_side))
                contacts_.add(Overlap{false, {edge.from, edge.to}, {moving_face, moving_face}, {}, false});
    }

    const PieceSearch& search_;
    const motion::ControlMaps<double> maps_;
    const elementary::ErrorScale scale_;
    const TimeTree times_;
    FacePlanes planes_;
    RangeMaps plane_maps_;
    FeaturePairs<double> filter_;
    RangeMaps filter_maps_;
    FoundContacts contacts_;
    std::optional<PlaneBetween> plane_;
    std::size_t many_at_once_ = 4; ///< a plane is looked for when so many were found
    PairQueue queue_;              ///< of the interval at hand
    std::span<const BoxNode> moving_nodes_;
    std::span<const BoxNode> fixed_nodes_;
    Work work_;
};

} // namespace

PieceResult search_piece(const PieceSearch& search) {
    return Traversal(search).run();
}

} // namespace chasles::query
