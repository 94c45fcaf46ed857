// Packages are looked for by the given map, then beside the file and in the folders above it.
#include "chasles/robot/package_paths.h"

#include "chasles/base/invalid_input.h"
#include "chasles/io/read_file.h"
#include "chasles/io/text_scan.h"

#include <algorithm>
#include <iterator>
#include <optional>
#include <string_view>
#include <tinyxml2.h>
#include <vector>

namespace chasles::robot {

namespace {

namespace fs = std::filesystem;

bool is_file(const fs::path& path) {
    std::error_code error;
    return fs::is_regular_file(path, error);
}

/// The name that a package.xml gives to its folder; empty if there is none. The first <name> of the file counts.
std::string package_name(const fs::path& folder) {
    std::error_code error;
    const fs::path file = folder / "package.xml";
    if (!fs::is_regular_file(file, error) || fs::file_size(file, error) == 0 || fs::file_size(file, error) > 1'000'000)
        return {};
    const std::string content = io::read_file(file);
    tinyxml2::XMLDocument document;
    if (document.Parse(content.data(), content.size()) != tinyxml2::XML_SUCCESS || !document.RootElement())
        return {};
    const tinyxml2::XMLElement* const name = document.RootElement()->FirstChildElement("name");
    const char* const text = name ? name->GetText() : nullptr;
    return std::string(io::Words(text ? text : "").next());
}

/// The folder of a file and the folders above it, the nearest first.
std::vector<fs::path> folders_above(const fs::path& file) {
    std::error_code error;
    std::vector<fs::path> folders{fs::absolute(file, error).lexically_normal().parent_path()};
    while (folders.back().has_relative_path())
        folders.push_back(folders.back().parent_path());
    return folders;
}

/// The path without its first part.
fs::path without_first(const fs::path& path) {
    fs::path rest;
    for (auto part = std::next(path.begin()); part != path.end(); ++part)
        rest /= *part;
    return rest;
}

/// By the given packages: their names may have several parts, of which the most count.
std::optional<FoundFile> given_place(const fs::path& path, const RobotFiles& files) {
    fs::path name = path.parent_path(), rest = path.filename();
    for (; !name.empty(); rest = name.filename() / rest, name = name.parent_path())
        if (const auto given = files.packages.find(name.generic_string()); given != files.packages.end())
            return FoundFile{given->second / rest, {}, given->first};
    return std::nullopt;
}

/// Where NAME/REST of a package may be, the most likely first: in a folder NAME or in a folder whose package.xml says
/// NAME, and at last where folders above lack the first parts of the path, for robots that were copied without them.
std::vector<FoundFile> places(const fs::path& path, const fs::path& urdf, const RobotFiles& files) {
    if (const auto given = given_place(path, files))
        return {*given};
    const std::vector<fs::path> folders = folders_above(urdf);
    const std::string name = path.begin()->string();
    std::vector<FoundFile> all;
    for (const fs::path& folder : folders) {
        all.push_back({folder / path});
        if (folder.filename() == name || package_name(folder) == name)
            all.push_back({folder / without_first(path)});
    }
    for (fs::path rest = without_first(path); rest.has_parent_path(); rest = without_first(rest))
        for (const fs::path& folder : folders)
            all.push_back({folder / rest, name});
    return all;
}

/// In full, as paths are of use only when they are.
std::string quoted(const std::string& uri) {
    return '\'' + io::one_line(uri) + '\'';
}

std::string listed(const std::vector<FoundFile>& files) {
    constexpr std::size_t most = 4;
    std::vector<fs::path> different; // NAME/REST above a folder NAME is REST in it
    std::string list;
    for (const FoundFile& file : files) {
        const fs::path path = file.path.lexically_normal();
        if (std::ranges::find(different, path) != different.end())
            continue;
        if (different.size() == most)
            return list + ", and the folders above";
        list += (different.empty() ? "" : ", ") + io::one_line(file.path.string());
        different.push_back(path);
    }
    return list;
}

/// The value of a hexadecimal digit; empty for other characters.
std::optional<int> hexadecimal(char digit) {
    constexpr std::string_view digits = "0123456789abcdef";
    const std::size_t value = digits.find(io::lower_case(std::string(1, digit)));
    return value == std::string_view::npos ? std::nullopt : std::optional(int(value));
}

/// With %20 and the like replaced.
std::string decoded(const std::string& uri) {
    std::string text;
    for (std::size_t i = 0; i < uri.size(); ++i) {
        const bool is_code = uri[i] == '%' && i + 2 < uri.size() && hexadecimal(uri[i + 1]) && hexadecimal(uri[i + 2]);
        text += is_code ? char(16 * *hexadecimal(uri[i + 1]) + *hexadecimal(uri[i + 2])) : uri[i];
        i += is_code ? 2 : 0;
    }
    return text;
}

/// As it is, with the separators of Windows replaced, and with the codes of a URI replaced.
std::vector<std::string> spellings(const std::string& uri) {
    std::string with_slashes = uri;
    std::ranges::replace(with_slashes, '\\', '/');
    std::vector<std::string> all{uri, with_slashes, decoded(with_slashes)};
    all.erase(std::unique(all.begin(), all.end()), all.end());
    return all;
}

/// NAME/REST of package://NAME/REST, and of model://NAME/REST.
fs::path path_in_packages(const std::string& uri) {
    std::string path = uri.substr(std::min(uri.find_first_not_of('/', uri.find("//")), uri.size()));
    std::ranges::replace(path, '\\', '/');
    return path;
}

/// The places of a file that a URI means.
std::vector<FoundFile> places_of(const std::string& uri, const fs::path& urdf, const RobotFiles& files) {
    if (uri.starts_with("file:/"))
        return {{uri.substr(uri.starts_with("file://localhost/") ? 16 : uri.starts_with("file://") ? 7 : 5)}};
    if (uri.find("://") == std::string::npos)
        return {{urdf.parent_path() / uri}};
    if (!uri.starts_with("package://") && !uri.starts_with("model://"))
        throw InvalidInput(quoted(uri) + " is no package://, no file:// and no path");
    const fs::path path = path_in_packages(uri);
    if (!path.has_parent_path() || !path.has_filename())
        throw InvalidInput(quoted(uri) + " names no file in a package");
    return places(path, urdf, files);
}

} // namespace

FoundFile found_file(const std::string& uri, const fs::path& urdf, const RobotFiles& files) {
    std::vector<FoundFile> tried;
    for (const std::string& spelling : spellings(uri)) {
        const std::vector<FoundFile> more = places_of(spelling, urdf, files);
        if (const auto found = std::ranges::find_if(more, is_file, &FoundFile::path); found != more.end())
            return *found;
        tried.insert(tried.end(), more.begin(), more.end());
    }
    throw InvalidInput(
        "there is no file " + quoted(uri) + "; tried " + listed(tried) +
        (uri.starts_with("file:") || uri.find("://") == std::string::npos
             ? ""
             : "; say where the package is " + way_to_name_package(path_in_packages(decoded(uri)).begin()->string())));
}

void PackageWarnings::add(const FoundFile& file, const std::string& place) {
    used_.insert(file.given_package);
    if (file.missing_package.empty())
        return;
    Taken& taken = missing_.try_emplace(file.missing_package, Taken{place, file.path, {}}).first->second;
    taken.files.insert(file.path);
}

void PackageWarnings::add_to(std::vector<std::string>& warnings, const RobotFiles& files) const {
    std::error_code error;
    for (const auto& [package, folder] : files.packages)
        if (!used_.contains(package))
            warnings.push_back("packages: no collision shape has a mesh of " + io::in_quotes(package) +
                               (fs::is_directory(folder, error)
                                    ? std::string()
                                    : ", and there is no folder " + io::one_line(folder.string())));
    for (const auto& [package, taken] : missing_) {
        const std::size_t more = taken.files.size() - 1;
        warnings.push_back(taken.place + "there is no package " + io::in_quotes(package) + ": took the file " +
                           io::one_line(taken.first.string()) +
                           (more > 0 ? ", and " + std::to_string(more) + " more" : std::string()) +
                           "; say where the package is " + way_to_name_package(package));
    }
}

std::string way_to_name_package(const std::string& package) {
    const std::string name = io::one_line(package);
    return "by --packages " + name + "=FOLDER (in Python: packages={'" + name + "': FOLDER})";
}

} // namespace chasles::robot
