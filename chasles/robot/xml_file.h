// XML files with messages that name file, line and element.
#pragma once

#include "chasles/base/invalid_input.h"

#include <array>
#include <filesystem>
#include <initializer_list>
#include <optional>
#include <string>
#include <string_view>
#include <tinyxml2.h>
#include <vector>

namespace chasles::robot {

/// An error that names file, line and element already.
struct XmlFault : InvalidInput {
    using InvalidInput::InvalidInput;
};

/// A parsed file. Elements live as long as it.
class XmlFile {
public:
    using Element = tinyxml2::XMLElement;

    /// Throws InvalidInput "FILE:LINE: WHY" for what is no XML, whose root has another name, that has two roots, or
    /// that is source of xacro.
    XmlFile(const std::filesystem::path& file, const char* root);

    [[nodiscard]] const Element& root() const { return *document_.RootElement(); }
    [[nodiscard]] const std::filesystem::path& path() const { return path_; }

    void copy_to(tinyxml2::XMLDocument& document) const { document_.DeepCopy(&document); }

    /// "FILE:LINE: <ELEMENT NAME>: ", for messages.
    [[nodiscard]] std::string place_of(const Element& element) const;
    /// Throws XmlFault "FILE:LINE: <ELEMENT NAME>: WHY".
    [[noreturn]] void fail(const Element& element, const std::string& why) const;

    /// The children of this name, in order.
    static std::vector<const Element*> children(const Element& element, const char* name);
    /// All children whose names have no namespace, in order: programs add elements of their own (<drake:...>).
    static std::vector<const Element*> plain_children(const Element& element);
    /// Fails for a child that is not read because its name is one of these with other capitals or, of five letters or
    /// more, with a slip.
    void require_no_misspelt_child(const Element& element, std::initializer_list<std::string_view> names) const;
    /// Likewise for an attribute, with a slip of three letters or more.
    void require_no_misspelt_attribute(const Element& element, std::initializer_list<std::string_view> names) const;
    /// Null if there is none; fails if there are several that differ.
    [[nodiscard]] const Element* child(const Element& element, const char* name) const;
    [[nodiscard]] const Element& required_child(const Element& element, const char* name) const;

    /// The value of an attribute without blanks around it; fails if it is missing or empty, or is source of xacro.
    [[nodiscard]] std::string text(const Element& element, const char* attribute) const;
    [[nodiscard]] std::optional<std::string> optional_text(const Element& element, const char* attribute) const;
    /// Finite numbers; fails for another count.
    [[nodiscard]] std::vector<double> numbers(const Element& element, const char* attribute, std::size_t count) const;
    [[nodiscard]] double number(const Element& element, const char* attribute) const;
    [[nodiscard]] double number(const Element& element, const char* attribute, double otherwise) const;

private:
    void refuse_xacro(const Element& element) const;

    std::filesystem::path path_;
    tinyxml2::XMLDocument document_;
};

} // namespace chasles::robot
