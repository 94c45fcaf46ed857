#include "chasles/query/constraint_rows.h"

#include <Eigen/Geometry>

namespace chasles {

Eigen::Matrix<double, Eigen::Dynamic, 6> constraint_rows(std::span<const Contact> contacts) {
    Eigen::Matrix<double, Eigen::Dynamic, 6> rows(static_cast<Eigen::Index>(contacts.size()), 6);
    for (Eigen::Index i = 0; i < rows.rows(); ++i) {
        const Contact& contact = contacts[static_cast<std::size_t>(i)];
        rows.row(i) << contact.normal.transpose(), contact.point.cross(contact.normal).transpose();
    }
    return rows;
}

} // namespace chasles
