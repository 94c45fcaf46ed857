#include "tests/data/rigid_ipc.h"

#include "chasles/io/mesh_files.h"

#include <algorithm>
#include <array>
#include <fstream>
#include <limits>
#include <map>
#include <nlohmann/json.hpp>
#include <numbers>
#include <set>

namespace chasles::test {
namespace {

using Eigen::Vector3d;
using Json = nlohmann::json;

constexpr double degree = std::numbers::pi / 180;

Vector3d vector_of(const Json& list) {
    return {list.at(0).get<double>(), list.at(1).get<double>(), list.at(2).get<double>()};
}

Vector3d vector_in(const Json& body, const char* key, const Vector3d& otherwise = Vector3d::Zero()) {
    return body.contains(key) ? vector_of(body[key]) : otherwise;
}

/// About the fixed axes x, y, z in this order.
Eigen::Quaterniond turn_in(const Json& body) {
    const Vector3d angles = degree * vector_in(body, "rotation");
    return Eigen::Quaterniond(Eigen::AngleAxisd(angles.z(), Vector3d::UnitZ()) *
                              Eigen::AngleAxisd(angles.y(), Vector3d::UnitY()) *
                              Eigen::AngleAxisd(angles.x(), Vector3d::UnitX()));
}

/// A wire has no faces, and a body of Chasles needs one. Each edge becomes a triangle of a millionth of a metre, away
/// from the middle of all.
io::PolygonSoup wire_in(const Json& body) {
    io::PolygonSoup soup;
    Vector3d middle = Vector3d::Zero();
    for (const Json& vertex : body.at("vertices"))
        soup.vertices.push_back(vector_of(vertex));
    for (const Vector3d& vertex : soup.vertices)
        middle += vertex / double(soup.vertices.size());
    for (const Json& edge : body.at("edges")) {
        const auto a = edge.at(0).get<std::uint32_t>(), b = edge.at(1).get<std::uint32_t>();
        const Vector3d half = (soup.vertices[a] + soup.vertices[b]) / 2;
        soup.faces.push_back({a, b, std::uint32_t(soup.vertices.size())});
        soup.vertices.emplace_back(half + 1e-6 * (half - middle).normalized());
    }
    return soup;
}

Vector3d scale_in(const Json& body, const std::vector<Vector3d>& vertices) {
    if (body.contains("dimensions")) {
        Eigen::AlignedBox3d box;
        for (const Vector3d& vertex : vertices)
            box.extend(vertex);
        const Vector3d sizes = box.sizes();
        return vector_of(body["dimensions"]).cwiseQuotient((sizes.array() == 0).select(1, sizes));
    }
    if (body.contains("scale") && body["scale"].is_number())
        return Vector3d::Constant(body["scale"].get<double>());
    return vector_in(body, "scale", Vector3d::Ones());
}

/// Of the volume, or of the surface where there is none.
Vector3d centre_of_mass(const io::PolygonSoup& soup) {
    double volume = 0, area = 0;
    Vector3d of_volume = Vector3d::Zero(), of_area = Vector3d::Zero();
    for (const auto& face : soup.faces) { // all are triangles
        const Vector3d &a = soup.vertices[face[0]], &b = soup.vertices[face[1]], &c = soup.vertices[face[2]];
        const double tetrahedron = a.dot(b.cross(c)) / 6, triangle = (b - a).cross(c - a).norm() / 2;
        volume += tetrahedron;
        area += triangle;
        of_volume += tetrahedron * (a + b + c) / 4;
        of_area += triangle * (a + b + c) / 3;
    }
    return soup.faces.size() >= 4 && volume > 0 ? Vector3d(of_volume / volume) : Vector3d(of_area / area);
}

struct FixtureShape {
    Polyhedron polyhedron;
    Vector3d centre; ///< of mass, from the origin of the scaled mesh
};

/// Bodies with the same mesh and scale share their shape.
class Shapes {
public:
    explicit Shapes(std::filesystem::path folder) : folder_(std::move(folder)) {}

    const FixtureShape& get(const Json& body) {
        const std::string key = body.value("mesh", "") + body.value("scale", Json()).dump() +
                                body.value("dimensions", Json()).dump() + body.value("vertices", Json()).dump();
        const auto found = shapes_.find(key);
        return found != shapes_.end() ? found->second : shapes_.emplace(key, make(body)).first->second;
    }

private:
    [[nodiscard]] FixtureShape make(const Json& body) const {
        io::PolygonSoup soup =
            body.contains("mesh") ? io::load_polygons(folder_ / body["mesh"].get<std::string>()) : wire_in(body);
        const Vector3d scale = scale_in(body, soup.vertices);
        for (Vector3d& vertex : soup.vertices)
            vertex = vertex.cwiseProduct(scale).eval();
        const Vector3d centre = centre_of_mass(soup);
        for (Vector3d& vertex : soup.vertices)
            vertex -= centre;
        return {Polyhedron::from_polygons(soup.vertices, soup.faces), centre};
    }

