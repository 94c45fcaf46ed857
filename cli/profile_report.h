// The distance over time as text, JSON, a table and a picture: of two bodies, of a scene or of a robot.
#pragma once

#include "chasles/query/profile.h"
#include "cli/commands.h"
#include "cli/output.h"
#include "cli/report.h"
#include "view/answer_json.h"

#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace chasles::cli {

struct ProfileFlags {
    std::string absolute_tolerance = "0";
    std::vector<std::string> margins;
    std::string csv;  ///< empty: none
    std::string plot; ///< likewise
};

/// The options have no effect without the one that is needed, if there is one.
void add_profile_options(CLI::App& command, ProfileFlags& flags, CLI::Option* needed = nullptr);

/// Refuses --tolerance where none of its questions is asked.
void require_question_of(const std::string& tolerance, bool is_given,
                         const std::string& questions = "--clearance or --profile");

/// Refuses --csv and --plot where neither --profile nor --matrix is given.
void require_answer_of(const ProfileFlags& files, bool is_given);
/// Refuses the name of a picture that is no SVG.
void require_svg(const std::string& plot);
/// Writes what `text` returns, if there is a file.
void write_to(std::optional<OutputFile>& file, const std::function<std::string()>& text);

/// A profile, and the names of the pairs that its steps count.
struct NamedProfile {
    DistanceProfile distance;
    std::vector<std::pair<std::string, std::string>> pairs;
    bool has_names = false; ///< not where there are only two bodies; with names there may be no pair
};

/// What is asked, and the files to write.
class ProfileRequest {
public:
    /// `tolerance` is as its option has it; empty: 0.01. The flags are kept by reference.
    ProfileRequest(const ProfileFlags& flags, const std::string& tolerance);

    [[nodiscard]] const ProfileOptions& options() const { return options_; }
    /// Before the answer is looked for, and after all files were read: an output that is an input is refused.
    void open_files();
    void write(const NamedProfile& found);
    /// What follows the headline. Times are parts of the motion, or stamps.
    [[nodiscard]] std::string text(const NamedProfile& found) const;
    [[nodiscard]] view::Json json(const NamedProfile& found, ExitStatus status) const;

private:
    const ProfileFlags& flags_;
    ProfileOptions options_;
    std::optional<OutputFile> csv_;
    std::optional<OutputFile> plot_;
};

std::string profile_headline(const DistanceProfile& found, std::string_view motion);

ExitStatus status_of(const DistanceProfile& found, bool time_was_over);

} // namespace chasles::cli
