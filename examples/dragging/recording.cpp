#include "examples/dragging/recording.h"

#include "view/page.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <fstream>
#include <numbers>

namespace chasles::examples {

namespace {

constexpr std::size_t most_contacts = 24; // of a pair at a time: a nut has hundreds

view::PoseRow row_of(const Pose& pose, const view::PoseRow* last) {
    const Eigen::Quaterniond turn(pose.rotation);
    const Eigen::Vector3d& place = pose.translation;
    view::PoseRow row{place.x(), place.y(), place.z(), turn.w(), turn.x(), turn.y(), turn.z()};
    double product = 1;
    if (last)
        product = row[3] * (*last)[3] + row[4] * (*last)[4] + row[5] * (*last)[5] + row[6] * (*last)[6];
    // the shorter way from the pose before
    if (product < 0)
        for (std::size_t i = 3; i < 7; ++i)
            row[i] = -row[i];
    return row;
}

} // namespace

HandRecording::HandRecording(const Scene& scene, const std::string& title) : scene_(scene) {
    record_.title = title;
    for (const SceneBody& body : scene.bodies())
        record_.bodies.push_back({body.name, body.shape, {}});
    keep();
}

void HandRecording::keep_contacts(const std::string& dragged, const DragStep& step) {
    const double time = double(record_.times.size());
    const std::size_t moving = scene_.index_of(dragged);
    for (const DragEvent& event : step.events) {
        if (!event.begins)
            continue;
        auto& kept = record_.contacts;
        const auto same = std::ranges::find_if(kept, [&](const view::RecordedContact& contact) {
            return contact.time == time && contact.moving == moving && contact.fixed == event.body;
        });
        if (same == kept.end())
            kept.push_back(
                {.time = time, .time_upper = time, .moving = moving, .fixed = event.body, .contacts = {event.contact}});
        else if (same->contacts.size() < most_contacts)
            same->contacts.push_back(event.contact);
    }
}

void HandRecording::keep() {
    record_.times.push_back(double(record_.times.size()));
    for (std::size_t i = 0; i < record_.bodies.size(); ++i) {
        std::vector<view::PoseRow>& rows = record_.bodies[i].poses;
        rows.push_back(row_of(scene_.bodies()[i].motion.pose_at(1), rows.empty() ? nullptr : &rows.back()));
    }
}

void HandRecording::write(int count, char** arguments) const {
    if (count < 2)
        return;
    view::SceneRecord record = record_;
    for (view::RecordedBody& body : record.bodies)
        if (std::ranges::all_of(body.poses, [&](const view::PoseRow& row) { return row == body.poses.front(); }))
            body.poses.resize(1); // it rests
    std::ofstream out(arguments[1]);
    out << view::scene_page(record);
    if (!out.flush())
        throw InvalidInput(std::string(arguments[1]) + ": cannot be written");
}

double turns_about_z(const Pose& from, const Pose& to) {
    const Eigen::Quaterniond turn = Eigen::Quaterniond(to.rotation) * Eigen::Quaterniond(from.rotation).conjugate();
    return std::remainder(2 * std::atan2(turn.z(), turn.w()), 2 * std::numbers::pi) / (2 * std::numbers::pi);
}

} // namespace chasles::examples
