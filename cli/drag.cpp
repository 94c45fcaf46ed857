// chasles drag: a body of a scene follows the goals of a hand.
#include "cli/commands.h"
#include "cli/interruption.h"
#include "cli/options.h"
#include "cli/output.h"
#include "cli/progress_bar.h"
#include "cli/report.h"
#include "cli/scene_file.h"
#include "cli/warnings.h"
#include "view/page.h"
#include "view/sampled_track.h"

#include "chasles/base/limit.h"
#include "chasles/io/motion_files.h"
#include "chasles/io/text_scan.h"

#include <algorithm>
#include <filesystem>
#include <fmt/format.h>
#include <limits>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>

namespace chasles::cli {
namespace {

struct DragCommand {
    std::string scene;
    std::string body;
    std::string goals;
    std::string out;
    std::string page; ///< empty: none
    PolyhedronOptions polyhedron;
    std::string margin; ///< empty: that of the scene's file
    std::string stiffness = "1";
    std::string friction = "0";
    std::string lock;       ///< empty: none
    std::string lock_axis;  ///< empty: z
    std::string lock_point; ///< empty: the origin
    int rounds = DragOptions().rounds;
    bool json = false;
};

/// A hand moves one body. What else moves in the scene has no clock here.
void require_rest(const std::string& file, const Scene& scene) {
    for (const SceneBody& body : scene.bodies())
        for (const double time : {0.5, 1.0})
            if (body.motion.pose_at(time).isometry().matrix() != body.motion.pose_at(0).isometry().matrix())
                throw InvalidInput(file + ": " + body.name + ": moves; a scene to drag a body in must be at rest");
}

std::string csv_row(double time, const DragStep& step) {
    const Eigen::Vector3d& place = step.pose.translation;
    const auto turn = step.pose.rotation.normalized();
    return fmt::format("{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{}\n", time, place.x(), place.y(), place.z(),
                       turn.w(), turn.x(), turn.y(), turn.z(), step.contacts.size(), step.force.x(), step.force.y(),
                       step.force.z(), step.torque.x(), step.torque.y(), step.torque.z(), step.distance);
}

/// What happened, counted and recorded.
class Hand {
public:
    static constexpr const char* motion_name = "dragged";

    Hand(const Scene& scene, std::size_t dragged)
        : dragged_(dragged), box_(view::box_around(scene.bodies()[dragged].shape)) {
        for (const SceneBody& body : scene.bodies())
            record_.bodies.push_back({body.name, body.shape, {row_of(body.motion.pose_at(1))}});
        record_.bodies[dragged].poses.clear();
    }

    void add(double time, const DragStep& step) {
        ++states_[step.state];
        in_contact_ += step.contacts.empty() && step.state != DragState::touching ? 0 : 1;
        if (step.state == DragState::touching)
            for (const std::size_t body : step.touching)
                touching_.insert(record_.bodies[body].name);
        pieces_ += step.pieces.size();
        work_ += step.work;
        record_.times.push_back(time);
        add_way(time, step);
        std::map<std::size_t, std::vector<Contact>> begun;
        for (const DragEvent& event : step.events)
            if (event.begins)
                begun[event.body].push_back(event.contact);
        for (auto& [body, contacts] : begun)
            record_.contacts.push_back({.time = time,
                                        .time_upper = time,
                                        .moving = dragged_,
                                        .fixed = body,
                                        .kind = "contact",
                                        .contacts = std::move(contacts)});
    }

