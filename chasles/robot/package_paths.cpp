// Packages are looked for by the given map, then beside the file and in the folders above it.
#include "chasles/robot/package_paths.h"

#include "chasles/base/invalid_input.h"
#include "chasles/io/text_scan.h"

#include <algorithm>
#include <iterator>
#include <optional>
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
    if (!fs::is_regular_file(file, error) || fs::file_size(file, error) > 1'000'000)
        return {};
    tinyxml2::XMLDocument document;
    if (document.LoadFile(file.c_str()) != tinyxml2::XML_SUCCESS || !document.RootElement())
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
std::optional<fs::path> given_place(const fs::path& path, const RobotFiles& files) {
    fs::path name = path.parent_path(), rest = path.filename();
    for (; !name.empty(); rest = name.filename() / rest, name = name.parent_path())
        if (const auto given = files.packages.find(name.generic_string()); given != files.packages.end())
            return given->second / rest;
    return std::nullopt;
}

/// Where NAME/REST of a package may be, the most likely first: in a folder NAME or in a folder whose package.xml says
/// NAME, and at last where folders above lack the first parts of the path, for robots that were copied without them.
std::vector<fs::path> places(const fs::path& path, const fs::path& urdf, const RobotFiles& files) {
    if (const auto given = given_place(path, files))
        return {*given};
    const std::vector<fs::path> folders = folders_above(urdf);
    const std::string name = path.begin()->string();
    std::vector<fs::path> all;
    for (const fs::path& folder : folders) {
        all.push_back(folder / path);
        if (folder.filename() == name || package_name(folder) == name)
            all.push_back(folder / without_first(path));
    }
    for (fs::path rest = without_first(path); rest.has_parent_path(); rest = without_first(rest))
        for (const fs::path& folder : folders)
            all.push_back(folder / rest);
    return all;
}

std::string listed(const std::vector<fs::path>& paths) {
    constexpr std::size_t most = 4;
    std::string list;
    for (std::size_t i = 0; i < std::min(most, paths.size()); ++i)
        list += (i > 0 ? ", " : "") + io::one_line(paths[i].string());
    return list + (paths.size() > most ? ", and the folders above" : "");
}

/// The places of a file that a URI means.
std::vector<fs::path> places_of(const std::string& uri, const fs::path& urdf, const RobotFiles& files) {
    if (uri.starts_with("file://"))
        return {uri.substr(7)};
    if (uri.find("://") == std::string::npos)
        return {urdf.parent_path() / uri};
    if (!uri.starts_with("package://") && !uri.starts_with("model://"))
        throw InvalidInput(io::in_quotes(uri) + " is no package://, no file:// and no path");
    const fs::path path = uri.substr(std::min(uri.find_first_not_of('/', uri.find("//")), uri.size()));
    if (!path.has_parent_path() || !path.has_filename())
        throw InvalidInput(io::in_quotes(uri) + " names no file in a package");
    return places(path, urdf, files);
}

} // namespace

fs::path resolved(const std::string& uri, const fs::path& urdf, const RobotFiles& files) {
    const std::vector<fs::path> tried = places_of(uri, urdf, files);
    const auto found = std::ranges::find_if(tried, is_file);
    if (found != tried.end())
        return *found;
    throw InvalidInput("there is no file " + io::in_quotes(uri) + "; tried " + listed(tried) +
                       (tried.size() > 1 ? "; name the folder of the package" : ""));
}

} // namespace chasles::robot
