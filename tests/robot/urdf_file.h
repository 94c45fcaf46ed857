// A URDF file of two links and a joint, in which a text is replaced by another one.
#pragma once

#include "chasles/robot/urdf_reader.h"

#include "tests/io/message_of.h"

namespace chasles::tests {

/// A robot of two links and a joint, in which a text is replaced by another one.
class UrdfFile : public FileTest {
protected:
    UrdfFile() {
        write("cube.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 1\nv 1 0 1\nv 1 1 1\nv 0 1 1\n"
                          "f 4 3 2 1\nf 5 6 7 8\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n");
    }
    [[nodiscard]] RobotDescription read(const std::string& text, const std::string& by,
                                        const RobotFiles& files = {}) const {
        std::string content = R"(<?xml version="1.0"?>
<robot name="small" version="1.2">
  <link name="base"/>
  <link name="arm"><visual><geometry><none/></geometry></visual>
    <collision><origin xyz="1 2 3" rpy="0.1 0.2 0.3"/><geometry><box size="1 2 3"/></geometry></collision>
  </link>
  <joint name="turn" type="revolute">
    <parent link="base"/><child link="arm"/><origin xyz="0 0 1"/><axis xyz="0 0 2"/>
    <limit lower="-1" upper="2" effort="1" velocity="1"/>
  </joint>
</robot>
)";
        if (const std::size_t at = content.find(text); at != std::string::npos)
            content.replace(at, text.size(), by);
        return robot::read_urdf(write("robot.urdf", content), files);
    }
    [[nodiscard]] std::string refused(const std::string& text, const std::string& by) const {
        return without_folder(message_of([&] { (void)read(text, by); }));
    }
    [[nodiscard]] Polyhedron shape_of(const std::string& geometry, const RobotFiles& files = {}) const {
        return read("<box size=\"1 2 3\"/>", geometry, files).links[1].collisions.at(0).shape;
    }
};

} // namespace chasles::tests
