// A sample of the faces is divided by planes as a whole body would be; then every face is led past these planes.
#include "chasles/hierarchy/group_faces.h"

#include "chasles/base/parallel_for.h"

#include <algorithm>
#include <utility>

namespace chasles {
namespace {

/// One face of 16 is drawn.
constexpr unsigned sample_bits = 4;
/// The sample of a group; so large that the planes are nearly as good as those of all faces, and 16 times as many boxes
/// fit a cache.
constexpr std::size_t largest_sample = 256;
constexpr std::size_t max_depth = 32;
/// Faces that one thread sorts in a row.
constexpr std::size_t many_faces = 1U << 14U;

/// One of every few faces in a row, which one as if by chance: rows of a grid may be as long.
std::vector<PackedBox> sample_of(const RoundedFaces& faces) {
    std::vector<PackedBox> sample;
    if (faces.size() < fewest_to_group)
        return sample;
    for (std::uint32_t row = 0; row < faces.size() >> sample_bits; ++row) {
        const std::uint32_t by_chance = row * 0x9e3779b9U; // multiples of the golden ratio spread evenly
        sample.push_back(faces.box(row << sample_bits | by_chance >> (32U - sample_bits)));
    }
    return sample;
}

/// Sorts faces by their groups: counts those of each group in every piece of the faces, adds up, and moves them.
class Sorting {
public:
    Sorting(std::size_t faces, std::size_t groups)
        : group_of_(faces), groups_(groups), next_((faces + many_faces - 1) / many_faces * groups) {}

    void count(const RoundedFaces& faces, const PlaneTree& planes, unsigned threads) {
        parallel_chunks(threads, group_of_.size(), many_faces,
                        [&](std::size_t index, std::size_t begin, std::size_t end) {
                            const std::span<std::uint32_t> counts = next_of(index);
                            for (std::size_t face = begin; face < end; ++face) {
                                group_of_[face] = planes.group_of(faces.box(face));
                                ++counts[group_of_[face]];
                            }
                        });
    }

    /// From numbers of faces to places, group by group, and in each the pieces in order. Answers where groups begin.
    std::vector<std::uint32_t> add_up() {
        std::vector<std::uint32_t> begin;
        std::uint32_t sum = 0;
        for (std::size_t group = 0; group < groups_; ++group) {
            begin.push_back(sum);
            for (std::size_t index = group; index < next_.size(); index += groups_)
                sum += std::exchange(next_[index], sum);
        }
        begin.push_back(sum);
        return begin;
    }

    void move(std::span<std::uint32_t> sorted, unsigned threads) {
        parallel_chunks(threads, group_of_.size(), many_faces,
                        [&](std::size_t index, std::size_t begin, std::size_t end) {
                            const std::span<std::uint32_t> next = next_of(index);
                            for (std::size_t face = begin; face < end; ++face)
                                sorted[next[group_of_[face]]++] = static_cast<std::uint32_t>(face);
                        });
    }

private:
    std::span<std::uint32_t> next_of(std::size_t index) { return std::span(next_).subspan(index * groups_, groups_); }

    std::vector<std::uint32_t> group_of_;
    std::size_t groups_;
    std::vector<std::uint32_t> next_; ///< of each piece: a number for each group
};

} // namespace

PlaneTree::PlaneTree(std::vector<PackedBox> sample) : root_(grow(sample, GroupBounds(sample), 0)) {}

PlaneTree::Place PlaneTree::grow(std::span<PackedBox> sample, const GroupBounds& bounds, std::size_t depth) {
    if (sample.size() > largest_sample && depth < max_depth)
        if (const std::optional<Plane> plane = best_plane(sample, bounds)) {
            const Division division = divide_by(*plane, sample);
            if (division.first > 0 && division.first < sample.size()) {
                const auto place = static_cast<Place>(nodes_.size());
                nodes_.push_back({*plane, {}});
                const Place first = grow(sample.first(division.first), division.bounds[0], depth + 1);
                const Place second = grow(sample.subspan(division.first), division.bounds[1], depth + 1);
                nodes_[place].parts = {first, second};
                return place;
            }
        }
    return group_bit | group_count_++;
}

FaceGroups group_faces(const RoundedFaces& faces, unsigned threads) {
    FaceGroups groups{PlaneTree(sample_of(faces)), {{}, std::vector<std::uint32_t>(faces.size())}};
    Sorting sorting(faces.size(), groups.planes.group_count());
    sorting.count(faces, groups.planes, threads);
    groups.faces.offsets = sorting.add_up();
    sorting.move(groups.faces.items, threads);
    return groups;
}

} // namespace chasles
