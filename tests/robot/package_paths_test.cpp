// Names of mesh files as they are written on other systems.
#include "chasles/robot/package_paths.h"

#include "tests/robot/urdf_file.h"

namespace chasles::tests {
namespace {

class PackagePaths : public UrdfFile {
protected:
    PackagePaths() {
        std::filesystem::create_directories(path("arm/new meshes"));
        std::filesystem::copy_file(path("cube.obj"), path("arm/new meshes/part.obj"));
        write("robot.urdf", "");
    }
    [[nodiscard]] bool finds(const std::string& uri) const {
        return std::filesystem::equivalent(robot::found_file(uri, path("robot.urdf"), {}).path,
                                           path("arm/new meshes/part.obj"));
    }
    [[nodiscard]] std::string fault(const std::string& uri) const {
        return without_folder(message_of([&] { (void)robot::found_file(uri, path("robot.urdf"), {}); }));
    }
};

TEST_F(PackagePaths, ReadNamesOfOtherSystems) {
    const std::string folder = path("").string();
    EXPECT_TRUE(finds("package://arm/new meshes/part.obj"));
    EXPECT_TRUE(finds("package://arm/new%20meshes/part.obj"));
    EXPECT_TRUE(finds("package://arm\\new meshes\\part.obj"));
    EXPECT_TRUE(finds("arm\\new meshes\\part.obj"));
    EXPECT_TRUE(finds("./arm/../arm/new%20meshes/part.obj"));
    EXPECT_TRUE(finds("file://" + folder + "arm/new%20meshes/part.obj"));
    EXPECT_TRUE(finds("file://localhost" + folder + "arm/new meshes/part.obj"));
    EXPECT_TRUE(finds("file:" + folder + "arm/new meshes/part.obj"));
}

/// A name with a percent sign of its own is found as it is.
TEST_F(PackagePaths, TryTheNameAsItIsFirst) {
    write("50%20.obj", "");
    write("50 .obj", "");
    EXPECT_EQ(robot::found_file("50%20.obj", path("robot.urdf"), {}).path, path("50%20.obj"));
}

TEST_F(PackagePaths, SayWhereTheyLooked) {
    const std::string far = "package://leg/a/quite/long/name/of/a/folder/with/meshes/of/the/robot/part.obj";
    EXPECT_EQ(fault(far).find("there is no file '" + far + "'; tried "), 0U);
    const std::string way_out =
        "; say where the package is by --packages leg=FOLDER (in Python: packages={'leg': FOLDER})";
    EXPECT_TRUE(fault(far).ends_with(way_out)) << fault(far);
    const RobotFiles others = {.packages = {{"arm", path("arm")}}};
    const std::string with_others = message_of([&] { (void)robot::found_file(far, path("robot.urdf"), others); });
    EXPECT_TRUE(with_others.ends_with(way_out)) << with_others;
    const RobotFiles wrong = {.packages = {{"leg", path("arm")}}};
    const std::string with_wrong = message_of([&] { (void)robot::found_file(far, path("robot.urdf"), wrong); });
    EXPECT_TRUE(with_wrong.ends_with(way_out)) << with_wrong;
    EXPECT_EQ(fault("part%.obj"), "there is no file 'part%.obj'; tried part%.obj");
    EXPECT_EQ(fault("package://arm"), "'package://arm' names no file in a package");
    EXPECT_EQ(fault("http://host/part.obj"), "'http://host/part.obj' is no package://, no file:// and no path");
}

/// In a folder of the package's name, that folder is also NAME in the one above.
TEST_F(PackagePaths, NameEachPlaceOnce) {
    std::filesystem::create_directories(path("leg"));
    write("leg/robot.urdf", "");
    const std::string message =
        message_of([&] { (void)robot::found_file("package://leg/mesh.obj", path("leg/robot.urdf"), {}); });
    const std::string place = path("leg/mesh.obj").string();
    ASSERT_NE(message.find("tried " + path("leg/leg/mesh.obj").string() + ", " + place + ", "), std::string::npos)
        << message;
    EXPECT_EQ(message.find(place), message.rfind(place)) << message;
    EXPECT_EQ(fault("no\\mesh.obj"), "there is no file 'no\\mesh.obj'; tried no\\mesh.obj, no/mesh.obj");
}

/// The file may be one of another package.
TEST_F(PackagePaths, SayWhichPackageIsMissing) {
    const auto missing = [&](const std::string& uri, const RobotFiles& files = {}) {
        return robot::found_file(uri, path("robot.urdf"), files).missing_package;
    };
    EXPECT_EQ(missing("package://arm/new meshes/part.obj"), "");
    EXPECT_EQ(missing("arm/new meshes/part.obj"), "");
    EXPECT_EQ(missing("package://leg/arm/new%20meshes/part.obj"), "leg");
    EXPECT_EQ(missing("package://leg/new%20meshes/part.obj", {.packages = {{"leg", path("arm")}}}), "");
}

TEST_F(PackagePaths, SayWhichGivenPackageIsUsed) {
    const RobotFiles files = {.packages = {{"leg", path("arm")}}};
    const auto used = [&](const std::string& uri) {
        return robot::found_file(uri, path("robot.urdf"), files).given_package;
    };
    EXPECT_EQ(used("package://leg/new%20meshes/part.obj"), "leg");
    EXPECT_EQ(used("package://arm/new meshes/part.obj"), "");
}

} // namespace
} // namespace chasles::tests
