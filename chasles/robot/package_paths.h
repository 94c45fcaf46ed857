// Finds the files that a robot's file refers to.
#pragma once

#include "chasles/robot/robot.h"

#include <filesystem>
#include <map>
#include <set>
#include <string>
#include <vector>

namespace chasles::robot {

struct FoundFile {
    std::filesystem::path path;
    /// The name of a package that was not found: the file was found by the rest of its path, and may be of another
    /// package. Empty if there is no doubt.
    std::string missing_package = {};
    std::string given_package = {}; ///< the name of RobotFiles::packages that led to the file; empty if none did
};

/// The file that a URI of a URDF file means: package://NAME/REST, file://PATH, or a path, which is relative to the URDF
/// file. Throws InvalidInput with all places where the file was looked for.
FoundFile found_file(const std::string& uri, const std::filesystem::path& urdf, const RobotFiles& files);

/// Collects the packages that were not found, and those that were given and are not used. Robots that were copied
/// without their packages have many meshes: each package makes one warning.
class PackageWarnings {
public:
    /// `place` is that of the element which names the file.
    void add(const FoundFile& file, const std::string& place);
    void add_to(std::vector<std::string>& warnings, const RobotFiles& files) const;

private:
    struct Taken {
        std::string place;
        std::filesystem::path first;
        std::set<std::filesystem::path> files;
    };
    std::map<std::string, Taken> missing_; ///< by name
    std::set<std::string> used_;           ///< names of packages that were given
};

/// How users say where a package is, for messages: by --packages NAME=FOLDER, or in Python.
std::string way_to_name_package(const std::string& package);

} // namespace chasles::robot
