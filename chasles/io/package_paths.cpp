// Packages are looked for by the given map, then beside the file and in the folders above it.
#include "chasles/io/package_paths.h"

#include "chasles/base/invalid_input.h"
#include "chasles/io/text_scan.h"

#include <algorithm>
#include <tinyxml2.h>
#include <vector>

namespace chasles::io {

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
    return std::string(Words(text ? text : "").next());
}

/// Where REST of package://NAME/REST may be, the most likely first.
std::vector<fs::path> places(const std::string& name, const fs::path& rest, const fs::path& urdf,
                             const RobotFiles& files) {
    if (const auto given = files.packages.find(name); given != files.packages.end())
        return {given->second / rest};
    std::vector<fs::path> all;
    std::error_code error;
    fs::path folder = fs::absolute(urdf, error).lexically_normal().parent_path();
    while (true) {
        all.push_back(folder / name / rest);
        if (folder.filename() == name || package_name(folder) == name)
            all.push_back(folder / rest);
        if (!folder.has_relative_path())
            return all;
        folder = folder.parent_path();
    }
}

std::string listed(const std::vector<fs::path>& paths) {
    constexpr std::size_t most = 4;
    std::string list;
    for (std::size_t i = 0; i < std::min(most, paths.size()); ++i)
        list += (i > 0 ? ", " : "") + one_line(paths[i].string());
    return list + (paths.size() > most ? ", and the folders above" : "");
}

} // namespace

fs::path resolved(const std::string& uri, const fs::path& urdf, const RobotFiles& files) {
    constexpr std::string_view package = "package://", model = "model://", file = "file://";
    std::vector<fs::path> tried;
    std::string hint;
    if (uri.starts_with(package) || uri.starts_with(model)) {
        const std::string path = uri.substr(std::min(uri.find_first_not_of('/', uri.find("//")), uri.size()));
        const std::size_t end = path.find('/');
        const std::string name = path.substr(0, end);
        if (name.empty() || end == std::string::npos)
            throw InvalidInput(in_quotes(uri) + " names no file in a package");
        tried = places(name, path.substr(end + 1), urdf, files);
        if (!files.packages.contains(name))
            hint = "; name the folder of the package " + in_quotes(name);
    } else if (uri.starts_with(file)) {
        tried = {uri.substr(file.size())};
    } else if (uri.find("://") != std::string::npos) {
        throw InvalidInput(in_quotes(uri) + " is no package://, no file:// and no path");
    } else {
        tried = {urdf.parent_path() / uri};
    }
    const auto found = std::ranges::find_if(tried, is_file);
    if (found == tried.end())
        throw InvalidInput("there is no file " + in_quotes(uri) + "; tried " + listed(tried) + hint);
    return *found;
}

} // namespace chasles::io