    std::filesystem::path folder_;
    std::map<std::string, FixtureShape> shapes_;
};

using Freedoms = std::array<double, 6>; ///< 1 for a freedom, 0 for a fixed one

Freedoms freedoms_in(const Json& body) {
    Freedoms freedoms;
    const Json fixed = body.value("is_dof_fixed", Json(false));
    for (std::size_t i = 0; i < 6; ++i)
        freedoms[i] = (fixed.is_boolean() ? fixed : fixed.at(i)).get<bool>() ? 0 : 1;
    if (body.value("type", "dynamic") == "static")
        freedoms.fill(0);
    return freedoms;
}

bool is_dynamic(const Json& body) {
    return body.value("type", "dynamic") == "dynamic" &&
           std::ranges::any_of(freedoms_in(body), [](double f) { return f != 0; });
}

/// "fixed" for all bodies that are not dynamic and their groups.
std::string group_in(const Json& body, const std::set<int>& fixed_groups) {
    const int group = body.value("group_id", -1);
    if (!is_dynamic(body) || fixed_groups.contains(group))
        return "fixed";
    return group < 0 ? "" : "group " + std::to_string(group);
}

RigidIpcBody body_in(const Json& body, const FixtureShape& shape, const Vector3d& gravity) {
    const Freedoms freedoms = freedoms_in(body);
    const Vector3d moves(freedoms[0], freedoms[1], freedoms[2]), turns(freedoms[3], freedoms[4], freedoms[5]);
    const Eigen::Quaterniond turn = turn_in(body);
    return {.name = std::filesystem::path(body.value("mesh", "wire")).stem().string(),
            .group = {},
            .shape = shape.polyhedron,
            .start = Pose(vector_in(body, "position") + turn * shape.centre, turn),
            .velocity = moves.cwiseProduct(vector_in(body, "linear_velocity")),
            .angular_velocity = degree * turns.cwiseProduct(vector_in(body, "angular_velocity")),
            .acceleration = is_dynamic(body) ? Vector3d(moves.cwiseProduct(gravity)) : Vector3d::Zero()};
}

std::set<int> fixed_groups_in(const Json& bodies) {
    std::set<int> groups;
    for (const Json& body : bodies)
        if (const int group = body.value("group_id", -1); group >= 0 && !is_dynamic(body))
            groups.insert(group);
    return groups;
}

} // namespace

std::vector<std::string> rigid_ipc_names(const std::filesystem::path& folder) {
    std::vector<std::string> names;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(folder / "fixtures"))
        if (entry.path().extension() == ".json")
            names.push_back(entry.path().lexically_relative(folder / "fixtures").replace_extension().generic_string());
    std::ranges::sort(names);
    return names;
}

RigidIpcFixture read_rigid_ipc(const std::filesystem::path& folder, const std::string& name) {
    std::ifstream file(folder / "fixtures" / (name + ".json"));
    const Json json = Json::parse(file);
    const Json& problem = json.at("rigid_body_problem");
    const std::set<int> fixed_groups = fixed_groups_in(problem.at("rigid_bodies"));
    const Vector3d gravity = vector_in(problem, "gravity");
    Shapes shapes(folder / "meshes");
    RigidIpcFixture fixture{name, json.value("timestep", 0.01), json.value("max_time", -1.0), 0, {}};
    if (fixture.max_time < 0)
        fixture.max_time = std::numeric_limits<double>::infinity();
    std::size_t number = 0;
    for (const Json& body : problem["rigid_bodies"]) {
        ++number;
        if (!body.value("enabled", true)) {
            ++fixture.unused;
            continue;
        }
        fixture.bodies.push_back(body_in(body, shapes.get(body), gravity));
        fixture.bodies.back().group = group_in(body, fixed_groups);
        fixture.bodies.back().name = std::to_string(number) + " " + fixture.bodies.back().name;
    }
    return fixture;
}

Motion rigid_ipc_motion(const RigidIpcBody& body, double seconds, RigidIpcFlight flight) {
    const Vector3d& from = body.start.translation;
    const Vector3d way = seconds * body.velocity;
    const Vector3d fall =
        flight == RigidIpcFlight::even ? Vector3d::Zero().eval() : Vector3d(seconds * seconds / 2 * body.acceleration);
    const double angle = seconds * body.angular_velocity.norm();
    if (way.isZero(0) && fall.isZero(0) && angle == 0)
        return Motion::at_rest(body.start);
    if (fall.isZero(0) && angle < std::numbers::pi) {
        const Eigen::Quaterniond start(body.start.rotation);
        const Eigen::AngleAxisd turn(angle, body.angular_velocity.normalized());
        return Motion::velocity(body.start, Pose(from + way, angle == 0 ? start : Eigen::Quaterniond(turn * start)));
    }
    const Motion path = Motion::polynomial({from, way, fall});
    const Motion turned = Motion::at_rest(Pose(Vector3d::Zero(), Eigen::Quaterniond(body.start.rotation)));
    if (angle == 0)
        return path * turned;
    return path * Motion::hinge(Vector3d::Zero(), body.angular_velocity, {0, angle}) * turned;
}

Scene rigid_ipc_scene(const RigidIpcFixture& fixture, double seconds, RigidIpcFlight flight) {
    Scene scene;
    for (const RigidIpcBody& body : fixture.bodies)
        scene.add({body.name, body.shape, rigid_ipc_motion(body, seconds, flight), body.group});
    for (const RigidIpcBody& body : fixture.bodies)
        if (!body.group.empty())
            scene.ignore_groups(body.group, body.group);
    return scene;
}

} // namespace chasles::test
