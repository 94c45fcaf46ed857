// Any byte sequence as the path of a robot: a table, a trajectory of ROS as JSON, and one as YAML.
#include "chasles/base/invalid_input.h"
#include "cli/joint_trajectory.h"
#include "tests/fuzz/bytes.h"

#include <algorithm>

namespace chasles::fuzz {
namespace {

/// A joint that turns and one that slides.
const Robot& small_robot() {
    static const Robot robot([] {
        RobotDescription description{.name = "small", .links = {{"base"}, {"arm"}, {"hand"}}};
        description.joints = {{.name = "a", .type = JointType::revolute, .parent = "base", .child = "arm"},
                              {.name = "b", .type = JointType::prismatic, .parent = "arm", .child = "hand"}};
        return description;
    }());
    return robot;
}

template <class Read>
void demand_sound_path(const Read& read) {
    try {
        const robot::ConfigurationRows rows = read();
        demand(rows.configurations.size() >= 2, "a path has two configurations");
        for (const Configuration& values : rows.configurations)
            demand(values.size() == 2 && values.allFinite(), "configurations that are read are finite");
        demand(rows.stamps.empty() || rows.stamps.size() == rows.configurations.size(),
               "every configuration has a stamp");
        demand(std::ranges::is_sorted(rows.stamps), "stamps increase");
    } catch (const InvalidInput& error) { // refused, which is an answer
        demand(*error.what() != 0, "a refusal has a reason");
    }
}

} // namespace
} // namespace chasles::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace chasles;
    const std::string text(fuzz::text_of(data, size));
    const Robot& robot = fuzz::small_robot();
    fuzz::demand_sound_path([&] { return robot::read_configurations(text, robot); });
    fuzz::demand_sound_path([&] { return cli::read_joint_trajectory(text, true, robot); });
    fuzz::demand_sound_path([&] { return cli::read_joint_trajectory(text, false, robot); });
    return 0;
}
