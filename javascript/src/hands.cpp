// Bodies in a hand.
#include "javascript/src/border.h"
#include "javascript/src/numbers_in.h"
#include "javascript/src/numbers_out.h"
#include "javascript/src/objects.h"

namespace chasles::javascript {

Handles<HeldHand>& hands() {
    static Handles<HeldHand> held("dragged body");
    return held;
}

namespace {

/// A flag, and if it is set, a flag with the centre, and the nine numbers of the inertia, row by row.
std::optional<MassProperties> mass_in(NumbersIn& in) {
    if (!in.flag())
        return std::nullopt;
    MassProperties mass;
    mass.centre = in.point("mass.centre").value_or(mass.centre);
    mass.inertia = Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(in.some(9).data());
    return mass;
}

/// A kind, and flags with a direction and a point.
DragLock lock_in(NumbersIn& in) {
    DragLock lock;
    lock.kind = static_cast<DragLockKind>(in.whole(std::size_t(DragLockKind::plane)));
    lock.direction = in.point("lock.direction").value_or(lock.direction);
    lock.point = in.point("lock.point").value_or(lock.point);
    return lock;
}

DragOptions drag_options_in(NumbersIn& in) {
    DragOptions options;
    options.margin = in.number();
    options.reach = in.number();
    options.stiffness = in.number();
    constexpr std::size_t most_rounds = 1 << 30;
    options.rounds = static_cast<int>(in.whole(most_rounds));
    options.friction = in.number();
    options.mass = mass_in(in);
    options.lock = lock_in(in);
    return options;
}

void write(Numbers& out, const std::vector<std::size_t>& list) {
    out.push_back(double(list.size()));
    out.insert(out.end(), list.begin(), list.end());
}

void write(Numbers& out, const std::vector<DragContact>& contacts) {
    out.push_back(double(contacts.size()));
    for (const DragContact& contact : contacts) {
        out.insert(out.end(), {double(contact.body), contact.force});
        javascript::write(out, contact.friction);
        javascript::write(out, contact.contact);
    }
}

void write(Numbers& out, const std::vector<DragEvent>& events) {
    out.push_back(double(events.size()));
    for (const DragEvent& event : events) {
        out.insert(out.end(), {double(event.body), event.begins ? 1.0 : 0.0});
        javascript::write(out, event.contact);
    }
}

void write(Numbers& out, const std::vector<DragPiece>& pieces) {
    out.push_back(double(pieces.size()));
    for (const DragPiece& piece : pieces) {
        javascript::write(out, piece.motion.pose_at(0));
        javascript::write(out, piece.motion.pose_at(1));
        out.insert(out.end(), {piece.until, piece.clearance});
    }
}

void write(Numbers& out, const std::vector<DragIntrusion>& intrusions) {
    out.push_back(double(intrusions.size()));
    for (const DragIntrusion& intrusion : intrusions)
        out.insert(out.end(), {double(intrusion.body), intrusion.contact.time.lower});
}

void write_step(Numbers& out, const DragStep& step) {
    javascript::write(out, step.pose);
    out.push_back(double(step.state));
    write(out, step.contacts);
    write(out, step.events);
    javascript::write(out, step.force);
    javascript::write(out, step.torque);
    out.push_back(step.distance);
    write(out, step.blocking);
    write(out, step.touching);
    write(out, step.pieces);
    write(out, step.intrusions);
    javascript::write(out, step.work);
}

} // namespace
} // namespace chasles::javascript

namespace js = chasles::javascript;

/// The body whose name is in the bytes, in a hand. Returns its handle.
CHASLES_JAVASCRIPT(hand)(std::int32_t scene) {
    return js::guarded([&] {
        const std::shared_ptr<chasles::Scene> held = js::scenes().get(scene);
        js::NumbersIn in(js::given_numbers());
        chasles::DraggedBody body(*held, std::string(js::given_bytes()), js::drag_options_in(in));
        return js::hands().add({held, std::move(body)});
    });
}

CHASLES_JAVASCRIPT(free_hand)(std::int32_t hand) {
    return js::guarded([&] { return js::hands().free(hand), 0; });
}

/// Goes towards the pose in the numbers. Answers with the step.
CHASLES_JAVASCRIPT(hand_update)(std::int32_t hand, double seconds) {
    return js::answered([&](js::Numbers& out) {
        js::NumbersIn in(js::given_numbers());
        chasles::DraggedBody& body = js::hands().get(hand).body;
        js::write_step(out, body.update(in.pose("goal"), seconds));
    });
}

/// Answers with the force and the torque on the hand for the goal in the numbers.
CHASLES_JAVASCRIPT(hand_force)(std::int32_t hand) {
    return js::answered([&](js::Numbers& out) {
        js::NumbersIn in(js::given_numbers());
        const chasles::DragForce found = js::hands().get(hand).body.force(in.pose("goal"));
        js::write(out, found.force);
        js::write(out, found.torque);
    });
}

/// Answers with the pose, the margin and the reach in use.
CHASLES_JAVASCRIPT(hand_state)(std::int32_t hand) {
    return js::answered([&](js::Numbers& out) {
        const chasles::DraggedBody& body = js::hands().get(hand).body;
        js::write(out, body.pose());
        out.insert(out.end(), {body.margin(), body.reach()});
    });
}
