#include "chasles/manipulation/contact_rows.h"

#include <Eigen/Geometry>

namespace chasles::manipulation {

using Eigen::Vector3d;

namespace {

Eigen::Matrix<double, 1, 6> row_of(const Vector3d& direction, const Vector3d& lever) {
    Eigen::Matrix<double, 1, 6> row;
    row << direction.transpose(), lever.cross(direction).transpose();
    return row;
}

} // namespace

Plane plane_across(const Vector3d& normal) {
    Plane plane;
    plane.col(0) = normal.unitOrthogonal();
    plane.col(1) = normal.cross(plane.col(0));
    return plane;
}

TwistConstraints normal_rows(std::span<const ModelledContact> contacts, const Vector3d& centre) {
    const auto count = Eigen::Index(contacts.size());
    TwistConstraints constraints{Rows(count, 6), Eigen::VectorXd(count)};
    for (Eigen::Index i = 0; i < count; ++i) {
        const Contact& contact = contacts[std::size_t(i)].contact;
        constraints.rows.row(i) = row_of(contact.normal, contact.point - centre);
        constraints.gaps[i] = contact.gap;
    }
    return constraints;
}

Rows tangent_rows(std::span<const ModelledContact> contacts, const Vector3d& centre) {
    const auto count = Eigen::Index(contacts.size());
    Rows rows(2 * count, 6);
    for (Eigen::Index i = 0; i < count; ++i) {
        const Contact& contact = contacts[std::size_t(i)].contact;
        const Plane plane = plane_across(contact.normal);
        for (Eigen::Index k = 0; k < 2; ++k)
            rows.row(2 * i + k) = row_of(plane.col(k), contact.point - centre);
    }
    return rows;
}

} // namespace chasles::manipulation
