// What happens in a world, as a page to look at.
#pragma once

#include "examples/dynamics/world.h"
#include "view/scene_record.h"

namespace chasles::examples {

/// Steps through a world and keeps poses and contacts.
class Recording {
public:
    /// The world must outlive it, and is to have all its bodies.
    Recording(World& world, const std::string& title);

    /// Goes on by a number of steps, and keeps the poses after every so many of them.
    void run(int steps, double duration, int kept_every);

    /// Writes a page of HTML. Throws InvalidInput if the file cannot be written.
    void write(const std::string& file) const;

private:
    void keep_poses();
    void keep_contacts(const StepEvent& event);

    World& world_;
    view::SceneRecord record_;
};

} // namespace chasles::examples
