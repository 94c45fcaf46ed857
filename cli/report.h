// Answers for people: the verdict first, then when, how far along the motion, where and what touches.
#pragma once

#include "view/motion_numbers.h"

#include <string>

namespace chasles::cli {

/// The answer of `check` as a short text of several lines. With the margin that was asked for, gaps are told.
std::string report(const FirstContact& found, const view::MotionNumbers& motion, double margin);

/// Its two parts: the verdict in one line, and all the rest.
std::string headline(const FirstContact& found, double margin);
std::string details(const FirstContact& found, const view::MotionNumbers& motion, double margin);

/// One line "  label     text", aligned with the others.
std::string labelled(const std::string& label, const std::string& text);

/// The line of work counters.
std::string report(const Work& work);

/// "1 segment", "2 segments".
std::string counted(std::size_t count, const std::string& noun);

} // namespace chasles::cli
