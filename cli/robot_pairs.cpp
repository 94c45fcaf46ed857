#include "cli/robot_pairs.h"

#include "cli/report.h"

namespace chasles::cli {
namespace {

std::string second_of(const RobotPair& pair) {
    return pair.second + (pair.is_with_scene ? " (scene)" : "");
}

} // namespace

std::string report_pair(const RobotPair& pair, std::size_t segment) {
    return labelled("pair", pair.first + " on " + second_of(pair)) + labelled("segment", std::to_string(segment));
}

std::vector<RobotPair> others_at_start(const RobotChecker& checker, const JointPath& path, const RobotAnswer& found) {
    if (found.verdict != Verdict::contact_at_start)
        return {};
    try {
        std::vector<RobotPair> pairs = checker.pairs_in_contact(path.at(path.segments().front().begin));
        std::erase_if(pairs, [&](const RobotPair& pair) {
            return pair.first == found.pair->first && pair.second == found.pair->second;
        });
        return pairs;
    } catch (const Cancelled&) { // there is no time left
        return {};
    }
}

std::string report_others(const std::vector<RobotPair>& others) {
    constexpr std::size_t most = 12;
    std::vector<std::string> names;
    for (const RobotPair& pair : others)
        names.push_back(pair.first + " and " + second_of(pair));
    return others.empty() ? "" : labelled("also", shortened(names, most, names.size()));
}

} // namespace chasles::cli
