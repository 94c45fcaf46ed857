// What a robot's file says that is not read and may change what collides. None of it is left out silently.
#pragma once

#include "chasles/robot/xml_file.h"

namespace chasles::robot {

/// Adds one line for each kind of attribute or element that is not read, with its first place and its number. Parts
/// that cannot change what collides (looks, masses, actuators, sensors, simulation, `xmlns`) make no line.
void warn_of_unread_parts_of_urdf(const XmlFile& file, std::vector<std::string>& warnings);
void warn_of_unread_parts_of_srdf(const XmlFile& file, std::vector<std::string>& warnings);

} // namespace chasles::robot
