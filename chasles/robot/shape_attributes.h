// The attributes of collision shapes: a misplaced one would change the shape, so none is left out silently.
#pragma once

#include "chasles/robot/xml_file.h"

namespace chasles::robot {

/// Fails for an attribute that belongs to another kind of shape (a sphere with a length). Other attributes that the
/// format does not have make a warning, by chasles/robot/unread_parts.h.
void check_shape_attributes(const XmlFile& file, const XmlFile::Element& shape);

} // namespace chasles::robot
