#include "examples/dynamics/recording.h"

#include "view/page.h"

#include <fstream>

namespace chasles::examples {

Recording::Recording(World& world, const std::string& title) : world_(world) {
    record_.title = title;
    for (const SceneBody& body : world.scene().bodies())
        record_.bodies.push_back({body.name, body.shape, {}});
    world_.before_impulses = [this](const StepEvent& event) { keep_contacts(event); };
    keep_poses();
}

void Recording::run(int steps, double duration, int kept_every) {
    for (int i = 1; i <= steps; ++i) {
        world_.step(duration);
        if (i % kept_every == 0)
            keep_poses();
    }
}

void Recording::keep_poses() {
    record_.times.push_back(world_.time());
    for (std::size_t i = 0; i < record_.bodies.size(); ++i) {
        const RigidBody& body = world_.bodies()[i];
        std::vector<view::PoseRow>& rows = record_.bodies[i].poses;
        if (!body.moves() && !rows.empty())
            continue;
        Eigen::Quaterniond turn(body.pose.linear());
        if (!rows.empty() &&
            turn.dot(Eigen::Quaterniond(rows.back()[3], rows.back()[4], rows.back()[5], rows.back()[6])) < 0)
            turn.coeffs() *= -1;
        const Eigen::Vector3d& place = body.pose.translation();
        rows.push_back({place.x(), place.y(), place.z(), turn.w(), turn.x(), turn.y(), turn.z()});
    }
}

void Recording::keep_contacts(const StepEvent& event) {
    for (const SceneContact& pair : event.contacts)
        record_.contacts.push_back({.time = world_.time(),
                                    .time_upper = world_.time(),
                                    .certain = pair.contact.certain,
                                    .moving = pair.moving,
                                    .fixed = pair.fixed,
                                    .contacts = pair.contact.contacts});
}

void Recording::write(const std::string& file) const {
    std::ofstream out(file);
    out << view::scene_page(record_);
    if (!out.flush())
        throw InvalidInput(file + ": cannot be written");
}

} // namespace chasles::examples
