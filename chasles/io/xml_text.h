// XML for the readers of COLLADA and 3MF, by tinyxml2. Names are compared without their namespace prefix, because
// writers choose prefixes freely. Messages name line and element.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <tinyxml2.h>
#include <vector>

namespace chasles::io {

using XmlElement = tinyxml2::XMLElement;

/// The text without a byte order mark. Throws InvalidInput for text that tinyxml2 would read in part, or only with much
/// memory or time: other encodings, zero bytes, more elements than fit into memory, and more than 1,000 attributes of
/// one element.
std::string_view checked_xml(std::string_view text);

/// Parses UTF-8 text. Throws InvalidInput unless it is XML with this root element. tinyxml2 bounds the depth.
void parse_xml(tinyxml2::XMLDocument& document, std::string_view text, std::string_view root);

/// The name without prefix.
std::string_view local_name(const XmlElement& element);

/// Throws InvalidInput "line N: <NAME>: WHY".
[[noreturn]] void fail_at(const XmlElement& element, const std::string& why);

/// The children of this name, in order.
std::vector<const XmlElement*> children_of(const XmlElement& element, std::string_view name);

/// The first child of this name, or null.
const XmlElement* child_of(const XmlElement& element, std::string_view name);
const XmlElement& required_child_of(const XmlElement& element, std::string_view name);

/// The value of an attribute; empty if it is missing.
std::string_view attribute_of(const XmlElement& element, std::string_view name);
std::string_view required_attribute_of(const XmlElement& element, std::string_view name);

/// An attribute that is a whole number from 0.
std::size_t count_of(const XmlElement& element, std::string_view name);
std::size_t count_of(const XmlElement& element, std::string_view name, std::size_t otherwise);

/// The finite numbers in a text of the element. Fails for other words.
std::vector<double> numbers_in(const XmlElement& element, std::string_view text);

/// All text of the element, without comments.
std::string text_of(const XmlElement& element);

} // namespace chasles::io