    [[nodiscard]] view::SceneRecord record(const DragCommand& options, double margin) const {
        view::SceneRecord record = record_;
        record.title = options.body + " in " + std::filesystem::path(options.scene).filename().string();
        record.margin = margin;
        return record;
    }
    /// The line about the page, if there is one.
    [[nodiscard]] std::string page_text(const std::string& page) const {
        return page.empty() ? "" : page_lines(page, shapes_of(record_.bodies));
    }
    [[nodiscard]] std::size_t updates() const { return record_.times.size(); }
    [[nodiscard]] bool has_contact() const { return in_contact_ > 0; }
    /// Why the body does not move. Empty if it may.
    [[nodiscard]] std::string why_stuck() const {
        if (touching_.empty())
            return {};
        const std::vector<std::string> names(touching_.begin(), touching_.end());
        return fmt::format("{} touches or overlaps {}, and does not move ({})", record_.bodies[dragged_].name,
                           shortened(names, 3, names.size()), counted(count(DragState::touching), "update"));
    }
    static constexpr const char* way_out = "start with a gap, or leave the pair out by \"ignore\"";
    [[nodiscard]] nlohmann::ordered_json json(double margin) const {
        return {{"updates", record_.times.size()},
                {"reached", count(DragState::reached)},
                {"resting", count(DragState::resting)},
                {"moving", count(DragState::moving)},
                {"touching", count(DragState::touching)},
                {"touched_by", touching_},
                {"in_contact", in_contact_},
                {"pieces", pieces_},
                {"margin", margin},
                {"motion", {{"kind", motion_name}}}};
    }
    [[nodiscard]] std::string text() const {
        return naming_motion(counted(record_.times.size(), "update"), motion_name) +
               labelled("states",
                        fmt::format("{} reached, {} resting, {} moving, {} touching", count(DragState::reached),
                                    count(DragState::resting), count(DragState::moving), count(DragState::touching))) +
               (touching_.empty() ? "" : labelled("touching", why_stuck()) + labelled("way out", way_out)) +
               labelled("contact", counted(in_contact_, "update")) +
               labelled("pieces", std::to_string(pieces_) + ", each proven clear") + report(work_);
    }

private:
    static view::PoseRow row_of(const Pose& pose) {
        const auto turn = pose.rotation.normalized();
        const Eigen::Vector3d& place = pose.translation;
        return {place.x(), place.y(), place.z(), turn.w(), turn.x(), turn.y(), turn.z()};
    }
    /// The page follows the way that was proven, not the line between two updates. Each piece takes an equal time.
    void add_way(double time, const DragStep& step) {
        const std::vector<double>& times = record_.bodies[dragged_].times;
        const double begin = times.empty() ? time : times.back();
        const double duration = (time - begin) / std::max(1., double(step.pieces.size()));
        for (std::size_t i = 0; i < step.pieces.size(); ++i) {
            const auto& [motion, until, clearance] = step.pieces[i];
            const view::SampledTrack track = view::sampled_track(motion, box_, {until});
            for (std::size_t k = 1; k < track.times.size() && track.times[k] <= until; ++k)
                if (const double at = begin + duration * (double(i) + track.times[k] / until);
                    !times.empty() && at > times.back() && at < time)
                    add_row(at, track.poses[k]);
        }
        add_row(time, row_of(step.pose));
    }
    void add_row(double time, view::PoseRow row) {
        view::RecordedBody& body = record_.bodies[dragged_];
        if (!body.poses.empty())
            keep_sign(row, body.poses.back());
        body.times.push_back(time);
        body.poses.push_back(row);
    }
    /// A page goes the shorter way between two poses.
    static void keep_sign(view::PoseRow& row, const view::PoseRow& last) {
        double product = 0;
        for (std::size_t i = 3; i < 7; ++i)
            product += row[i] * last[i];
        for (std::size_t i = 3; i < 7 && product < 0; ++i)
            row[i] = -row[i];
    }
    [[nodiscard]] std::size_t count(DragState state) const {
        const auto found = states_.find(state);
        return found == states_.end() ? 0 : found->second;
    }

