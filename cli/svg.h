// Parts of pictures as SVG.
#pragma once

#include "chasles/io/text_scan.h"

#include <fmt/format.h>
#include <string>
#include <string_view>

namespace chasles::cli {

/// The start of a white picture, sizes in pixels. "</svg>" ends it.
inline std::string svg_start(double width, double height) {
    return fmt::format(R"(<svg xmlns="http://www.w3.org/2000/svg" width="{0}" height="{1}" viewBox="0 0 {0} {1}" )"
                       R"(font-family="sans-serif" font-size="12">)"
                       "\n<rect width=\"100%\" height=\"100%\" fill=\"white\"/>\n",
                       width, height);
}

inline std::string svg_line(double x1, double y1, double x2, double y2, std::string_view style) {
    return fmt::format(R"(<line x1="{:.2f}" y1="{:.2f}" x2="{:.2f}" y2="{:.2f}" {}/>)"
                       "\n",
                       x1, y1, x2, y2, style);
}

/// A name as text of a picture. XML takes no control characters and no invalid UTF-8.
inline std::string without_marks(std::string_view name) {
    std::string text;
    for (const char c : io::one_line(io::valid_utf8(name)))
        text += c == '<' ? "&lt;" : c == '&' ? "&amp;" : std::string(1, c);
    return text;
}

inline std::string svg_text(double x, double y, std::string_view anchor, std::string_view words) {
    return fmt::format(R"(<text x="{:.2f}" y="{:.2f}" text-anchor="{}">{}</text>)"
                       "\n",
                       x, y, anchor, words);
}

} // namespace chasles::cli
