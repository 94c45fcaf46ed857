// How a motion was made, for pickle: a maker, its numbers, and the motions that it was made of.
//
// A motion of the library does not tell how it was made. So a Python object of a motion keeps the recipe, and pickle
// keeps the steps of the recipe: the same makers with the same numbers make the same motion, bit for bit.
#pragma once

#include "python/src/motions.h"

#include <string_view>
#include <vector>

namespace chasles::python {

/// Lists of numbers: points, coefficients, poses one after another.
using Numbers = std::vector<std::vector<double>>;

/// Shared by all motions that were made of this one. Destroyed with the GIL.
struct Recipe {
    std::string_view maker; ///< a name that `made` knows, or `own_maker`
    Numbers numbers;
    mutable std::vector<std::shared_ptr<const Recipe>> parts = {};
    nb::handle functions = {}; ///< of a trajectory of the user's own: one of the owners of the motion

    static constexpr std::string_view own_maker = "trajectory";

    Recipe(std::string_view maker_, Numbers numbers_) : maker(maker_), numbers(std::move(numbers_)) {}
    /// Without recursion: the rest of a straight motion may be a rest many thousand times over.
    ~Recipe();
    Recipe(const Recipe&) = delete;
    Recipe& operator=(const Recipe&) = delete;
};

/// What the maker makes of numbers and of other motions. Throws InvalidInput.
PlainMotion made(std::string_view maker, Numbers numbers, const std::vector<PlainMotion>& parts = {});

/// The numbers of poses, points and vectors.
std::vector<double> listed(std::span<const Pose> poses);
std::vector<double> listed(const Pose& pose);
std::vector<double> listed(std::span<const Eigen::Vector3d> points);
std::vector<double> listed(const Eigen::Vector3d& point);

/// The track of the maker "track": its numbers are the stamps, the poses, 1 for twists, and the centre.
TimedPoses track_of(const Numbers& numbers);

/// The steps of the recipe for pickle. A step has the name of its maker, its numbers, and the indices of earlier steps.
nb::tuple state_of(const PlainMotion& motion);
/// The inverse. Throws InvalidInput for steps that are no motion.
PlainMotion motion_of_state(const nb::tuple& steps);

} // namespace chasles::python
