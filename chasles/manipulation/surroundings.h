// The other bodies of a scene, as a dragged body meets them: what is near, and how far a screw is clear of all.
// Source: docs/derivations/30-dragged-body.md, "The certified step".
#pragma once

#include "chasles/manipulation/contact_model.h"
#include "chasles/memory/neighbour_list.h"
#include "chasles/query/first_contact.h"
#include "chasles/scene/scene.h"

#include <memory>
#include <optional>

namespace chasles::manipulation {

/// Another body, standing still.
struct Other {
    std::size_t index = 0; ///< in the scene
    std::string name;
    Polyhedron shape;
    Motion motion; ///< that the scene gave it last
    Pose pose;     ///< at the end of this motion
    bool is_ignored = false;
    Eigen::Vector3d centre; ///< of a ball around the body, in the world
    double radius = 0;
    std::unique_ptr<memory::NeighbourList> neighbours; ///< of the dragged body and this one, once they were near
};

/// What is near the dragged body at one pose.
struct Neighbourhood {
    std::vector<ModelledContact> contacts;
    std::vector<double> distances;     ///< of each other body; the reach if it is farther away
    std::vector<std::size_t> touching; ///< bodies that cannot be kept apart any more; indices of the scene
    Work work;
};

/// How far a screw is clear.
struct Passage {
    double until = 1;                      ///< proven clear up to this time
    std::optional<std::size_t> blocked_by; ///< an index of the scene
    double clearance = 0;                  ///< that is kept from all bodies
    Work work;
};

/// The margin that contacts keep, and the distance within which they are foreseen; mesh unit.
struct Distances {
    double margin = 0;
    double reach = 0;

    /// What a certified step keeps from a body at a distance: half of the distance or of the margin; the whole margin
    /// from bodies beyond the reach.
    [[nodiscard]] double safe_level(double distance) const;
    /// A motion comes to a level below the margin: the time at which the contact was at the margin, by its speed. The
    /// time of the level for contacts that started within the margin.
    [[nodiscard]] double time_at_margin(const FirstContact& found, double level) const;
};

/// Computes what a body computes on the first contact, so that no update has to wait for it.
void prepare(const Body& body);

class Surroundings {
public:
    explicit Surroundings(const Distances& distances) : distances_(distances) {}

    /// Reads the scene again. Returns the places in others() of bodies that were there and have got another motion;
    /// nothing at all if no body has changed.
    std::optional<std::vector<std::size_t>> refresh(const Scene& scene, std::size_t dragged);

    [[nodiscard]] const std::vector<Other>& others() const { return others_; }
    /// `body` is the dragged one: the same in all calls.
    [[nodiscard]] Neighbourhood near(const Body& body, const Pose& pose);
    /// How far the screw between two poses is clear of all others, by their distances at its start.
    [[nodiscard]] Passage passage(const Body& body, const Pose& start, const Pose& goal,
                                  const std::vector<double>& at_start) const;

private:
    [[nodiscard]] bool is_unchanged(const Scene& scene, std::size_t dragged) const;

    Distances distances_;
    std::vector<Other> others_;
};

} // namespace chasles::manipulation
