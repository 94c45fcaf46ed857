// Any byte sequence as a pose, a point, a path and a list of motions: each reader reads or refuses it.
#include "chasles/base/invalid_input.h"
#include "chasles/io/csv_table.h"
#include "chasles/io/motion_files.h"
#include "chasles/io/pose_text.h"
#include "tests/fuzz/bytes.h"

#include <algorithm>
#include <cmath>

namespace chasles::fuzz {
namespace {

void demand_sound(const Pose& pose) {
    demand(pose.translation.allFinite() && pose.rotation.coeffs().allFinite(), "poses that are read are finite");
    const double norm = pose.rotation.norm();
    demand(norm > 0 && std::isfinite(norm), "quaternions that are read can be normalised");
}

void demand_sound(const io::Path& path) {
    for (const Pose& pose : path.poses)
        demand_sound(pose);
    demand(path.stamps.empty() || path.stamps.size() == path.poses.size(), "every pose has a stamp");
    demand(std::ranges::is_sorted(path.stamps), "stamps increase");
}

template <class Read>
void unless_refused(Read read) {
    try {
        read();
    } catch (const InvalidInput& error) { // refused, which is an answer
        demand(*error.what() != 0, "a refusal has a reason");
    }
}

void demand_cells_read_back(std::string_view text) {
    const std::string_view line = text.substr(0, text.find('\n'));
    for (const std::string& cell : io::split_csv(line)) {
        const std::vector<std::string> again = io::split_csv(io::csv_cell(cell));
        demand(again.size() == 1 && again.front() == cell, "a cell that is written is read back");
    }
}

} // namespace
} // namespace chasles::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace chasles;
    const std::string_view text = fuzz::text_of(data, size);
    fuzz::unless_refused([&] { fuzz::demand_sound(io::parse_pose(text)); });
    fuzz::unless_refused([&] { fuzz::demand(io::parse_point(text).allFinite(), "points are finite"); });
    for (const auto without_header : {io::WithoutHeader::refused, io::WithoutHeader::tum})
        fuzz::unless_refused([&] { fuzz::demand_sound(io::read_path(text, without_header)); });
    fuzz::unless_refused([&] {
        for (const io::MotionRow& row : io::read_motions(text).rows) {
            fuzz::demand_sound(row.start);
            fuzz::demand_sound(row.goal);
        }
    });
    fuzz::demand_cells_read_back(text);
    return 0;
}
