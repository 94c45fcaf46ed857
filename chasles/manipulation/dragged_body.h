// A body that follows a hand: it moves by certified motions, stops at contacts, slides along them and lifts off, and
// never passes through anything. Source: docs/derivations/30-dragged-body.md; M. Ortega, S. Redon, S. Coquillart,
// "A six degree-of-freedom god-object method for haptic display of rigid bodies with surface properties", 2007.
#pragma once

#include "chasles/manipulation/drag_options.h"
#include "chasles/query/first_contact.h"
#include "chasles/scene/scene.h"

#include <memory>
#include <string>

namespace chasles {

/// Where an update has ended.
enum class DragState : std::uint8_t {
    reached,  ///< the pose is the goal; with a lock, the pose of the lock at which the spring holds the least energy
    resting,  ///< the contacts hold the body against the pull of the hand
    moving,   ///< the rounds or the time are used up; the next update goes on
    touching, ///< another body is so near, or in the body, that it cannot be kept apart, from the start or since it
              ///< came; nothing moves
};

/// A contact of the dragged body, which is its moving body.
struct DragContact {
    std::size_t body = 0;                               ///< the other body, an index of Scene::bodies()
    Contact contact;                                    ///< in the world, at the pose reached
    double force = 0;                                   ///< along the normal, on the dragged body; not negative
    Eigen::Vector3d friction = Eigen::Vector3d::Zero(); ///< force on the dragged body, across the normal, in the world
};

/// What contacts push the hand with, in the world. What a lock takes is not a part of it.
struct DragForce {
    Eigen::Vector3d force = Eigen::Vector3d::Zero();  ///< the sum of the forces, friction included
    Eigen::Vector3d torque = Eigen::Vector3d::Zero(); ///< about the body's origin
};

/// A contact that was not there after the update before, or is no longer there. Contacts with a body that is removed
/// from the scene end without an event.
struct DragEvent {
    bool begins = true;
    std::size_t body = 0;
    Contact contact; ///< now, or when it was last there
};

/// A part of the way of an update: the motion from time 0 until a time, both included, is proven to keep the clearance
/// from every body of the scene that is not ignored, as these stand.
struct DragPiece {
    Motion motion; ///< the screw between two poses in the world
    double until = 1;
    double clearance = 0; ///< positive, mesh unit
};

/// Another body that moved while the dragged body stood still, and came into its way.
struct DragIntrusion {
    std::size_t body = 0;
    FirstContact contact; ///< the dragged body counts as moving; time is that of the motion of the other body
};

/// What an update did.
struct DragStep {
    Pose pose; ///< reached
    DragState state = DragState::resting;
    std::vector<DragContact> contacts; ///< within the reach, at most twice the margin
    std::vector<DragEvent> events;
    /// What the contacts push the hand with, in the world: the sum of their forces, friction included, and the torque
    /// about the body's origin. What a lock takes is not a part of it.
    Eigen::Vector3d force = Eigen::Vector3d::Zero();
    Eigen::Vector3d torque = Eigen::Vector3d::Zero();
    double distance = 0;               ///< of the goal: the longest way left of a corner of the body's box
    std::vector<std::size_t> blocking; ///< bodies that push, or at which the last step ended; ascending
    std::vector<std::size_t> touching; ///< with DragState::touching
    std::vector<DragPiece> pieces;     ///< the way from the pose before to this one
    std::vector<DragIntrusion> intrusions;
    Work work;
};

/// A body of a scene in a hand. The other bodies stand where their motions end; they may be moved between updates, and
/// bodies may be added and removed.
///
///     Scene scene;
///     ...
///     DraggedBody nut(scene, "nut");
///     const DragStep step = nut.update(goal, 1.0 / 60);
class CHASLES_EXPORT DraggedBody {
public:
    /// The body starts where its motion ends in the scene. The scene must outlive the dragged body. Throws InvalidInput
    /// for an unknown name and for options out of their range. The margin must be far above the rounding of poses: at
    /// least a 2^28th of the lengths of the pose and of the body's coordinates.
    DraggedBody(Scene& scene, const std::string& name, const DragOptions& options = {});
    ~DraggedBody();
    DraggedBody(DraggedBody&& other) noexcept;
    DraggedBody& operator=(DraggedBody&& other) noexcept;

    /// Goes towards the goal as far as contacts, rounds and `seconds` allow, and places the body in the scene there. A
    /// round that has begun is finished, but goes less far where its search gets long. 0 seconds: no bound. Throws
    /// InvalidInput for a goal that cannot be used or is too far away for the margin, and if the body is no longer in
    /// the scene.
    DragStep update(const Pose& goal, double seconds = 0);

    /// The force on the hand for another goal, from the contacts and the pose that the last update ended with. No
    /// geometry is computed, so a haptic device may ask a thousand times a second. Other threads may call this while
    /// an update runs. Throws InvalidInput for a goal that cannot be used.
    [[nodiscard]] DragForce force(const Pose& goal) const;

    /// Where the last update ended. If the scene has moved the body since, the next update begins where it is.
    [[nodiscard]] const Pose& pose() const;
    [[nodiscard]] double margin() const; ///< in use
    [[nodiscard]] double reach() const;  ///< in use

private:
    class Implementation;
    std::unique_ptr<Implementation> implementation_;
};

} // namespace chasles
