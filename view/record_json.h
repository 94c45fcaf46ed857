// All data of a page of many bodies as JSON.
#pragma once

#include "view/scene_record.h"

#include <string>

namespace chasles::view {

/// One JSON object in ASCII without "<", safe inside a script element of a page. docs/decisions/0070-viewer.md lists
/// the keys. Throws InvalidInput if require_valid() does.
std::string record_json(const SceneRecord& record);

} // namespace chasles::view
