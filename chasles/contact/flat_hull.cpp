#include "chasles/contact/flat_hull.h"

#include "chasles/base/sort.h"

#include <Eigen/Geometry>
#include <algorithm>

namespace chasles::contact {

namespace {

/// Two normals that differ by less belong to one plane (note 18).
constexpr double same_normal = 1e-6;

/// The place of a contact in its plane, and its index.
struct FlatPoint {
    Eigen::Vector2d place;
    std::size_t index;
};

using FlatPoints = std::vector<FlatPoint>;

/// The distance of b to the left of the line from a to c, times the length from a to c.
double left_of(const FlatPoint& a, const FlatPoint& b, const FlatPoint& c) {
    const Eigen::Vector2d way = (c.place - a.place).stableNormalized();
    const Eigen::Vector2d arm = b.place - a.place;
    return way.x() * arm.y() - way.y() * arm.x();
}

/// The hull corners to the left of the line from a to c, in order from a, without the ends.
void add_corners(const FlatPoint& a, const FlatPoint& c, const FlatPoints& points, double slack, FlatPoints& hull) {
    const auto farthest = std::ranges::max_element(points, {}, [&](const FlatPoint& b) { return left_of(a, b, c); });
    if (left_of(a, *farthest, c) <= slack)
        return;
    FlatPoints left;
    std::ranges::copy_if(points, std::back_inserter(left),
                         [&](const FlatPoint& b) { return left_of(a, b, c) > slack; });
    add_corners(a, *farthest, left, slack, hull);
    hull.push_back(*farthest);
    add_corners(*farthest, c, left, slack, hull);
}

/// A point as far from the line as a corner may lie on the side next to the corner.
void remove_straight_corners(FlatPoints& hull, double slack) {
    for (std::size_t i = 0; i < hull.size() && hull.size() > 2;) {
        const FlatPoint& before = hull[(i + hull.size() - 1) % hull.size()];
        const FlatPoint& after = hull[(i + 1) % hull.size()];
        if (std::abs(left_of(before, hull[i], after)) <= slack)
            hull.erase(hull.begin() + static_cast<std::ptrdiff_t>(i));
        else
            ++i;
    }
}

/// Each place once, with the least index of its contacts.
FlatPoints merged(const FlatPoints& hull, const FlatPoints& points, double slack) {
    const auto is_near = [&](const FlatPoint& a, const FlatPoint& b) { return (a.place - b.place).norm() <= slack; };
    FlatPoints result;
    for (const FlatPoint& corner : hull) {
        if (std::ranges::any_of(result, [&](const FlatPoint& other) { return is_near(other, corner); }))
            continue;
        // The points are in the order of their contacts.
        result.push_back(*std::ranges::find_if(points, [&](const FlatPoint& point) { return is_near(point, corner); }));
    }
    return result;
}

FlatPoints corners(const FlatPoints& points, double slack) {
    const auto [first, last] =
        std::ranges::minmax_element(points, {}, [](const FlatPoint& point) { return point.place.x(); });
    FlatPoints hull{*first};
    add_corners(*first, *last, points, slack, hull);
    hull.push_back(*last);
    add_corners(*last, *first, points, slack, hull);
    hull = merged(hull, points, slack);
    remove_straight_corners(hull, slack);
    return hull;
}

/// Axes of a plane.
struct PlaneAxes {
    Eigen::Vector3d first;
    Eigen::Vector3d second;

    explicit PlaneAxes(const Eigen::Vector3d& normal) : first(normal.unitOrthogonal()), second(normal.cross(first)) {}
};

void mark_corners(const std::vector<Contact>& contacts, const std::vector<std::size_t>& group, double slack,
                  std::vector<char>& is_kept) {
    const PlaneAxes axes(contacts[group.front()].normal);
    FlatPoints points;
    for (const std::size_t index : group) {
        const Eigen::Vector3d& point = contacts[index].point;
        points.push_back({{axes.first.dot(point), axes.second.dot(point)}, index});
    }
    for (const FlatPoint& corner : corners(points, slack))
        is_kept[corner.index] = 1;
}

/// Whether two contacts belong to one flat contact.
bool are_flat(const Contact& first, const Contact& other, double slack) {
    const Eigen::Vector3d way = other.point - first.point;
    const double same_height = slack + same_normal * way.norm();
    return (other.normal - first.normal).norm() <= same_normal && std::abs(first.normal.dot(way)) <= same_height &&
           std::abs(other.gap - first.gap) <= same_height;
}

/// Contacts sorted along a direction that tells most normals apart, so that like ones are found without a look at all.
class ByNormal {
public:
    explicit ByNormal(const std::vector<Contact>& contacts) : contacts_(contacts) {
        for (std::size_t i = 0; i < contacts.size(); ++i)
            sorted_.emplace_back(key_of(contacts[i]), i);
        chasles::sort(sorted_);
    }

    /// Contacts that are not grouped yet and form one flat contact with this one, in ascending order.
    [[nodiscard]] std::vector<std::size_t> group_of(std::size_t first, const std::vector<char>& is_grouped,
                                                    double slack) const {
        const double key = key_of(contacts_[first]);
        std::vector<std::size_t> group;
        for (auto at = std::ranges::lower_bound(sorted_, std::pair(key - 2 * same_normal, std::size_t{0}));
             at != sorted_.end() && at->first <= key + 2 * same_normal; ++at)
            if (!is_grouped[at->second] && are_flat(contacts_[first], contacts_[at->second], slack))
                group.push_back(at->second);
        chasles::sort(group);
        return group;
    }

private:
    [[nodiscard]] static double key_of(const Contact& contact) {
        return contact.normal.dot(Eigen::Vector3d(0.41, 0.53, 0.74)); // shorter than 1
    }

    const std::vector<Contact>& contacts_;
    std::vector<std::pair<double, std::size_t>> sorted_;
};

} // namespace

std::vector<Contact> at_corners_of_hulls(std::vector<Contact> contacts, double slack) {
    const ByNormal by_normal(contacts);
    std::vector<char> is_kept(contacts.size(), 0);
    std::vector<char> is_grouped(contacts.size(), 0);
    for (std::size_t i = 0; i < contacts.size(); ++i) {
        if (is_grouped[i])
            continue;
        const std::vector<std::size_t> group = by_normal.group_of(i, is_grouped, slack);
        for (const std::size_t index : group)
            is_grouped[index] = 1;
        mark_corners(contacts, group, slack, is_kept);
    }
    std::vector<Contact> left;
    for (std::size_t i = 0; i < contacts.size(); ++i)
        if (is_kept[i])
            left.push_back(contacts[i]);
    return left;
}

} // namespace chasles::contact
