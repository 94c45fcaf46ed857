// Random small steps of a body in contact with another body. Most steps slide or roll along the contacts.
#pragma once

#include "chasles/contact/constraint_rows.h"
#include "tests/support/random_poses.h"
#include "tests/support/sliding_body.h"

#include <Eigen/Eigenvalues>

namespace chasles::test {

/// The bounding sphere of a body's box.
struct Ball {
    Eigen::Vector3d middle;
    double radius;

    explicit Ball(const Polyhedron& body) {
        Eigen::AlignedBox3d box;
        for (const Eigen::Vector3d& vertex : body.vertices())
            box.extend(vertex);
        middle = box.center();
        radius = 0.5 * box.diagonal().norm();
    }
};

/// A twist about the moving body's middle: velocity, and turn times the body's radius. Both are lengths.
using Twist = Eigen::Matrix<double, 6, 1>;

class Slide {
public:
    /// Keeps both arguments by reference.
    Slide(SlidingBody& body, Random& random) : body_(body), random_(random), ball_(body.moving) {}

    /// Returns false if nothing is within the margin any more.
    bool step() {
        const std::vector<Contact> held = standing_still();
        if (held.empty())
            return false;
        const double size = ball_.radius * std::pow(10, random_.uniform(-4, -1));
        static_cast<void>(body_.step(moved(size * direction(held))));
        return true;
    }

private:
    using Rows = Eigen::Matrix<double, Eigen::Dynamic, 6>;

    /// Checks that a query without movement is clear, and returns the held contacts.
    std::vector<Contact> standing_still() {
        const FirstContact found = first_contact({.moving = body_.moving,
                                                  .fixed = body_.fixed,
                                                  .motion = ScrewMotion::between(body_.at, body_.at),
                                                  .options = {.margin = body_.margin, .hold = body_.hold}});
        EXPECT_EQ(found.verdict, Verdict::clear) << "without a motion";
        middle_ = body_.at.isometry() * ball_.middle;
        return found.held;
    }

    /// A twist of length one.
    Twist direction(std::vector<Contact> held) {
        const double near = body_.hold + random_.uniform(0.01, 1) * (body_.margin - body_.hold);
        std::erase_if(held, [&](const Contact& contact) { return contact.gap > near; });
        for (Contact& contact : held)
            contact.point = (contact.point - middle_) / ball_.radius;
        const Rows rows = constraint_rows(held);
        Twist twist = random_twist();
        const double kind = random_.uniform(0, 1);
        if (kind < 0.35)
            twist = along(rows, twist);
        else if (kind < 0.55)
            twist = along(rows, about_a_contact(held, twist));
        else if (kind < 0.8)
            twist = not_into(rows, twist);
        else if (kind < 0.95 && rows.rows() > 0) // lifts, and pushes
            twist = (random_.chance(0.3) ? -1 : 1) * rows.colwise().mean().transpose() + random_.uniform(0, 1) * twist;
        return twist.stableNormalized();
    }

    Twist random_twist() {
        Twist twist;
        twist << random_point(random_, 1), random_point(random_, 1);
        return twist;
    }

    /// Rolling: the turn is about one of the contacts.
    Twist about_a_contact(const std::vector<Contact>& held, Twist twist) {
        if (!held.empty()) {
            const Contact& contact = held[std::size_t(random_.integer(0, int(held.size()) - 1))];
            twist.head<3>() = contact.point.cross(twist.tail<3>());
        }
        return twist;
    }

    /// The part of a twist that keeps all gaps constant. If this part is zero, the part that closes no gap.
    static Twist along(const Rows& rows, const Twist& twist) {
        if (rows.rows() == 0)
            return twist;
        const Eigen::SelfAdjointEigenSolver<Eigen::Matrix<double, 6, 6>> solver(rows.transpose() * rows);
        const Twist& squares = solver.eigenvalues();
        Twist rest = Twist::Zero();
        for (Eigen::Index i = 0; i < 6; ++i)
            if (squares[i] <= 1e-12 * squares[5])
                rest += solver.eigenvectors().col(i) * solver.eigenvectors().col(i).dot(twist);
        return rest.norm() > 1e-3 ? rest : not_into(rows, twist);
    }

    /// Projects repeatedly onto the half-spaces of the contacts. Some contacts may still close at the end.
    static Twist not_into(const Rows& rows, Twist twist) {
        for (int i = 0; i < 30; ++i)
            for (Eigen::Index j = 0; j < rows.rows(); ++j)
                if (const double rate = rows.row(j).dot(twist); rate < 0)
                    twist -= rate / rows.row(j).squaredNorm() * rows.row(j).transpose();
        return twist;
    }

    [[nodiscard]] Pose moved(const Twist& twist) const {
        const Eigen::Vector3d turn = twist.tail<3>() / ball_.radius;
        const Eigen::AngleAxisd turning(turn.norm(), turn.stableNormalized());
        const Eigen::Vector3d shift = twist.head<3>();
        const Eigen::Isometry3d step = Eigen::Translation3d(middle_ + shift) * turning * Eigen::Translation3d(-middle_);
        return Pose(step * body_.at.isometry());
    }

    SlidingBody& body_;
    Random& random_;
    Ball ball_;
    Eigen::Vector3d middle_; ///< of the moving body, in the world
};

} // namespace chasles::test
