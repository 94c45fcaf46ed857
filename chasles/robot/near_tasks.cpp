// Which pairs come near each other during a segment, and when? In halves of the time, with bounds for all points of a
// body. Source: docs/derivations/29-robots.md, "Culling".
#include "chasles/culling/clearly_apart.h"
#include "chasles/motion/screw_path.h"
#include "chasles/robot/element_places.h"

#include <algorithm>
#include <cmath>

namespace chasles::robot {

namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using motion::GeneralPose;
using motion::RateBounds;
using scene::Box;
using Prepared = RobotChecker::Prepared;

/// A segment is halved at most so often.
constexpr int most_halvings = 6;
constexpr std::size_t cells = std::size_t{1} << most_halvings;
/// The allowance for all roundings of boxes, relative to the sizes that enter.
constexpr double rounding_of_boxes = 1e-11;

// These numbers decide only what is tried first. They are measured with robots_bench and cloud_peers.py.

/// A pair is halved in time until the body moves by less than this part of its radius. Then large nodes decide whether
/// it is searched.
constexpr double small_way = 1.2;
/// The box of a body of so many nodes says little: its large nodes are tried as soon as the way is less than this.
constexpr std::size_t many_nodes = 10'000;
constexpr double way_of_many_nodes = 12;

Matrix3d turn_of(const GeneralPose<double>& pose) {
    const auto& [w, v] = pose.rotation;
    return Eigen::Quaterniond(w, v.x, v.y, v.z).toRotationMatrix();
}

/// A part of a segment between two ends of cells.
struct Cell {
    std::size_t begin = 0;
    std::size_t end = cells;
    int halvings = 0;

    [[nodiscard]] double duration() const { return double(end - begin) / double(cells); }
    [[nodiscard]] Bracket part() const { return {double(begin) / double(cells), double(end) / double(cells)}; }
};

/// A pair that is still to be proven apart.
struct Candidate {
    Task task;
    RateBounds rates;     ///< of the group of the moving element, as seen from the fixed one
    double deviation = 0; ///< of its points from their chords, over the whole segment
    double way = 0;       ///< of its points, at most, over the whole segment
    double margin = 0;
    double longest_tried = 0; ///< way in a cell up to which large nodes are tried
};

class Culling {
public:
    Culling(const Prepared& prepared, const SegmentMotion& motion, std::optional<double> distance)
        : prepared_(prepared), model_(prepared.model()), rates_(model_, motion), places_(prepared, motion, cells),
          distance_(distance) {
        of_group_.resize(model_.groups.size());
        for (std::size_t g = 1; g < of_group_.size(); ++g) {
            of_group_[g] = of_group_[model_.groups[g].parent];
            rates_.go_down(of_group_[g], g);
        }
        bound_rounding(motion);
    }

    std::vector<Task> run() {
        visit({}, candidates());
        add_movers();
        std::ranges::stable_sort(tasks_, {}, [](const Task& task) { return task.part.lower; });
        return std::move(tasks_);
    }

private:
    /// The size of all places, and what rounding may move them.
    void bound_rounding(const SegmentMotion& motion) {
        for (const RigidGroup& group : model_.groups)
            size_ += norm1(group.origin.in_double.translation);
        for (const auto& values : motion.values)
            for (const auto& value : values) {
                size_ += value->size();
                rounding_ += motion::pose_rounding<double> * (4 + 2 * value->rounding() * value->size());
            }
        size_ += norm1(motion::vector_in<double>(model_.base.translation));
        rounding_ += motion::pose_rounding<double> * 8 * double(model_.groups.size());
    }

    [[nodiscard]] std::vector<Candidate> candidates();
    void add_candidate(std::vector<Candidate>& all, const Task& task, const RateBounds& rates, double margin) const;
    void add_obstacles(std::vector<Candidate>& all, std::size_t element, const Box& swept_box);
    void add_movers();
    void go_down(RateBounds& bounds, std::size_t above, std::size_t to) const;
    [[nodiscard]] RateBounds rates_between(std::size_t from, std::size_t to) const;
    void visit(const Cell& cell, const std::vector<Candidate>& pairs);
    struct Ball {
        const Vector3d& centre;
        double radius;
        double size; ///< the sum of the sizes of all lengths
    };
    [[nodiscard]] Ball fixed_ball(std::size_t time, const Task& task);
    [[nodiscard]] bool are_balls_apart(const Cell& cell, const Candidate& pair);
    [[nodiscard]] bool are_boxes_apart(const Cell& cell, const Candidate& pair);
    [[nodiscard]] bool are_nodes_apart(const Cell& cell, const Candidate& pair);
    [[nodiscard]] Box swept(const Cell& cell, std::size_t element, const RateBounds& rates);
    [[nodiscard]] GeneralPose<double> relative(std::size_t time, const Task& task);
    void add(const Task& task, const Bracket& part);

