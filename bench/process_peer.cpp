#include "bench/process_peer.h"

#include "bench/bodies.h"

#include <cmath>
#include <cstdio>
#include <map>
#include <memory>
#include <sstream>
#include <type_traits>

namespace chasles::bench {

namespace {

void append(std::string& line, double number) {
    char text[32];
    std::snprintf(text, sizeof text, " %.17g", number);
    line += text;
}

void append(std::string& line, const Pose& pose) {
    const Eigen::Quaterniond turn = Eigen::Quaterniond(pose.rotation).normalized();
    for (const double number : pose.translation)
        append(line, number);
    for (const double number : {turn.w(), turn.x(), turn.y(), turn.z()})
        append(line, number);
}

std::string line_of(const Polyhedron& body) {
    const auto triangles = triangles_of(body);
    std::string line = "body " + std::to_string(body.vertices().size()) + ' ' + std::to_string(triangles.size());
    for (const Eigen::Vector3d& vertex : body.vertices())
        for (const double number : vertex)
            append(line, number);
    for (const auto& triangle : triangles)
        for (const std::uint32_t corner : triangle)
            line += ' ' + std::to_string(corner);
    return line;
}

/// Throws PeerFailed with the reason that follows `word_for_it` in the child's line.
[[noreturn]] void refuse(const std::string& line, const std::string& word_for_it) {
    const bool says_why = line.starts_with(word_for_it);
    throw PeerFailed(says_why ? line.substr(word_for_it.size()) : "it talks nonsense: " + line.substr(0, 60));
}

/// A library in its own process, which is restarted after a failure.
class Library {
public:
    explicit Library(ProcessPeer peer) : peer_(std::move(peer)) { start(); }

    void learn(const Polyhedron& body) {
        guarded([&] { number_of(body); });
    }

    PeerAnswer ask(const Polyhedron& moving, const Polyhedron& fixed, const Displacement& motion) {
        return guarded([&] {
            std::string line = "ask " + std::to_string(number_of(moving)) + ' ' + std::to_string(number_of(fixed));
            append(line, motion.start);
            append(line, motion.goal);
            return answer_in(child_->ask(line, peer_.limits.question));
        });
    }

private:
    /// A child that has failed once is not used again.
    template <class Work>
    std::invoke_result_t<Work> guarded(Work work) {
        if (!child_)
            start();
        try {
            return work();
        } catch (const std::runtime_error& failure) {
            child_.reset();
            throw PeerFailed(failure.what());
        }
    }

    void start() {
        numbers_.clear();
        try {
            child_ = std::make_unique<ChildProcess>(peer_.command);
            expect_ready(*child_, peer_.limits.start);
        } catch (const std::runtime_error& failure) {
            child_.reset();
            throw PeerFailed(failure.what());
        }
    }

    std::size_t number_of(const Polyhedron& body) {
        const auto [place, is_new] = numbers_.try_emplace(body.vertices().data(), numbers_.size());
        if (is_new)
            if (const std::string reply = child_->ask(line_of(body), peer_.limits.body); reply != "done")
                refuse(reply, "failed ");
        return place->second;
    }

    ProcessPeer peer_;
    std::unique_ptr<ChildProcess> child_;
    std::map<const void*, std::size_t> numbers_; ///< numbers of the bodies that this child has
};

} // namespace

void expect_ready(ChildProcess& child, ChildProcess::Limit limit) {
    if (const std::string greeting = child.read_line(limit); greeting != "ready")
        refuse(greeting, "absent ");
}

PeerAnswer answer_in(const std::string& line) {
    std::istringstream words(line);
    std::string kind;
    std::string touches;
    std::string time;
    double seconds = -1;
    words >> kind >> touches >> time >> seconds;
    PeerAnswer answer{touches == "1", {}, seconds};
    char* rest = nullptr;
    if (time != "-")
        answer.time = std::strtod(time.c_str(), &rest);
    const bool is_sound = kind == "answer" && (touches == "0" || touches == "1") && words && words.eof() &&
                          std::isfinite(seconds) && seconds >= 0 &&
                          (!answer.time || (*rest == '\0' && *answer.time >= 0 && *answer.time <= 1));
    if (!is_sound)
        refuse(line, "failed ");
    return answer;
}

Peer process_peer(const ProcessPeer& peer) {
    const auto library = std::make_shared<Library>(peer);
    const auto prepare = [library, pose_at = peer.pose_at](const Polyhedron& moving, const Polyhedron& fixed) {
        library->learn(moving);
        library->learn(fixed);
        const auto ask = [library, &moving, &fixed](const Displacement& motion) {
            return library->ask(moving, fixed, motion);
        };
        return PeerPair{ask, pose_at};
    };
    return {peer.name, prepare, peer.is_for_convex_bodies_only};
}

} // namespace chasles::bench
