// A pose accepts every rigid displacement, and refuses any other input with a reason.
#include "chasles/motion/pose.h"

#include "tests/support/refusal.h"

#include <cmath>
#include <functional>
#include <gtest/gtest.h>
#include <limits>

namespace chasles {
namespace {

using test::refusal;

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr double infinity = std::numeric_limits<double>::infinity();

void expect_refused(const std::function<void()>& make, const std::string& reason) {
    const std::string message = refusal(make);
    EXPECT_NE(message.find(reason), std::string::npos) << message;
    EXPECT_EQ(message.find('\n'), std::string::npos) << "more than one line";
}

Eigen::Matrix4d quarter_turn() {
    Eigen::Matrix4d matrix;
    matrix << 0, -1, 0, 3, 1, 0, 0, 4, 0, 0, 1, 5, 0, 0, 0, 1;
    return matrix;
}

TEST(Pose, DefaultMovesNothing) {
    EXPECT_TRUE(Pose().isometry().isApprox(Eigen::Isometry3d::Identity(), 0));
}

TEST(Pose, QuaternionOfAnyLengthIsTheSameRotation) {
    const Eigen::Quaterniond q(0.5, -0.1, 0.7, 0.2);
    const Eigen::Isometry3d expected = Pose({1, 2, 3}, q).isometry();
    for (const double factor : {1e-300, 1e-150, 0.125, 3.0, 1e150, 1e300}) {
        const Pose scaled({1, 2, 3}, Eigen::Quaterniond(q.coeffs() * factor));
        EXPECT_TRUE(scaled.isometry().isApprox(expected, 1e-15)) << "factor " << factor;
    }
}

TEST(Pose, QuaternionIsKeptExactlyUpToAPowerOfTwo) {
    const Eigen::Quaterniond q(0.5e200, -0.1e200, 0.7e200, 0.2e200);
    const Eigen::Quaterniond kept = Pose({0, 0, 0}, q).rotation;
    const double factor = kept.w() / q.w();
    EXPECT_EQ(std::exp2(std::ilogb(factor)), factor);
    EXPECT_EQ(kept.coeffs(), Eigen::Vector4d(q.coeffs() * factor));
}

/// One number at any position is set to values from zero to infinity, on both sides of every limit.
TEST(Pose, WhatLooksOrdinaryIsTakenAsItIs) {
    int ordinary = 0, other = 0;
    for (const double number :
         {0.0, 1e-300, 0.9e-3, 1e-3, 0.004, 1.0, 249.0, 999.0, 1001.0, 0.9e30, 1.1e30, 1e300, infinity, -infinity, nan})
        for (int place = 0; place < 7; ++place)
            for (const double rest : {0.0, 1e-4, 0.5}) {
                Pose pose;
                pose.rotation.coeffs().setConstant(rest);
                (place < 3 ? pose.translation[place] : pose.rotation.coeffs()[place - 3]) = number;
                const bool is_ordinary = motion::is_ordinary(pose);
                (is_ordinary ? ordinary : other) += 1;
                if (!is_ordinary)
                    continue;
                const Pose taken(pose.translation, Eigen::Quaterniond(pose.rotation));
                EXPECT_EQ(taken.translation, pose.translation);
                EXPECT_EQ(taken.rotation.coeffs(), pose.rotation.coeffs());
            }
    EXPECT_GT(ordinary, 70);
    EXPECT_GT(other, 100);
}

TEST(Pose, NonFiniteNumbersAreRefused) {
    const Eigen::Quaterniond none(1, 0, 0, 0);
    for (const double bad : {nan, infinity, -infinity}) {
        expect_refused([&] { Pose({0, bad, 0}, none); }, "pose: translation: a number is NaN or infinite");
        Eigen::Matrix4d matrix = quarter_turn();
        matrix(1, 2) = bad;
        expect_refused([&] { Pose::from_matrix(matrix); }, "pose: matrix: a number is NaN or infinite");
    }
}

TEST(Pose, QuaternionsThatAreNotFiniteAreRefused) {
    for (const double bad : {nan, infinity, -infinity})
        for (Eigen::Index i = 0; i < 4; ++i) {
            Eigen::Quaterniond q(1, 2, 3, 4);
            q.coeffs()[i] = bad;
            expect_refused([&] { Pose({0, 0, 0}, q); }, "pose: quaternion: a number is NaN or infinite");
        }
}

TEST(Pose, ZeroQuaternionIsRefused) {
    expect_refused([] { Pose({0, 0, 0}, Eigen::Quaterniond(0, 0, 0, 0)); }, "zero");
    EXPECT_EQ(refusal([] { Pose({0, 0, 0}, Eigen::Quaterniond(0, 0, 0, 5e-324)); }), "accepted");
}

TEST(Pose, TranslationBeyondAllScenesIsRefused) {
    const Eigen::Quaterniond none(1, 0, 0, 0);
    expect_refused([&] { Pose({0, 0, -2e30}, none); }, "larger than 1e30");
    EXPECT_EQ(refusal([&] { Pose({1e30, 0, 0}, none); }), "accepted");
}

TEST(Pose, MatrixGivesRotationAndTranslation) {
    const Pose pose = Pose::from_matrix(quarter_turn());
    EXPECT_EQ(pose.translation, Eigen::Vector3d(3, 4, 5));
    EXPECT_TRUE((pose.isometry() * Eigen::Vector3d(1, 0, 0)).isApprox(Eigen::Vector3d(3, 5, 5), 1e-15));
}

/// All 24 turns that carry axes to axes.
TEST(Pose, MatrixOfQuarterTurnsIsExact) {
    int turns = 0;
    for (int code = 0; code < 6 * 6 * 6; ++code) {
        Eigen::Matrix4d matrix = Eigen::Matrix4d::Identity();
        for (int column = 0, left = code; column < 3; ++column, left /= 6)
            matrix.block<3, 1>(0, column) = Eigen::Vector3d::Unit(left % 6 / 2) * (left % 2 == 0 ? 1 : -1);
        if (matrix.determinant() != 1)
            continue;
        ++turns;
        const Pose pose = Pose::from_matrix(matrix);
        EXPECT_EQ(pose.isometry().matrix(), matrix) << matrix;
        const Eigen::Vector4d numbers = 4 * pose.rotation.coeffs();
        EXPECT_EQ(numbers, numbers.array().round().matrix()) << matrix;
        matrix(0, 0) += 6e-17; // as of a cosine
        EXPECT_EQ(Pose::from_matrix(matrix).rotation.coeffs(), pose.rotation.coeffs()) << matrix;
    }
    EXPECT_EQ(turns, 24);
}

TEST(Pose, MatrixOfSixDigitsIsProjectedToARotation) {
    const Eigen::Matrix3d truth = Eigen::AngleAxisd(0.7, Eigen::Vector3d(1, -2, 3).normalized()).toRotationMatrix();
    Eigen::Matrix4d printed = Eigen::Matrix4d::Identity();
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j)
            printed(i, j) = std::round(truth(i, j) * 1e6) / 1e6;
    const Eigen::Matrix3d kept = Pose::from_matrix(printed).isometry().linear();
    EXPECT_LT((kept.transpose() * kept - Eigen::Matrix3d::Identity()).cwiseAbs().maxCoeff(), 1e-15);
    EXPECT_LT((kept - truth).cwiseAbs().maxCoeff(), 1e-6);
    // The nearest rotation is where R^T times the matrix is symmetric.
    const Eigen::Matrix3d product = kept.transpose() * printed.topLeftCorner<3, 3>();
    EXPECT_LT((product - product.transpose()).cwiseAbs().maxCoeff(), 1e-15);
}

TEST(Pose, MatrixThatScalesIsRefused) {
    Eigen::Matrix4d matrix = quarter_turn();
    matrix.topLeftCorner<3, 3>() *= 1.0001;
    expect_refused([&] { Pose::from_matrix(matrix); }, "not a rotation");
}

TEST(Pose, MatrixThatMirrorsIsRefused) {
    Eigen::Matrix4d matrix = quarter_turn();
    matrix(2, 2) = -1;
    expect_refused([&] { Pose::from_matrix(matrix); }, "reflection");
}

TEST(Pose, RefusalNamesWhatTheMatrixDoes) {
    const auto expect_named = [](const Eigen::Matrix3d& map, const char* what) {
        Eigen::Matrix4d matrix = quarter_turn();
        matrix.topLeftCorner<3, 3>() *= map;
        expect_refused([&] { Pose::from_matrix(matrix); }, what);
    };
    Eigen::Matrix3d shear = Eigen::Matrix3d::Identity();
    shear(0, 1) = 0.5;
    expect_named(Eigen::Vector3d(3, 3, 3).asDiagonal(), "it scales by 3;");
    expect_named(Eigen::Vector3d(1, 2, 0.5).asDiagonal(), "it scales by 1, 2, 0.5 along x, y, z;");
    expect_named(Eigen::Vector3d(-2, 2, 2).asDiagonal(), "it scales by 2, and mirrors;");
    expect_named(Eigen::Vector3d(1, 1, 0).asDiagonal(), "it flattens bodies;");
    expect_named(shear, "it shears;");
    expect_named(Eigen::Vector3d(1, 1, -1).asDiagonal(), "it mirrors;");
}

TEST(Pose, TransposedMatrixIsRefusedWithTheWayOut) {
    Eigen::Matrix4d matrix = quarter_turn().transpose();
    matrix.row(3) = Eigen::RowVector4d(5, 0, 0, 1);
    expect_refused([&] { Pose::from_matrix(matrix); }, "transpose it");
}

TEST(Pose, MatrixWithAnotherLastRowIsRefused) {
    Eigen::Matrix4d matrix = quarter_turn();
    matrix(3, 0) = 1e-9;
    expect_refused([&] { Pose::from_matrix(matrix); }, "last row");
}

TEST(Pose, IsometryIsTakenAsItStands) {
    Eigen::Isometry3d isometry = Eigen::Isometry3d::Identity();
    isometry.rotate(Eigen::AngleAxisd(1.1, Eigen::Vector3d::UnitY()));
    isometry.translation() = Eigen::Vector3d(-1, 0, 2);
    const Pose pose = isometry;
    EXPECT_TRUE(pose.isometry().isApprox(isometry, 1e-15));
}

} // namespace
} // namespace chasles
