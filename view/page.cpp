// The page is the template with its marker replaced by the scene.
#include "view/page.h"

#include "chasles/base/invalid_input.h"
#include "view/page_template.h"
#include "view/proven_verdict.h"
#include "view/record_json.h"

namespace chasles::view {
namespace {

std::string page_with(const std::string& json) {
    require_page_template();
    std::string text;
    for (const std::string_view piece : page_template())
        text += piece;
    const std::size_t place = text.find(scene_marker);
    if (place == std::string::npos)
        throw InvalidInput("view: template: has no marker for the scene");
    return text.replace(place, scene_marker.size(), json);
}

} // namespace

void require_page_template() {
    if (page_template().empty())
        throw InvalidInput("view: this build has no viewer: " + std::string(why_no_page_template()));
}

std::string page(const Scene& scene) {
    require_answer(scene.found.verdict);
    return page_with(scene_json(scene));
}

std::string scene_page(const SceneRecord& record) {
    return page_with(record_json(record));
}

} // namespace chasles::view
