// What hands did in a scene, as a page to look at.
#pragma once

#include "view/scene_record.h"

#include <chasles/chasles.h>

namespace chasles::examples {

/// Keeps the poses of all bodies of a scene after each update, and the contacts that begin.
class HandRecording {
public:
    /// The scene must outlive it, and is to have all its bodies.
    HandRecording(const Scene& scene, const std::string& title);

    /// What a dragged body has begun to touch; shown with the poses that are kept next.
    void keep_contacts(const std::string& dragged, const DragStep& step);
    /// The poses now: where the motions of the bodies end.
    void keep();

    /// Writes a page of HTML to the first argument of a program, if there is one. Throws InvalidInput if the file
    /// cannot be written.
    void write(int count, char** arguments) const;

private:
    const Scene& scene_;
    view::SceneRecord record_;
};

/// The turn about z from one pose to another one, in turns: at most a half.
double turns_about_z(const Pose& from, const Pose& to);

} // namespace chasles::examples
