#include "bench/peer_scene.h"

#include "bench/bodies.h"

#include <iomanip>
#include <sstream>

namespace chasles::bench {

namespace {

constexpr ChildProcess::Limit limit{120};

std::ostringstream line_of(const char* word) {
    std::ostringstream line;
    line << word << std::setprecision(17);
    return line;
}

} // namespace

PeerScene::PeerScene(const std::vector<std::string>& command, const Polyhedron& shape) : child_(command) {
    if (const std::string reply = child_.read_line(limit); reply != "ready")
        throw ChildFailed(reply);
    const auto triangles = triangles_of(shape);
    std::ostringstream line = line_of("body");
    line << ' ' << shape.vertices().size() << ' ' << triangles.size();
    for (const Eigen::Vector3d& v : shape.vertices())
        line << ' ' << v.x() << ' ' << v.y() << ' ' << v.z();
    for (const auto& triangle : triangles)
        line << ' ' << triangle[0] << ' ' << triangle[1] << ' ' << triangle[2];
    tell(line.str());
}

void PeerScene::tell(const std::string& line) {
    if (const std::string reply = child_.ask(line, limit); reply != "done")
        throw ChildFailed(reply);
}

void PeerScene::place(const Scene& scene, double time) {
    std::ostringstream line = line_of("place");
    line << ' ' << scene.bodies().size();
    for (const SceneBody& body : scene.bodies()) {
        const Pose pose = body.motion.pose_at(time);
        const Eigen::Quaterniond turn = Eigen::Quaterniond(pose.rotation).normalized();
        const Eigen::Vector3d& at = pose.translation;
        line << ' ' << turn.w() << ' ' << turn.x() << ' ' << turn.y() << ' ' << turn.z() << ' ' << at.x() << ' '
             << at.y() << ' ' << at.z();
    }
    tell(line.str());
}

PeerScene::Pass PeerScene::pass() {
    const std::string reply = child_.ask("pass", limit);
    std::istringstream line(reply);
    std::string word;
    double seconds = 0;
    if (!(line >> word >> seconds) || word != "found")
        throw ChildFailed(reply);
    Pass pass{1000 * seconds, {}};
    for (std::size_t a = 0, b = 0; line >> a >> b;)
        pass.found.insert(std::minmax(a, b));
    return pass;
}

} // namespace chasles::bench
