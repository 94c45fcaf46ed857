// Reads XML elements, attributes and numbers. tinyxml2 parses; `text_scan` reads the numbers.
#include "chasles/io/xml_text.h"

#include "chasles/base/invalid_input.h"
#include "chasles/io/read_file.h"
#include "chasles/io/text_scan.h"

#include <algorithm>

namespace chasles::io {
namespace {

constexpr std::size_t most_attributes = 1'000;

std::string_view without_prefix(std::string_view name) {
    return name.substr(name.find(':') + 1); // all of it without a colon
}

// An element or an attribute takes about 100 bytes (tinyxml2 9).
void refuse_more_than_the_memory(std::string_view text) {
    const auto items = std::ranges::count(text, '<') + std::ranges::count(text, '=');
    if (!fits_into_memory(100 * static_cast<std::size_t>(items)))
        throw InvalidInput("does not fit into memory");
}

// Where an element's tag ends, or a comment and the like, as tinyxml2 reads them. `text` begins with it. Values of
// attributes may contain any other marks.
std::size_t end_of_markup(std::string_view text) {
    struct Marks {
        std::string_view begin;
        std::string_view end;
    };
    for (const Marks& marks : {Marks{"<?", "?>"}, Marks{"<!--", "-->"}, Marks{"<![CDATA[", "]]>"}, Marks{"<!", ">"}})
        if (text.starts_with(marks.begin))
            return std::min(text.find(marks.end), text.size() - 1) + 1;
    std::size_t position = 1, attributes = 0;
    while (position < text.size() && text[position] != '>') {
        if (text[position] == '"' || text[position] == '\'') {
            if (++attributes > most_attributes)
                throw InvalidInput("an element has more than 1,000 attributes");
            position = std::min(text.find(text[position], position + 1), text.size() - 1);
        }
        ++position;
    }
    return std::min(position + 1, text.size());
}

// tinyxml2 compares each attribute of an element with all attributes before it.
void refuse_many_attributes(std::string_view text) {
    for (std::size_t at = text.find('<'); at != std::string_view::npos; at = text.find('<'))
        text.remove_prefix(at + end_of_markup(text.substr(at)));
}

} // namespace

std::string_view checked_xml(std::string_view text) {
    text = without_byte_order_mark(text);
    if (text.find('\0') != std::string_view::npos)
        throw InvalidInput("is no XML: has a zero byte");
    refuse_more_than_the_memory(text);
    refuse_many_attributes(text);
    return text;
}

void parse_xml(tinyxml2::XMLDocument& document, std::string_view text, std::string_view root) {
    text = checked_xml(text);
    if (document.Parse(text.data(), text.size()) != tinyxml2::XML_SUCCESS)
        fail_at_line(static_cast<std::size_t>(std::max(document.ErrorLineNum(), 1)),
                     std::string("is no well-formed XML (") + document.ErrorName() + ")");
    const XmlElement* const element = document.RootElement();
    if (!element || local_name(*element) != root)
        throw InvalidInput("the root element must be <" + std::string(root) + ">" +
                           (element ? ", not " + in_quotes(element->Name()) : ""));
}

std::string_view local_name(const XmlElement& element) {
    return without_prefix(element.Name());
}

void fail_at(const XmlElement& element, const std::string& why) {
    fail_at_line(static_cast<std::size_t>(std::max(element.GetLineNum(), 1)),
                 std::string("<").append(one_line(element.Name())).append(">: ").append(why));
}

std::vector<const XmlElement*> children_of(const XmlElement& element, std::string_view name) {
    std::vector<const XmlElement*> all;
    for (const XmlElement* child = element.FirstChildElement(); child; child = child->NextSiblingElement())
        if (local_name(*child) == name)
            all.push_back(child);
    return all;
}

const XmlElement* child_of(const XmlElement& element, std::string_view name) {
    for (const XmlElement* child = element.FirstChildElement(); child; child = child->NextSiblingElement())
        if (local_name(*child) == name)
            return child;
    return nullptr;
}

const XmlElement& required_child_of(const XmlElement& element, std::string_view name) {
    const XmlElement* const found = child_of(element, name);
    if (!found)
        fail_at(element, "has no <" + std::string(name) + ">");
    return *found;
}

std::string_view attribute_of(const XmlElement& element, std::string_view name) {
    for (const auto* attribute = element.FirstAttribute(); attribute; attribute = attribute->Next())
        if (without_prefix(attribute->Name()) == name)
            return attribute->Value();
    return {};
}

std::string_view required_attribute_of(const XmlElement& element, std::string_view name) {
    const std::string_view value = attribute_of(element, name);
    if (value.empty())
        fail_at(element, "has no attribute " + std::string(name));
    return value;
}

std::size_t count_of(const XmlElement& element, std::string_view name) {
    const std::string_view word = Words(required_attribute_of(element, name)).next();
    const auto count = parse_integer(word);
    if (!count || *count < 0)
        fail_at(element, std::string(name) + ": " + in_quotes(word) + " is not a whole number from 0");
    return static_cast<std::size_t>(*count);
}

std::size_t count_of(const XmlElement& element, std::string_view name, std::size_t otherwise) {
    return attribute_of(element, name).empty() ? otherwise : count_of(element, name);
}

std::vector<double> numbers_in(const XmlElement& element, std::string_view text) {
    std::vector<double> numbers;
    Words words(text);
    for (std::string_view word = words.next(); !word.empty(); word = words.next()) {
        const auto number = parse_finite(word);
        if (!number)
            fail_at(element, in_quotes(word) + " is not a finite number" + decimal_comma_hint(word));
        numbers.push_back(*number);
    }
    return numbers;
}

std::string text_of(const XmlElement& element) {
    std::string text;
    for (const auto* child = element.FirstChild(); child; child = child->NextSibling())
        if (child->ToText())
            text.append(child->Value()).push_back(' ');
    return text;
}

} // namespace chasles::io
