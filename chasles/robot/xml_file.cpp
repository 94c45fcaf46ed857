// Reads XML by tinyxml2, and numbers as all files of this library: correctly rounded, in any locale.
#include "chasles/robot/xml_file.h"

#include "chasles/base/invalid_input.h"
#include "chasles/io/mesh_bytes.h"
#include "chasles/io/read_file.h"
#include "chasles/io/text_scan.h"
#include "chasles/io/xml_text.h"

#include <algorithm>

namespace chasles::robot {

namespace {

constexpr const char* xacro_source = " source of xacro; expand the file first (xacro FILE > ROBOT.urdf)";

std::string place(const std::filesystem::path& file, int line) {
    return io::shown_name(file) + ':' + std::to_string(line);
}

std::string trimmed(std::string_view text) {
    constexpr std::string_view blanks = " \t\r\n";
    const std::size_t begin = text.find_first_not_of(blanks);
    return begin == std::string_view::npos ? std::string()
                                           : std::string(text.substr(begin, text.find_last_not_of(blanks) - begin + 1));
}

void check_text(const std::filesystem::path& file, std::string_view bytes) {
    try {
        (void)io::checked_xml(bytes);
    } catch (const InvalidInput& error) {
        throw InvalidInput(place(file, 1) + ": " + error.what());
    }
    const std::string text = trimmed(io::without_byte_order_mark(bytes.substr(0, 1000)));
    if (!text.empty() && text.front() > ' ' && text.front() < '\x7F' && text.front() != '<')
        throw InvalidInput(io::shown_name(file) +
                           ": is no XML; a robot is read from a URDF file, and its pairs from an SRDF file");
}

void refuse_other_content(const std::filesystem::path& file, std::string_view bytes) {
    try {
        io::refuse_other_content(bytes, {});
    } catch (const InvalidInput& error) {
        throw InvalidInput(io::shown_name(file) + ": " + error.what());
    }
}

/// Of a file that describes a robot in another format.
std::string way_out_of(std::string_view root) {
    if (root == "mujoco")
        return ": models of MuJoCo (MJCF) are not read; write the robot as URDF";
    return root == "sdf" ? ": files of SDF (SDFormat) are not read; write the robot as URDF" : "";
}

/// Whether each character is one byte below 0x80, or a first byte that is followed by as many others as it says.
bool is_utf8(std::string_view text) {
    int following = 0;
    for (const char c : text) {
        const auto byte = static_cast<unsigned char>(c);
        const bool is_following = (byte & 0xc0) == 0x80;
        if (is_following != (following > 0) || byte > 0xf4 || byte == 0xc0 || byte == 0xc1)
            return false;
        following = is_following ? following - 1 : byte >= 0xf0 ? 3 : byte >= 0xe0 ? 2 : byte >= 0xc0 ? 1 : 0;
    }
    return following == 0;
}

/// The name of which another one differs by capitals or, if it is longer than a short one, by a slip.
std::optional<std::string_view> name_meant(std::string_view given, std::initializer_list<std::string_view> names,
                                           std::size_t short_name) {
    const std::string lower = io::lower_case(given);
    const auto is_meant = [&](std::string_view name) {
        return lower == name || (name.size() > short_name && io::differ_by_a_slip(lower, name));
    };
    const auto* const found = std::ranges::find_if(names, is_meant);
    return found == names.end() || std::ranges::find(names, given) != names.end() ? std::nullopt
                                                                                  : std::optional(*found);
}

/// Files are often written by merging others, which repeats elements as they are.
bool is_the_same(const XmlFile::Element& a, const XmlFile::Element& b) {
    return a.NoChildren() && b.NoChildren() && a.ShallowEqual(&b);
}

} // namespace

XmlFile::XmlFile(const std::filesystem::path& file, const char* root) : path_(file) {
    const std::string bytes = io::read_file(file);
    refuse_other_content(path_, bytes);
    check_text(path_, bytes);
    if (document_.Parse(bytes.data(), bytes.size()) != tinyxml2::XML_SUCCESS)
        throw InvalidInput(place(path_, document_.ErrorLineNum()) + ": is no well-formed XML (" +
                           io::one_line(document_.ErrorName()) + ")");
    const Element* const element = document_.RootElement();
    if (!element || std::string_view(element->Name()) != root)
        throw InvalidInput(place(path_, element ? element->GetLineNum() : 1) + ": the root element must be <" + root +
                           ">" + (element ? ", and is <" + io::one_line(element->Name()) + '>' : "") +
                           way_out_of(element ? element->Name() : ""));
    if (const Element* const second = element->NextSiblingElement())
        throw InvalidInput(place(path_, second->GetLineNum()) + ": <" + io::one_line(second->Name()) +
                           ">: a file has one root element only");
    refuse_xacro(*element);
}

/// What a macro stands for would be left out. The parser bounds the depth.
void XmlFile::refuse_xacro(const Element& element) const {
    if (std::string_view(element.Name()).starts_with("xacro:"))
        fail(element, std::string("is") + xacro_source);
    for (const Element* child = element.FirstChildElement(); child; child = child->NextSiblingElement())
        refuse_xacro(*child);
}

std::string XmlFile::place_of(const Element& element) const {
    std::string text = place(path_, element.GetLineNum()) + ": <" + io::one_line(element.Name());
    if (const char* const name = element.Attribute("name"))
        text.append(" ").append(io::one_line(name));
    return text.append(">: ");
}

void XmlFile::fail(const Element& element, const std::string& why) const {
    throw XmlFault(place_of(element) + why);
}

std::vector<const XmlFile::Element*> XmlFile::children(const Element& element, const char* name) {
    std::vector<const Element*> all;
    for (const Element* child = element.FirstChildElement(name); child; child = child->NextSiblingElement(name))
        all.push_back(child);
    return all;
}

std::vector<const XmlFile::Element*> XmlFile::plain_children(const Element& element) {
    std::vector<const Element*> all;
    for (const Element* child = element.FirstChildElement(); child; child = child->NextSiblingElement())
        if (std::string_view(child->Name()).find(':') == std::string_view::npos)
            all.push_back(child);
    return all;
}

void XmlFile::require_no_misspelt_child(const Element& element, std::initializer_list<std::string_view> names) const {
    constexpr std::size_t short_name = 4;
    for (const Element* child : plain_children(element))
        if (const auto meant = name_meant(child->Name(), names, short_name))
            fail(*child, "is not read; if <" + std::string(*meant) + "> is meant, write it so");
}

void XmlFile::require_no_misspelt_attribute(const Element& element,
                                            std::initializer_list<std::string_view> names) const {
    constexpr std::size_t short_name = 2;
    for (const auto* attribute = element.FirstAttribute(); attribute; attribute = attribute->Next())
        if (const auto meant = name_meant(attribute->Name(), names, short_name))
            fail(element, "the attribute " + io::one_line(attribute->Name()) + " is not read; if " +
                              std::string(*meant) + " is meant, write it so");
}

const XmlFile::Element* XmlFile::child(const Element& element, const char* name) const {
    const Element* const first = element.FirstChildElement(name);
    for (const Element* other = first; other; other = other->NextSiblingElement(name))
        if (other != first && !is_the_same(*other, *first))
            fail(*other, std::string("<") + io::one_line(element.Name()) + "> has another one already");
    return first;
}

const XmlFile::Element& XmlFile::required_child(const Element& element, const char* name) const {
    const Element* const found = child(element, name);
    if (!found)
        fail(element, std::string("has no <") + name + ">");
    return *found;
}

std::optional<std::string> XmlFile::optional_text(const Element& element, const char* attribute) const {
    if (!element.Attribute(attribute))
        return std::nullopt;
    return text(element, attribute);
}

std::string XmlFile::text(const Element& element, const char* attribute) const {
    const char* const given = element.Attribute(attribute);
    std::string value = trimmed(given ? given : "");
    if (value.empty())
        fail(element,
             std::string(given ? "the attribute " : "has no attribute ") + attribute + (given ? " is empty" : ""));
    if (!is_utf8(value))
        fail(element, std::string(attribute) + ": " + io::in_quotes(value) + " is not in UTF-8");
    if (value.find("${") != std::string::npos || value.find("$(") != std::string::npos)
        fail(element, std::string(attribute) + ": " + io::in_quotes(value) + " is" + xacro_source);
    return value;
}

std::vector<double> XmlFile::numbers(const Element& element, const char* attribute, std::size_t count) const {
    const std::string given = text(element, attribute);
    std::vector<double> values;
    io::Words words(given);
    for (std::string_view word = words.next(); !word.empty(); word = words.next()) {
        const std::optional<double> value = io::parse_finite(word);
        if (!value) {
            const std::string hint = count == 1 ? io::decimal_comma_hint(word) : "";
            fail(element,
                 std::string(attribute) + ": " + io::in_quotes(word) + " is not a finite number" +
                     (hint.empty() && word.find(',') != std::string_view::npos ? "; blanks separate numbers" : hint));
        }
        values.push_back(*value);
    }
    if (values.size() != count)
        fail(element, std::string(attribute) + ": has " + std::to_string(values.size()) + " numbers instead of " +
                          std::to_string(count));
    return values;
}

double XmlFile::number(const Element& element, const char* attribute) const {
    return numbers(element, attribute, 1).front();
}

double XmlFile::number(const Element& element, const char* attribute, double otherwise) const {
    return element.Attribute(attribute) ? number(element, attribute) : otherwise;
}

} // namespace chasles::robot
