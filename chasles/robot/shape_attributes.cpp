#include "chasles/robot/shape_attributes.h"

#include "chasles/io/text_scan.h"

#include <algorithm>
#include <map>

namespace chasles::robot {
namespace {

using Names = std::vector<std::string_view>;

const std::map<std::string_view, Names> attributes_of{{"mesh", {"filename", "scale"}},
                                                      {"box", {"size"}},
                                                      {"sphere", {"radius"}},
                                                      {"cylinder", {"radius", "length"}},
                                                      {"capsule", {"radius", "length"}}};

bool is_in(const Names& names, std::string_view name) {
    return std::ranges::find(names, name) != names.end();
}

/// With other capitals, too.
bool is_of_some_shape(std::string_view name) {
    const std::string lower = io::lower_case(name);
    return std::ranges::any_of(attributes_of, [&](const auto& shape) { return is_in(shape.second, lower); });
}

std::string joined(const Names& names) {
    std::string text;
    for (const std::string_view name : names)
        text += (text.empty() ? "" : " and ") + std::string(name);
    return text;
}

} // namespace

void check_shape_attributes(const XmlFile& file, const XmlFile::Element& shape) {
    const auto known = attributes_of.find(shape.Name());
    if (known == attributes_of.end())
        return;
    for (const auto* attribute = shape.FirstAttribute(); attribute; attribute = attribute->Next()) {
        const std::string_view name = attribute->Name();
        if (!is_in(known->second, name) && is_of_some_shape(name))
            file.fail(shape, "the attribute " + io::one_line(name) + " is not read; a " + std::string(known->first) +
                                 " has " + joined(known->second));
    }
}

} // namespace chasles::robot
