// Members of glTF's JSON, with messages that name the place. The library nlohmann_json stays inside the readers.
#pragma once

#include "chasles/base/invalid_input.h"
#include "chasles/io/text_scan.h"

#include <cmath>
#include <nlohmann/json.hpp>
#include <string>

namespace chasles::io {

using Json = nlohmann::json;

/// An entry of one of the lists of a glTF file, for example of "meshes".
struct GltfItem {
    const Json& json;
    std::string place; ///< for messages: "mesh 3"

    [[noreturn]] void fail(const std::string& why) const { throw InvalidInput(place + ": " + why); }

    /// Null if there is no such member.
    [[nodiscard]] const Json* find(const char* key) const {
        const auto found = json.find(key);
        return found == json.end() ? nullptr : &*found;
    }

    /// A list; empty if there is no such member.
    [[nodiscard]] const Json& list(const char* key) const {
        static const Json none = Json::array();
        const Json* const found = find(key);
        if (found && !found->is_array())
            fail(std::string(key) + ": must be a list");
        return found ? *found : none;
    }

    /// A whole number from 0, below 2^53.
    [[nodiscard]] std::size_t count(const char* key) const {
        const Json* const found = find(key);
        if (!found)
            fail(std::string(key) + ": is missing");
        return count_in(*found, key);
    }
    [[nodiscard]] std::size_t count(const char* key, std::size_t otherwise) const {
        return find(key) ? count(key) : otherwise;
    }
    [[nodiscard]] std::size_t count_in(const Json& number, const char* key) const {
        const double value = number.is_number() ? number.get<double>() : -1;
        if (!(value >= 0 && value < 9e15 && value == std::floor(value)))
            fail(std::string(key) + ": must be a whole number from 0");
        return static_cast<std::size_t>(value);
    }

    /// A text; empty if there is none.
    [[nodiscard]] std::string text(const char* key) const {
        const Json* const found = find(key);
        return found && found->is_string() ? found->get<std::string>() : std::string();
    }

    [[nodiscard]] bool flag(const char* key) const {
        const Json* const found = find(key);
        return found && found->is_boolean() && found->get<bool>();
    }

    /// Numbers of a list of a fixed length; empty if there is no such member.
    [[nodiscard]] std::vector<double> numbers(const char* key, std::size_t length) const {
        std::vector<double> numbers;
        for (const Json& number : list(key)) {
            if (!number.is_number() || !std::isfinite(number.get<double>()))
                fail(std::string(key) + ": must be a list of finite numbers");
            numbers.push_back(number.get<double>());
        }
        if (!numbers.empty() && numbers.size() != length)
            fail(std::string(key) + ": has " + std::to_string(numbers.size()) + " numbers instead of " +
                 std::to_string(length));
        return numbers;
    }

    /// Whether the item has a member of this name in its "extensions".
    [[nodiscard]] bool has_extension(const char* name) const {
        const Json* const extensions = find("extensions");
        return extensions && extensions->is_object() && extensions->contains(name);
    }
};

/// The entry of a list of the file. `kind` is "node" for "nodes" and so on.
inline GltfItem gltf_item(const Json& file, const std::string& kind, std::size_t index) {
    const std::string list = kind == "mesh" ? "meshes" : kind + "s";
    const std::string place = kind + " " + std::to_string(index);
    const auto found = file.find(list);
    if (found == file.end() || !found->is_array() || index >= found->size())
        throw InvalidInput("there is no " + place);
    const Json& item = (*found)[index];
    if (!item.is_object())
        throw InvalidInput(place + ": must be an object");
    return {item, place};
}

} // namespace chasles::io
