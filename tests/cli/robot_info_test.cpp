// chasles info of a robot: joints with the names of their variables, limits, links, shapes, pairs.
#include "tests/cli/cli_test_files.h"

#include <nlohmann/json.hpp>

namespace chasles {
namespace {

using Json = nlohmann::json;

class RobotInfo : public tests::CommandLine {
protected:
    RobotInfo() {
        write("cart.urdf", R"(<robot name="cart">
 <link name="world"/>
 <link name="cart"><collision><geometry><box size="1 1 1"/></geometry></collision></link>
 <link name="mast"><collision><geometry><box size="1 1 1"/></geometry></collision></link>
 <link name="left"><collision><origin xyz="0 0 9"/><geometry><mesh filename="cube.obj"/></geometry></collision></link>
 <link name="right"><collision><origin xyz="0 9 9"/><geometry><mesh filename="cube.obj"/></geometry></collision></link>
 <joint name="drive" type="planar"><parent link="world"/><child link="cart"/><axis xyz="0 0 1"/></joint>
 <joint name="glue" type="fixed"><parent link="cart"/><child link="mast"/></joint>
 <joint name="turn" type="revolute"><parent link="mast"/><child link="left"/><axis xyz="0 0 1"/><limit lower="-1" upper="2"/></joint>
 <joint name="also" type="revolute"><parent link="mast"/><child link="right"/><axis xyz="0 0 1"/><limit lower="-9" upper="9"/>
  <mimic joint="turn" multiplier="-1"/></joint>
</robot>)");
        write("cart.srdf", R"(<robot name="cart"><disable_collisions link1="cart" link2="left"/>
 <disable_collisions link1="cart" link2="leg"/><group name="arm"><joint name="turn"/></group>
 <group_state name="home" group="arm"><joint name="turn" value="0"/></group_state></robot>)");
    }
};

TEST_F(RobotInfo, ListsWhatTheRobotHas) {
    const tests::Finished found = run("info cart.urdf --srdf cart.srdf");
    EXPECT_EQ(found.status, 0);
    EXPECT_EQ(found.out, R"(cart.urdf: robot cart, 5 links, 4 variables
  joint     drive: planar, world to cart
              drive/x, without limits
              drive/y, without limits
              drive/theta, continuous
  joint     glue: fixed, cart to mast
  joint     turn: revolute, mast to left, -1 to 2
  joint     also: revolute, mast to right, follows turn: -1 times its value, plus 0
  link      world: no shapes
  link      cart: 1 shape, 6 faces
  link      mast: 1 shape, 6 faces
  link      left: 1 shape, 6 faces
  link      right: 1 shape, 6 faces
  state     home of arm
  tested    2 pairs: cart and right, left and right
  untested  8 pairs: 4 without shapes (world), 1 at rest (cart and mast), 2 adjacent (mast and left, mast and right), 1 disabled by a file (cart and left)
)");
    EXPECT_EQ(found.err, "chasles: warning: cart.srdf:2: <disable_collisions>: there is no link 'leg'\n");
}

TEST_F(RobotInfo, IsOneObject) {
    const Json robot = Json::parse(run("info cart.urdf --srdf cart.srdf --json").out);
    EXPECT_EQ(robot["name"], "cart");
    ASSERT_EQ(robot["joints"].size(), 4U);
    EXPECT_EQ(robot["joints"][0]["variables"][2]["name"], "drive/theta");
    EXPECT_EQ(robot["joints"][0]["variables"][2]["continuous"], true);
    EXPECT_TRUE(robot["joints"][0]["variables"][0]["lower"].is_null());
    EXPECT_EQ(robot["joints"][2]["variables"][0]["upper"], 2);
    EXPECT_EQ(robot["joints"][3]["variables"], Json::array());
    EXPECT_EQ(robot["joints"][3]["mimic"]["joint"], "turn");
    EXPECT_EQ(robot["links"][1], Json({{"name", "cart"}, {"shapes", 1}, {"faces", 6}}));
    EXPECT_EQ(robot["groups"][0]["joints"], Json({"turn"}));
    EXPECT_EQ(robot["states"][0]["name"], "home");
    EXPECT_EQ(robot["tested"], Json::parse(R"([["cart", "right"], ["left", "right"]])"));
    EXPECT_EQ(robot["untested"]["pairs"], 8);
    EXPECT_EQ(robot["warnings"].size(), 1U);
}

TEST_F(RobotInfo, RefusesOptionsOfRobotsForMeshes) {
    EXPECT_EQ(error_line("info cube.obj --srdf cart.srdf"),
              "chasles: --srdf, --packages: are for robots, and 'cube.obj' does not end in .urdf");
    EXPECT_EQ(error_line("info no.urdf"), "chasles: no.urdf: no such file");
}

} // namespace
} // namespace chasles
