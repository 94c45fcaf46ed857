// A crate falls on a floor, slides along the floor to a wall, and then slides along the wall. In each step a query
// returns how far the crate can move, and the contacts give the remaining free velocities. Only the public interface is
// used.
#include <chasles/chasles.h>

#include <Eigen/Dense>
#include <cstdio>

namespace {

constexpr double margin = 0.01;    // metres; a smaller distance counts as contact
constexpr double hold = 0.002;     // metres; bodies in contact never come closer than this
constexpr double time_step = 0.02; // seconds

using Twist = Eigen::Matrix<double, 6, 1>; // velocity of the crate's centre: linear, then angular
using Rows = Eigen::Matrix<double, Eigen::Dynamic, 6>;

chasles::Polyhedron box(const Eigen::Vector3d& lower, const Eigen::Vector3d& upper) {
    std::vector<Eigen::Vector3d> corners;
    for (int i = 0; i < 8; ++i)
        corners.emplace_back((i & 1 ? upper : lower).x(), (i & 2 ? upper : lower).y(), (i & 4 ? upper : lower).z());
    const std::vector<std::vector<std::uint32_t>> sides{{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4},
                                                        {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}};
    return chasles::Polyhedron::from_polygons(corners, sides);
}

/// A floor in z = 0 and a wall in x = 2, as one open surface.
chasles::Polyhedron floor_and_wall() {
    const std::vector<Eigen::Vector3d> corners{{-2, -2, 0}, {2, -2, 0}, {2, 2, 0}, {-2, 2, 0}, {2, -2, 2}, {2, 2, 2}};
    const std::vector<std::vector<std::uint32_t>> faces{{0, 1, 2}, {0, 2, 3}, {1, 4, 5, 2}};
    return chasles::Polyhedron::from_polygons(corners, faces);
}

/// Converts rows for twists of the world's origin to rows for twists of `point`.
Rows about(const Eigen::Vector3d& point, Rows rows) {
    for (Eigen::Index i = 0; i < rows.rows(); ++i)
        rows.row(i).tail<3>() -= point.cross(rows.row(i).head<3>().transpose()).transpose();
    return rows;
}

/// The twist nearest to `twist` that reduces no gap below half the margin during one time step, by Hildreth's method.
Twist restricted(const Rows& rows, const std::vector<chasles::Contact>& contacts, Twist twist) {
    Eigen::VectorXd pushes = Eigen::VectorXd::Zero(rows.rows());
    for (int sweep = 0; sweep < 200; ++sweep)
        for (Eigen::Index i = 0; i < rows.rows(); ++i) {
            const double least_rate = (margin / 2 - contacts[static_cast<std::size_t>(i)].gap) / time_step;
            const double missing = least_rate - rows.row(i).dot(twist);
            const double push = std::max(-pushes[i], missing / rows.row(i).squaredNorm());
            pushes[i] += push;
            twist += push * rows.row(i).transpose();
        }
    return twist;
}

Eigen::Isometry3d moved(const Eigen::Isometry3d& pose, const Twist& twist, double time) {
    const Eigen::Vector3d turn = time * twist.tail<3>();
    const Eigen::Vector3d axis = turn.norm() > 0 ? Eigen::Vector3d(turn.normalized()) : Eigen::Vector3d::UnitZ();
    Eigen::Isometry3d goal = pose;
    goal.linear() = Eigen::AngleAxisd(turn.norm(), axis) * pose.linear();
    goal.translation() += time * twist.head<3>();
    return goal;
}

void print_step(int step, const Eigen::Isometry3d& pose, const std::vector<chasles::Contact>& held) {
    const Eigen::Vector3d& place = pose.translation();
    std::printf("step %3d  at (%.3f, %.3f, %.3f)  %zu contacts:", step, place.x(), place.y(), place.z(), held.size());
    for (const chasles::Contact& contact : held)
        std::printf(" (%.2f, %.2f, %.2f)", contact.normal.x(), contact.normal.y(), contact.normal.z());
    std::printf("\n");
}

} // namespace

int main() {
    const chasles::Polyhedron crate = box({-0.3, -0.2, -0.25}, {0.3, 0.2, 0.25});
    const chasles::Polyhedron room = floor_and_wall();
    Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
    pose.translate(Eigen::Vector3d(-1, -1, 1)).rotate(Eigen::AngleAxisd(0.3, Eigen::Vector3d::UnitZ()));

    const auto ask = [&](const Eigen::Isometry3d& goal) {
        return chasles::first_contact(
            {.moving = crate,
             .fixed = room,
             .motion = chasles::ScrewMotion::between(pose, goal),
             .options = {.margin = margin, .hold = hold, .find = chasles::Find::first_with_all_contacts}});
    };
    Twist wish; // forward, slightly sideways, and down
    wish << 0.8, 0.3, -0.5, 0, 0, 0;
    std::size_t held = 0;
    for (int step = 0; step < 250; ++step) {
        const chasles::FirstContact here =
            ask(pose); // a motion that stays in place: finds the contacts within the margin
        if (here.verdict == chasles::Verdict::contact_at_start)
            return std::printf("step %d: the bodies touch\n", step), 1;
        if (here.held.size() != held)
            print_step(step, pose, here.held);
        held = here.held.size();
        const Twist twist = restricted(about(pose.translation(), chasles::constraint_rows(here.held)), here.held, wish);
        const Eigen::Isometry3d goal = moved(pose, twist, time_step);
        const chasles::FirstContact found = ask(goal);
        // A new contact is at the margin. Moving to the upper end of its bracket is safe; the next query then holds the
        // contact.
        const double reached =
            found.verdict == chasles::Verdict::clear ? 1 : std::min(found.time.upper, found.clear_until);
        pose = chasles::ScrewMotion::between(pose, goal).pose_at(reached).isometry();
    }
    std::printf("ends at (%.3f, %.3f, %.3f)\n", pose.translation().x(), pose.translation().y(), pose.translation().z());
    return 0;
}
