// Checks the numbers of a pose, scales its quaternion into a safe range, and projects matrices to rotations.
// Every refusal is an InvalidInput with the reason.
#include "chasles/motion/pose.h"

#include "chasles/base/invalid_input.h"
#include "chasles/base/number_text.h"
#include "chasles/motion/rational_motion.h"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>

namespace chasles {

namespace {

/// The greatest deviation of an entry of R^T R from the identity. It admits matrices printed with six digits.
constexpr double orthogonality_tolerance = 1e-5;
/// A matrix with a smaller deviation is a rotation up to rounding; a projection would only add rounding errors.
constexpr double rounding_tolerance = 1e-12;
/// A quaternion whose largest magnitude is in this range is used unchanged.
constexpr double least_size = 1e-3;
constexpr double largest_size = 1e3;

/// Refuses a translation that is not finite or out of range.
void require_usable(const Eigen::Vector3d& translation) {
    if (!translation.allFinite())
        throw InvalidInput("pose: translation: a number is NaN or infinite");
    if (translation.cwiseAbs().maxCoeff() > Pose::largest_length)
        throw InvalidInput("pose: translation: a number is larger than 1e30");
}

/// The quaternion scaled by a power of two, which is exact. Squares of the result neither overflow nor underflow.
Eigen::Quaterniond in_safe_range(const Eigen::Quaterniond& rotation) {
    if (!rotation.coeffs().allFinite())
        throw InvalidInput("pose: quaternion: a number is NaN or infinite");
    const double largest = rotation.coeffs().cwiseAbs().maxCoeff();
    if (largest == 0)
        throw InvalidInput("pose: quaternion: all four numbers are zero, which is no rotation");
    if (largest >= least_size && largest <= largest_size)
        return rotation;
    const int exponent = -std::ilogb(largest);
    Eigen::Quaterniond scaled;
    for (int i = 0; i < 4; ++i)
        scaled.coeffs()[i] = std::ldexp(rotation.coeffs()[i], exponent);
    return scaled;
}

/// What a matrix that is no rotation does, and the way out.
std::string other_than_turning(const Eigen::Matrix3d& matrix) {
    const auto text = [](double number) { return number_text(number, 6); };
    const Eigen::Vector3d scale = matrix.colwise().norm();
    if (!(scale.minCoeff() > 0))
        return "it flattens bodies";
    const Eigen::Matrix3d products = matrix.transpose() * matrix;
    const double slant =
        std::max({std::abs(products(0, 1)) / (scale[0] * scale[1]), std::abs(products(1, 2)) / (scale[1] * scale[2]),
                  std::abs(products(2, 0)) / (scale[2] * scale[0])});
    if (!(slant <= orthogonality_tolerance))
        return "it shears";
    const std::string mirrors = matrix.determinant() < 0 ? ", and mirrors" : "";
    if (scale.maxCoeff() - scale.minCoeff() <= orthogonality_tolerance * scale.maxCoeff())
        return "it scales by " + text(scale[0]) + mirrors;
    return "it scales by " + text(scale[0]) + ", " + text(scale[1]) + ", " + text(scale[2]) + " along x, y, z" +
           mirrors;
}

/// The nearest rotation in the Frobenius norm: the orthogonal factor of the polar decomposition, by Newton's method
/// (N. Higham, 1986). Each step squares the distance, of which the tolerance leaves little.
Eigen::Matrix3d nearest_rotation(const Eigen::Matrix3d& matrix) {
    const double deviation = (matrix.transpose() * matrix - Eigen::Matrix3d::Identity()).cwiseAbs().maxCoeff();
    if (!(deviation <= orthogonality_tolerance))
        throw InvalidInput("pose: matrix: the 3x3 part is not a rotation: " + other_than_turning(matrix) +
                           "; apply it to the vertices of the body (an entry of R^T R is off by " +
                           number_text(deviation, 6) + ", allowed are " + number_text(orthogonality_tolerance, 6) +
                           ")");
    if (matrix.determinant() < 0)
        throw InvalidInput("pose: matrix: the 3x3 part is a reflection: it mirrors; apply it to the vertices of the "
                           "body (its determinant is negative)");
    if (deviation <= rounding_tolerance)
        return matrix;
    Eigen::Matrix3d rotation = matrix;
    for (int step = 0; step < 3; ++step) { // to the mean of the matrix and the transpose of its inverse
        const Eigen::Vector3d a = rotation.col(0), b = rotation.col(1), c = rotation.col(2);
        Eigen::Matrix3d cofactors;
        cofactors << b.cross(c), c.cross(a), a.cross(b);
        rotation = 0.5 * (rotation + cofactors / a.dot(cofactors.col(0)));
    }
    return rotation;
}

/// The quaternion of a turn that carries axes to axes, of a length between 1/2 and 1: without a root it is exact.
Eigen::Quaterniond quarter_turns(const Eigen::Matrix3d& r) {
    int i = 0; // the axis that turns least
    if (r(1, 1) > r(0, 0))
        i = 1;
    if (r(2, 2) > r(i, i))
        i = 2;
    const int j = (i + 1) % 3, k = (i + 2) % 3;
    const double others = r(j, j) + r(k, k), w = 1 + r(i, i) + others, along = 1 + r(i, i) - others;
    Eigen::Quaterniond q(w, r(2, 1) - r(1, 2), r(0, 2) - r(2, 0), r(1, 0) - r(0, 1));
    if (along > w) {
        q.w() = r(k, j) - r(j, k);
        q.coeffs()[i] = along;
        q.coeffs()[j] = r(j, i) + r(i, j);
        q.coeffs()[k] = r(k, i) + r(i, k);
    }
    q.coeffs() *= 0.25;
    return q;
}

Eigen::Quaterniond quaternion_of(const Eigen::Matrix3d& rotation) {
    constexpr double rounding = 1e-15; // of sines and cosines of quarter turns
    const Eigen::Matrix3d whole = rotation.array().round();
    return (rotation - whole).cwiseAbs().maxCoeff() <= rounding ? quarter_turns(whole) : Eigen::Quaterniond(rotation);
}

} // namespace

bool motion::is_ordinary(const Pose& pose) {
    const auto size = [](double a, double b, double c) { return std::abs(a) + std::abs(b) + std::abs(c); };
    const Eigen::Vector3d& t = pose.translation;
    const auto& q = pose.rotation;
    const double sum =
        std::abs(q.w()) + size(q.x(), q.y(), q.z()); // the largest number is at least a quarter of the sum
    return size(t.x(), t.y(), t.z()) <= Pose::largest_length && sum >= 4 * least_size && sum <= largest_size;
}

Pose::Pose(const Eigen::Vector3d& translation_, const Eigen::Quaterniond& rotation_)
    : translation(translation_), rotation(in_safe_range(rotation_)) {
    require_usable(translation);
}

Pose::Pose(const Eigen::Isometry3d& isometry) : Pose(from_matrix(isometry.matrix())) {}

Pose Pose::from_matrix(const Eigen::Matrix4d& matrix) {
    if (!matrix.allFinite())
        throw InvalidInput("pose: matrix: a number is NaN or infinite");
    if (matrix.row(3) != Eigen::RowVector4d(0, 0, 0, 1))
        throw InvalidInput(matrix.col(3) == Eigen::Vector4d(0, 0, 0, 1)
                               ? "pose: matrix: the last row is not 0 0 0 1, but the last column is: transpose it"
                               : "pose: matrix: the last row is not 0 0 0 1");
    const Eigen::Matrix3d rotation = nearest_rotation(matrix.topLeftCorner<3, 3>());
    return Pose(matrix.topRightCorner<3, 1>(), quaternion_of(rotation));
}

Eigen::Isometry3d Pose::isometry() const {
    Eigen::Isometry3d result = Eigen::Isometry3d::Identity();
    // Eigen's conversion is not used: its packet operations may be fused.
    const auto matrix = motion::rotation_matrix<double>({rotation.w(), {rotation.x(), rotation.y(), rotation.z()}});
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j)
            result(i, j) = matrix.row[i][j];
    result.translation() = translation;
    return result;
}

} // namespace chasles