    const Prepared& prepared_;
    const Model& model_;
    GroupRates rates_;
    ElementPlaces places_;
    std::optional<double> distance_;   ///< in the place of margins
    std::vector<RateBounds> of_group_; ///< in the world
    std::vector<Task> tasks_;
    double size_ = 1e-300; ///< the sum of the sizes of everything that enters
    /// Of the pose of a group as seen from another one: of all joints twice, and of the fixed poses and the floating
    /// joints between them.
    double rounding_ = 0;
};

Box box_at(const Prepared::Extent& extent, const GeneralPose<double>& pose, const Vector3d& centre) {
    const Vector3d half = (turn_of(pose).cwiseAbs() * extent.half).cwiseMin(Vector3d::Constant(extent.radius));
    return {centre - half, centre + half};
}
Box box_at(const Prepared::Extent& extent, const GeneralPose<double>& pose) {
    return box_at(extent, pose, centre_at(extent, pose));
}

/// How far the points of an element are from the origin of its group.
double reach_of(const Prepared::Extent& extent) {
    return length(placed(extent.place, motion::vector_in<double>(extent.centre))) + extent.radius;
}

/// Up from one group to the first one above both, and down to the other one.
RateBounds Culling::rates_between(std::size_t from, std::size_t to) const {
    RateBounds bounds;
    std::size_t above = to; // of both groups, at last
    while (from != above) {
        if (model_.groups[from].depth < model_.groups[above].depth) {
            above = model_.groups[above].parent;
            continue;
        }
        rates_.go_up(bounds, from);
        from = model_.groups[from].parent;
    }
    go_down(bounds, above, to);
    return bounds;
}

void Culling::go_down(RateBounds& bounds, std::size_t above, std::size_t to) const {
    if (to == above)
        return;
    go_down(bounds, above, model_.groups[to].parent);
    rates_.go_down(bounds, to);
}

void Culling::add_candidate(std::vector<Candidate>& all, const Task& task, const RateBounds& rates,
                            double margin) const {
    const Prepared::Extent& extent = prepared_.extents[prepared_.moving_index(task)];
    const double reach = reach_of(extent);
    const std::size_t nodes = std::max(prepared_.moving(task).shape.body().bvh().nodes().size(),
                                       prepared_.fixed_shape(task).body().bvh().nodes().size());
    all.push_back({task, rates, 0.125 * rates.acceleration_at(reach), rates.speed_at(reach), margin,
                   extent.radius * (nodes < many_nodes ? small_way : way_of_many_nodes)});
}

/// Pairs whose boxes overlap in the world over the whole segment: few of those of two robots do.
std::vector<Candidate> Culling::candidates() {
    std::vector<Candidate> all;
    std::vector<Box> boxes;
    for (std::size_t e = 0; e < model_.elements.size(); ++e)
        boxes.push_back(swept({}, e, of_group_[model_.elements[e].group]));
    for (std::size_t i = 0; i < prepared_.self_pairs.size(); ++i) {
        const auto& [moving, fixed, own_margin] = prepared_.self_pairs[i];
        const double margin = distance_.value_or(own_margin);
        if (scene::widened(boxes[moving], margin).intersects(boxes[fixed]))
            add_candidate(all, {Task::Kind::self, i, 0, {}},
                          rates_between(model_.elements[fixed].group, model_.elements[moving].group), margin);
    }
    if (!prepared_.obstacles.empty())
        for (std::size_t e = 0; e < model_.elements.size(); ++e)
            add_obstacles(all, e, boxes[e]);
    return all;
}

void Culling::add_obstacles(std::vector<Candidate>& all, std::size_t element, const Box& swept_box) {
    const RateBounds& rates = of_group_[model_.elements[element].group];
    const double margin = distance_.value_or(prepared_.options.margin);
    const auto add = [&](std::size_t obstacle) {
        if (!prepared_.is_ignored(element, prepared_.obstacles[obstacle].body))
            add_candidate(all, {Task::Kind::obstacle, element, obstacle, {}}, rates, margin);
    };
    const Box box = scene::widened(swept_box, margin);
    if (prepared_.tree)
        for (const std::uint32_t obstacle : prepared_.tree->overlapping(box))
            add(obstacle);
    else
        for (std::size_t obstacle = 0; obstacle < prepared_.obstacles.size(); ++obstacle)
            if (box.intersects(prepared_.obstacles[obstacle].box))
                add(obstacle);
}

void Culling::add_movers() {
    for (std::size_t e = 0; e < model_.elements.size(); ++e)
        for (std::size_t i = 0; i < prepared_.movers.size(); ++i)
            if (!prepared_.is_ignored(e, prepared_.movers[i]))
                tasks_.push_back({Task::Kind::mover, e, i, {0, 1}});
}

/// The box that an element does not leave during a cell, in the world.
Box Culling::swept(const Cell& cell, std::size_t element, const RateBounds& rates) {
    const Prepared::Extent& extent = prepared_.extents[element];
    const auto box_then = [&](std::size_t time) {
        const ElementPlaces::Place& place = places_(time, element);
        return box_at(extent, place.pose, place.centre);
    };
    return scene::widened(box_then(cell.begin).merged(box_then(cell.end)),
                          deviation_from_straight(rates, reach_of(extent), cell.duration()) +
                              rounding_of_boxes * (size_ + extent.size));
}

/// The moving element in the frame of the fixed body.
GeneralPose<double> Culling::relative(std::size_t time, const Task& task) {
    const GeneralPose<double>& moving = places_(time, prepared_.moving_index(task)).pose;
    return task.kind == Task::Kind::self ? seen_from(places_(time, prepared_.self_pairs[task.first].fixed).pose, moving)
                                         : seen_from(prepared_.obstacles[task.second].pose.in_double, moving);
}

/// The ball around the fixed body at the end of a cell, in the world.
Culling::Ball Culling::fixed_ball(std::size_t time, const Task& task) {
    if (task.kind == Task::Kind::obstacle) {
        const Prepared::Obstacle& obstacle = prepared_.obstacles[task.second];
        return {obstacle.centre, obstacle.radius, obstacle.size};
    }
    const std::size_t fixed = prepared_.self_pairs[task.first].fixed;
    return {places_(time, fixed).centre, prepared_.extents[fixed].radius, prepared_.extents[fixed].size};
}

/// By the distances of both centres at both ends: in between, the distance is less than their mean by at most half of
/// the way of the moving centre, as seen from the fixed body.
bool Culling::are_balls_apart(const Cell& cell, const Candidate& pair) {
    const std::size_t moving = prepared_.moving_index(pair.task);
    const Prepared::Extent& extent = prepared_.extents[moving];
    const Ball first = fixed_ball(cell.begin, pair.task), last = fixed_ball(cell.end, pair.task);
    const double distances = (places_(cell.begin, moving).centre - first.centre).norm() +
                             (places_(cell.end, moving).centre - last.centre).norm();
    return 0.5 * (distances - pair.way * cell.duration()) >
           extent.radius + first.radius + pair.margin + rounding_of_boxes * (size_ + extent.size + first.size);
}

/// By boxes in the frame of the fixed body.
bool Culling::are_boxes_apart(const Cell& cell, const Candidate& pair) {
    const Task& task = pair.task;
    const Prepared::Extent& moving = prepared_.extents[prepared_.moving_index(task)];
    const Body& fixed = prepared_.fixed_shape(task).body();
    const double duration = cell.duration();
    const Box box = box_at(moving, relative(cell.begin, task)).merged(box_at(moving, relative(cell.end, task)));
    const double size = size_ + moving.size + fixed.bvh().centre().lpNorm<1>() + fixed.bvh().radius();
    const double more = std::min(pair.deviation * duration * duration, 0.5 * pair.way * duration) + pair.margin +
                        rounding_of_boxes * size;
    return !scene::widened(box, more).intersects({fixed.report().lower, fixed.report().upper});
}

/// By large nodes of both hierarchies.
bool Culling::are_nodes_apart(const Cell& cell, const Candidate& pair) {
    const Task& task = pair.task;
    const Prepared::Extent& extent = prepared_.extents[prepared_.moving_index(task)];
    // The origin of the group, in the frame of the shape.
    const GeneralPose<double>& place = extent.place;
    const motion::Vector3<double> reference =
        rotated(place.rotation.conjugate(), motion::Vector3<double>() - place.translation);
    const std::optional<motion::CoarseMotion> coarse =
        motion::coarse_part({{relative(cell.begin, task), relative(cell.end, task)},
                             reference,
                             pair.rates,
                             cell.duration(),
                             rounding_,
                             size_ + extent.size});
    return coarse && culling::are_clearly_apart(prepared_.moving(task).shape.body(), prepared_.fixed_shape(task).body(),
                                                *coarse, pair.margin);
}

/// Joins two parts of one pair that follow each other.
void Culling::add(const Task& task, const Bracket& part) {
    for (Task& earlier : tasks_)
        if (earlier.kind == task.kind && earlier.first == task.first && earlier.second == task.second &&
            earlier.part.upper == part.lower) {
            earlier.part.upper = part.upper;
            return;
        }
    tasks_.push_back({task.kind, task.first, task.second, part});
}

void Culling::visit(const Cell& cell, const std::vector<Candidate>& pairs) {
    std::vector<Candidate> near;
    for (const Candidate& pair : pairs) {
        if (are_balls_apart(cell, pair) || are_boxes_apart(cell, pair))
            continue;
        const double way = pair.way * cell.duration();
        const bool is_last = way <= small_way * prepared_.extents[prepared_.moving_index(pair.task)].radius ||
                             cell.halvings == most_halvings;
        if ((is_last || way <= pair.longest_tried) && are_nodes_apart(cell, pair))
            continue;
        if (is_last)
            add(pair.task, cell.part());
        else
            near.push_back(pair);
    }
    if (near.empty())
        return;
    const std::size_t middle = (cell.begin + cell.end) / 2;
    visit({cell.begin, middle, cell.halvings + 1}, near);
    visit({middle, cell.end, cell.halvings + 1}, near);
}

} // namespace

std::vector<Task> near_tasks(const RobotChecker::Prepared& prepared, const SegmentMotion& motion,
                             std::optional<double> distance) {
    return Culling(prepared, motion, distance).run();
}

} // namespace chasles::robot
