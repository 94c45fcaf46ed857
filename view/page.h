// One page of HTML that shows an answered query. It needs no network and no other file.
#pragma once

#include "view/scene_json.h"

namespace chasles::view {

/// The page. Throws InvalidInput if require_page_template() does.
std::string page(const Scene& scene);

/// Throws InvalidInput with the reason if the library was built without the viewer.
void require_page_template();

} // namespace chasles::view
