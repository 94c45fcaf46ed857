// What JavaScript holds: bodies, scenes, and bodies in a hand.
#pragma once

#include "chasles/base/flat_lists.h"
#include "chasles/manipulation/dragged_body.h"
#include "chasles/mesh/polyhedron.h"
#include "chasles/scene/scene.h"
#include "javascript/src/handles.h"

#include <memory>

namespace chasles::javascript {

/// A body, and what makes it again with the same ids: in another instance, for a worker.
struct HeldBody {
    Polyhedron shape;
    PolyhedronOptions options;
    FlatLists<std::uint32_t> given_faces; ///< empty if the faces of the body are those that were given
};

/// A body in a hand, with the scene, which must live as long.
struct HeldHand {
    std::shared_ptr<Scene> scene;
    DraggedBody body;
};

Handles<HeldBody>& bodies();
Handles<std::shared_ptr<Scene>>& scenes();
Handles<HeldHand>& hands();

} // namespace chasles::javascript
