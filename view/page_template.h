// The page without a scene, made from viewer/ while the project is built.
#pragma once

#include <span>
#include <string_view>

namespace chasles::view {

/// In pieces, because compilers need not take long texts in one; no piece if the viewer was not built.
std::span<const std::string_view> page_template();

/// Why there is no piece; empty if there is.
std::string_view why_no_page_template();

/// Stands in the template once, where the scene goes.
inline constexpr std::string_view scene_marker = "@CHASLES_SCENE@";

} // namespace chasles::view
