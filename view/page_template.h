// The page without a scene. The build makes it from viewer/.
#pragma once

#include <span>
#include <string_view>

namespace chasles::view {

/// The template in parts, because compilers limit the length of a string literal. Empty if the viewer was not built.
std::span<const std::string_view> page_template();

/// The reason why the template is empty. Empty if the template exists.
std::string_view why_no_page_template();

/// Occurs once in the template, at the position of the scene.
inline constexpr std::string_view scene_marker = "@CHASLES_SCENE@";

} // namespace chasles::view