    std::size_t dragged_;
    Eigen::AlignedBox3d box_;
    view::SceneRecord record_;
    std::map<DragState, std::size_t> states_;
    std::set<std::string> touching_; ///< other bodies, with DragState::touching
    std::size_t in_contact_ = 0;
    std::size_t pieces_ = 0;
    Work work_;
};

nlohmann::ordered_json json_of(const Hand& hand, double margin, const std::vector<std::string>& warnings) {
    nlohmann::ordered_json json = hand.json(margin);
    add_warnings(json, warnings);
    return json;
}

DragLock lock_of(const DragCommand& options) {
    static const std::map<std::string, DragLockKind> kinds{{"", DragLockKind::free},
                                                           {"hinge", DragLockKind::hinge},
                                                           {"slider", DragLockKind::slider},
                                                           {"cylinder", DragLockKind::cylinder},
                                                           {"plane", DragLockKind::plane}};
    DragLock lock{kinds.at(options.lock)};
    if (lock.kind == DragLockKind::free && !(options.lock_axis.empty() && options.lock_point.empty()))
        throw InvalidInput(std::string(options.lock_axis.empty() ? "--lock-point" : "--lock-axis") +
                           ": belongs to a lock; add --lock hinge, slider, cylinder or plane");
    if ((lock.kind == DragLockKind::slider || lock.kind == DragLockKind::plane) && !options.lock_point.empty())
        throw InvalidInput("--lock-point: says nothing about --lock " + options.lock +
                           "; leave it out, or lock the body to a hinge or a cylinder");
    if (!options.lock_axis.empty())
        lock.direction = point_of("--lock-axis", options.lock_axis);
    if (!options.lock_point.empty())
        lock.point = point_of("--lock-point", options.lock_point);
    return lock;
}

/// The scene. Its margin is that of `--margin`, if there is one.
SceneFile read_scene(const DragCommand& options) {
    std::optional<double> margin;
    if (!options.margin.empty())
        margin = number_of("--margin", options.margin);
    SceneFile file = load_scene(options.scene, options.polyhedron, margin);
    if (file.hold)
        throw InvalidInput(io::one_line(options.scene) +
                           ": hold: a dragged body keeps the margin from all bodies; leave the hold distance out");
    require_rest(options.scene, file.scene);
    return file;
}

DragOptions drag_options(const DragCommand& options, double margin) {
    DragOptions drag;
    drag.margin = margin;
    drag.stiffness = number_of("--stiffness", options.stiffness);
    drag.rounds = options.rounds;
    drag.friction = number_of("--friction", options.friction);
    drag.lock = lock_of(options);
    return drag;
}

/// The update to a goal of the file; none if an interruption ends it.
std::optional<DragStep> updated(DraggedBody& body, const io::Path& goals, std::size_t i, const std::string& file) {
    const Limit limit(std::numeric_limits<double>::infinity(), [] { return !Interruption::is_requested(); });
    try {
        return body.update(goals.poses[i]);
    } catch (const Cancelled&) {
        return std::nullopt;
    } catch (const InvalidInput& error) {
        throw InvalidInput(fmt::format("{}: goal {} (from 0): {}", io::one_line(file), i, error.what()));
    }
}

int run_drag(const DragCommand& options) {
    SceneFile file = read_scene(options);
    const io::Path goals = io::load_path(options.goals);
    std::vector<std::string> warnings = file.warnings;
    warnings.insert(warnings.end(), goals.warnings.begin(), goals.warnings.end());
    print_warnings(warnings);
    DraggedBody body(file.scene, options.body, drag_options(options, file.margin));
    OutputFile out(options.out);
    std::optional<OutputFile> page;
    if (!options.page.empty()) {
        view::require_page_template();
        page.emplace(options.page);
    }
    const Interruption interruption;
    Hand hand(file.scene, file.scene.index_of(options.body));
    ProgressBar bar("updates", goals.poses.size());
    out.keep_rows();
    out.write("t,x,y,z,qw,qx,qy,qz,contacts,fx,fy,fz,tx,ty,tz,distance\n");
    for (std::size_t i = 0; i < goals.poses.size() && !Interruption::is_requested(); ++i) {
        const double time = goals.stamps.empty() ? double(i) : goals.stamps[i];
        const std::optional<DragStep> step = updated(body, goals, i, options.goals);
        if (!step)
            break;
        out.write(csv_row(time, *step));
        hand.add(time, *step);
        bar.show(i + 1);
    }
    if (Interruption::is_requested())
        return report_interruption(fmt::format("{} of {} are done, in {}", hand.updates(),
                                               counted(goals.poses.size(), "update"), io::one_line(out.rows_name())));
    out.close();
    if (page) {
        page->write(view::scene_page(hand.record(options, body.margin())));
        page->close();
    }
    if (!is_standard_output(options.out))
        print(options.json ? json_of(hand, body.margin(), warnings).dump() + "\n"
                           : hand.text() + hand.page_text(options.page));
    else if (!hand.why_stuck().empty())
        print_warnings({hand.why_stuck() + "; " + Hand::way_out});
    return hand.has_contact() ? is_contact : is_clear;
}

void add_lock_options(CLI::App& command, DragCommand& options) {
    command.add_option("--lock", options.lock, "the body only turns, slides, does both, or moves in a plane")
        ->check(CLI::IsMember({"hinge", "slider", "cylinder", "plane"}))
        ->type_name("KIND");
    command
        .add_option("--lock-axis", options.lock_axis, "direction of the line, or normal of the plane; default 0 0 1")
        ->type_name("\"X Y Z\"");
    command
        .add_option("--lock-point", options.lock_point, "a point on the line of a hinge or a cylinder; default 0 0 0")
        ->type_name("\"X Y Z\"");
}

} // namespace

void add_drag(CLI::App& app, Task& task) {
    const auto options = std::make_shared<DragCommand>();
    CLI::App& command = *app.add_subcommand("drag", "Drag a body by a hand: it slides along what it touches");
    command.add_option("SCENE", options->scene, "JSON file with bodies at rest")->required()->type_name("FILE");
    command.add_option("--body", options->body, "name of the body in the hand")->required()->type_name("NAME");
    command.add_option("--goals", options->goals, "table with the poses of the hand, as for `chasles path`")
        ->required()
        ->type_name("FILE");
    command.add_option("--out", options->out, "CSV file for the poses reached and the forces on the hand")
        ->required()
        ->type_name("FILE");
    command.add_option("--page", options->page, "write a page (HTML) that replays the hand too")->type_name("FILE");
    add_mesh_options(command, options->polyhedron);
    add_radius_option(command, options->polyhedron.radius, "a body");
    command
        .add_option("--margin", options->margin,
                    "gap that contacts keep; 0: a ten-thousandth of the body; default: the scene's")
        ->type_name("D");
    command.add_option("--stiffness", options->stiffness, "force of the hand for a distance of 1")
        ->type_name("K")
        ->capture_default_str();
    command.add_option("--friction", options->friction, "friction force of a contact, as a share of its normal force")
        ->type_name("MU")
        ->capture_default_str();
    add_lock_options(command, *options);
    command.add_option("--rounds", options->rounds, "certified steps of an update at most")->capture_default_str();
    command.add_flag("--json", options->json, "print one JSON object");
    command.callback([options, &task] { task = [options] { return run_drag(*options); }; });
}

} // namespace chasles::cli
