// One page of HTML that shows an answered query, an answered scene or a recording. It needs no network and no other
// file.
#pragma once

#include "view/scene_json.h"
#include "view/scene_record.h"

namespace chasles::view {

/// The page. Throws InvalidInput if require_page_template() does.
std::string page(const Scene& scene);

/// The page of many bodies. Throws InvalidInput if require_page_template() or require_valid() does.
std::string scene_page(const SceneRecord& record);

/// Throws InvalidInput with the reason if the library was built without the viewer.
void require_page_template();

} // namespace chasles::view
