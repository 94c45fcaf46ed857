// chasles/io/pose_text.h defines which numbers are a pose.
#include "python/src/poses.h"

#include "chasles/base/invalid_input.h"
#include "chasles/io/pose_text.h"

namespace chasles::python {
namespace {

/// The number of numbers of a pose with this shape; 0 if no pose has this shape.
std::size_t pose_size(std::span<const Py_ssize_t> shape) {
    if (shape.size() == 1 && shape[0] == 7)
        return 7;
    return shape.size() == 2 && shape[0] == 4 && shape[1] == 4 ? 16 : 0;
}

/// "NAME: WHY", also of a reason that begins with the name.
std::string placed(const std::string& name, const std::string& why) {
    return why.starts_with(name + ": ") ? why : name + ": " + why;
}

} // namespace

Pose pose_from(nb::handle argument, const char* name) {
    const DoubleArray array(argument, name);
    if (pose_size(array.shape()) == 0)
        throw InvalidInput(std::string(name) + ": the shape is " + array.shape_text() +
                           "; a pose has (4, 4), or (7,) for x y z qw qx qy qz");
    try {
        return io::pose_from_numbers(array.numbers());
    } catch (const InvalidInput& error) {
        throw InvalidInput(placed(name, error.what()));
    }
}

PoseArray::PoseArray(nb::handle argument, const std::string& name) : array_(argument, name) {
    const auto shape = array_.shape();
    const bool is_empty = shape.size() == 1 && shape[0] == 0; // NumPy's shape of []
    numbers_ = is_empty ? 7 : shape.size() > 1 ? pose_size(shape.subspan(1)) : 0;
    if (numbers_ == 0)
        throw InvalidInput(name + ": the shape is " + array_.shape_text() +
                           "; poses have (n, 4, 4), or (n, 7) for x y z qw qx qy qz");
    size_ = std::size_t(shape[0]);
}

Pose PoseArray::operator[](std::size_t index) const {
    return io::pose_from_numbers(array_.numbers().subspan(index * numbers_, numbers_));
}

std::vector<Pose> poses_from(nb::handle argument, const std::string& name) {
    const PoseArray array(argument, name);
    std::vector<Pose> poses(array.size());
    for (std::size_t i = 0; i < poses.size(); ++i)
        try {
            poses[i] = array[i];
        } catch (const InvalidInput& error) {
            throw InvalidInput(name + "[" + std::to_string(i) + "]: " + error.what());
        }
    return poses;
}

nb::object matrix_of(const Pose& pose) {
    const Eigen::Matrix<double, 4, 4, Eigen::RowMajor> matrix = pose.isometry().matrix();
    return array_of(std::span(matrix.data(), 16), {4, 4});
}

nb::object numbers_of(const Pose& pose) {
    const auto& t = pose.translation;
    const auto& q = pose.rotation;
    const std::array numbers{t.x(), t.y(), t.z(), q.w(), q.x(), q.y(), q.z()};
    return array_of(numbers, {7});
}

} // namespace chasles::python
