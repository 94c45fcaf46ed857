// What JavaScript holds: bodies, scenes, and bodies in a hand.
#pragma once

#include "chasles/manipulation/dragged_body.h"
#include "chasles/mesh/polyhedron.h"
#include "chasles/scene/scene.h"
#include "javascript/src/handles.h"

#include <memory>

namespace chasles::javascript {

/// A body in a hand, with the scene, which must live as long.
struct HeldHand {
    std::shared_ptr<Scene> scene;
    DraggedBody body;
};

Handles<Polyhedron>& bodies();
Handles<std::shared_ptr<Scene>>& scenes();
Handles<HeldHand>& hands();

} // namespace chasles::javascript
