// Clouds of points in files.
#include "chasles/io/point_files.h"

#include "chasles/mesh/primitives.h"
#include "tests/support/own_file.h"
#include "tests/support/refusal.h"

#include <bit>
#include <fstream>
#include <gtest/gtest.h>

namespace chasles::test {
namespace {

using Eigen::Vector3d;
using io::read_pcd;
using io::read_point_table;
using Points = std::vector<Vector3d>;

const Points wanted{{1, 2, 3}, {-0.5, 0, 1e3}};

std::string header(const std::string& data, const std::string& points = "2") {
    return "# .PCD v0.7\nVERSION 0.7\nFIELDS x rgb y z\nSIZE 4 4 8 4\nTYPE F U F F\nCOUNT 1 2 1 1\nWIDTH " + points +
           "\nHEIGHT 1\nVIEWPOINT 0 0 0 1 0 0 0\nPOINTS " + points + "\nDATA " + data + "\n";
}

template <class Number>
std::string bytes_of(Number number) {
    const auto bytes = std::bit_cast<std::array<char, sizeof(Number)>>(number);
    return {bytes.begin(), bytes.end()};
}

std::string binary(const Vector3d& point) {
    return bytes_of(float(point.x())) + std::string(8, 'x') + bytes_of(point.y()) + bytes_of(float(point.z()));
}

TEST(PointFiles, PcdInBothForms) {
    EXPECT_EQ(read_pcd(header("ascii") + "1 7 7 2 3\n-0.5 0 0 0 1e3\n"), wanted);
    EXPECT_EQ(read_pcd(header("binary") + binary(wanted[0]) + binary(wanted[1])), wanted);
    const std::string unseen = binary(Vector3d::Constant(std::nan("")));
    EXPECT_EQ(read_pcd(header("binary", "3") + binary(wanted[0]) + unseen + binary(wanted[1])), wanted);
    EXPECT_EQ(read_pcd(header("ascii", "3") + "1 7 7 2 3\nnan 0 0 nan nan\n-0.5 0 0 0 1e3\n"), wanted);
}

TEST(PointFiles, PcdIsRefusedWithTheReason) {
    const auto why = [](const std::string& bytes) { return refusal([&] { (void)read_pcd(bytes); }); };
    EXPECT_EQ(why("VERSION 0.7\n"), "ends before DATA");
    EXPECT_EQ(why(header("binary") + binary(wanted[0])), "ends after 1 of 2 points");
    EXPECT_EQ(why(header("ascii") + "1 7 7 2 3\n"), "ends after 1 of 2 points");
    EXPECT_EQ(why(header("ascii") + "1 7 7 2\n"), "line 12: has 4 numbers, and its fields have 5");
    EXPECT_EQ(why(header("ascii") + "1 7 7 2 x\n"), "line 12: has no number z: 'x'");
    EXPECT_EQ(why(header("ascii") + "1 7 7 2 1e400\n"), "line 12: has no number z: '1e400'");
    EXPECT_EQ(why(header("ascii") + "1 7 7 2 3\n1 7 7 2 3\n\n1 7 7 2 3\n"), "has more points than its header says (2)");
    EXPECT_EQ(why(header("binary") + std::string(80, 'x')), "has more points than its header says (2)");
    EXPECT_EQ(why(header("binary_compressed")),
              "DATA binary_compressed is not read; write the cloud as binary or ascii (pcl_convert_pcd_ascii_binary)");
    EXPECT_EQ(why("FIELDS x y\nSIZE 4 4 4\n"), "line 2: SIZE has another number of values than FIELDS");
    EXPECT_EQ(why("SIZE 4 4 4\n"), "line 1: there is no line FIELDS before SIZE");
    EXPECT_EQ(why("FIELDS x y z\nDATA ascii\n"), "has no line POINTS, and no line WIDTH");
    EXPECT_EQ(why("FIELDS x y z\nWIDTH 2\nPOINTS 3\nDATA ascii\n"), "WIDTH times HEIGHT is 2, but POINTS is 3");
    EXPECT_EQ(why("FIELDS x y z\nTYPE I F F\nSIZE 8 4 4\nPOINTS 1\nDATA ascii\n1 2 3\n"),
              "the field x needs the TYPE F, the SIZE 4 or 8 and the COUNT 1");
    EXPECT_EQ(why("FIELDS x y\nPOINTS 1\nDATA ascii\n1 2\n"), "there is no field z");
    EXPECT_EQ(why("FIELDS x\nSIZE -1\n"), "line 2: '-1' is no count");
    EXPECT_EQ(why("FIELDS x\nSIZE 0\n"), "line 2: a number has 1, 2, 4 or 8 bytes, not 0");
    EXPECT_EQ(why("POINTS 99999999999\n"), "line 1: '99999999999' is no count");
}

TEST(PointFiles, PcdMayLeaveOutOneOfItsCounts) {
    const std::string start = "FIELDS x y z\nSIZE 4 4 4\nTYPE F F F\n", rows = "DATA ascii\n1 2 3\n-0.5 0 1e3\n\n";
    for (const char* const counts : {"POINTS 2\n", "WIDTH 2\n", "WIDTH 1\nHEIGHT 2\n", "WIDTH 2\nHEIGHT 1\nPOINTS 2\n"})
        EXPECT_EQ(read_pcd(start + counts + rows), wanted) << counts;
    EXPECT_EQ(read_pcd(header("binary") + binary(wanted[0]) + binary(wanted[1]) + "pad"), wanted)
        << "less than a point";
}

TEST(PointFiles, TablesByNameOrInOrder) {
    EXPECT_EQ(read_point_table("1 2 3\n-0.5 0 1e3 17 18\n"), wanted);
    EXPECT_EQ(read_point_table("# from a scanner\n1,2,3\n-0.5,0,1e3\n"), wanted);
    EXPECT_EQ(read_point_table("z,intensity,X,y\n3,9,1,2\n1e3,9,-0.5,0\n"), wanted);
    EXPECT_EQ(read_point_table("X [m],Y [m],Z [m]\n1,2,3\n-0.5,0,1e3\n"), wanted);
    EXPECT_EQ(read_point_table("//X Y Z R G B\n1 2 3 9 9 9\n-0.5 0 1e3 9 9 9\n"), wanted);
    EXPECT_EQ(refusal([] { (void)read_point_table("x,y\n1,2\n"); }),
              "the header 'x, y' has no column z; it needs the columns x, y, z in any order");
    EXPECT_EQ(refusal([] { (void)read_point_table("1 2 3\n1 nan 3\n"); }), "line 2: has no number y in column 2");
    EXPECT_EQ(refusal([] { (void)read_point_table("1 2\n"); }), "line 1: has no number z in column 3");
}

std::filesystem::path written(const std::string& name, const std::string& text) {
    const std::filesystem::path file = own_file(name);
    std::ofstream(file) << text;
    return file;
}

TEST(PointFiles, ABodyOfThem) {
    const auto ply = written("cloud.ply", "ply\nformat ascii 1.0\nelement vertex 2\nproperty float x\n"
                                          "property float y\nproperty float z\nend_header\n1 2 3\n-0.5 0 1e3\n");
    const Polyhedron cloud = load_points(ply, 0.25);
    EXPECT_EQ(Points(cloud.vertices().begin(), cloud.vertices().end()), wanted);
    EXPECT_EQ(cloud.radius(), 0.25);
    const auto packed = written("packed.xyz", "\x1F\x8B xyz");
    EXPECT_NE(refusal([&] { (void)load_points(packed, 1); }).find("is compressed by gzip"), std::string::npos);
    const std::string door = "the key \"points\" of a scene file or, in Python, load_points reads it";
    EXPECT_NE(refusal([&] { (void)Polyhedron::load(ply); }).find("As a cloud of points, " + door), std::string::npos);
    EXPECT_NE(refusal([&] { (void)Polyhedron::load(packed); }).find("gzip"), std::string::npos);
    const auto other = written("cloud.las", "x"), empty = written("cloud.xyz", "# nothing\n");
    EXPECT_NE(refusal([&] { (void)load_points(other, 1); }).find("no reader of points for the extension '.las'"),
              std::string::npos);
    EXPECT_NE(refusal([&] { (void)load_points(empty, 1); }).find("points: needs at least one point"),
              std::string::npos);
    for (const auto& file : {ply, packed, other, empty})
        std::filesystem::remove(file);
}

} // namespace
} // namespace chasles::test
