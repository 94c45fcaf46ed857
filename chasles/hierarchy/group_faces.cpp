// Divides a sample of the faces by planes, then assigns every face to a group by these planes.
// The order of the faces in each group does not depend on the number of threads.
#include "chasles/hierarchy/group_faces.h"

#include "chasles/base/parallel_for.h"

#include <algorithm>
#include <utility>

namespace chasles {
namespace {

/// The sample contains one of 2^sample_bits = 16 faces.
constexpr unsigned sample_bits = 4;
/// The greatest sample of a group. It is large enough for planes that are nearly as good as planes from all faces. The
/// boxes of 16 times as many faces fit a cache.
constexpr std::size_t largest_sample = 256;
constexpr std::size_t max_depth = 32; ///< of the tree of planes
/// The number of faces in one chunk of work.
constexpr std::size_t many_faces = 1U << 14U;

/// One pseudo-random face of every 16 consecutive faces. A fixed choice would fail for grids with rows of 16 faces.
std::vector<PackedBox> sample_of(const RoundedFaces& faces) {
    std::vector<PackedBox> sample;
    if (faces.size() < fewest_to_group)
        return sample;
    for (std::uint32_t row = 0; row < faces.size() >> sample_bits; ++row) {
        const std::uint32_t random = row * 0x9e3779b9U; // multiples of the golden ratio are evenly distributed
        sample.push_back(faces.box(row << sample_bits | random >> (32U - sample_bits)));
    }
    return sample;
}

/// Sorts faces by group: counts the faces of each group in every chunk, sums the counts up, and moves the faces.
class Sorting {
public:
    Sorting(std::size_t faces, std::size_t groups)
        : group_of_(faces), groups_(groups), next_((faces + many_faces - 1) / many_faces * groups) {}

    /// Finds the group of each face and counts the faces of each group in each chunk.
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

    /// Turns the counts into positions: group by group, and within a group chunk by chunk. Returns the start of each
    /// group and the number of faces.
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

    /// Writes each face to the next position of its group. Within a group the faces stay in ascending order.
    void move(std::span<std::uint32_t> sorted, unsigned threads) {
        parallel_chunks(threads, group_of_.size(), many_faces,
                        [&](std::size_t index, std::size_t begin, std::size_t end) {
                            const std::span<std::uint32_t> next = next_of(index);
                            for (std::size_t face = begin; face < end; ++face)
                                sorted[next[group_of_[face]]++] = static_cast<std::uint32_t>(face);
                        });
    }

private:
    /// The counts or positions of one chunk.
    std::span<std::uint32_t> next_of(std::size_t index) { return std::span(next_).subspan(index * groups_, groups_); }

    std::vector<std::uint32_t> group_of_;
    std::size_t groups_;
    std::vector<std::uint32_t> next_; ///< for each chunk: one count, later one position, for each group
};

} // namespace

PlaneTree::PlaneTree(std::vector<PackedBox> sample) : root_(grow(sample, GroupBounds(sample), 0)) {}

PlaneTree::Place PlaneTree::grow(std::span<PackedBox> sample, const GroupBounds& bounds, std::size_t depth) {
    if (sample.size() > largest_sample && depth < max_depth)
        if (const std::optional<Plane> plane = best_plane(sample, bounds)) {
            const Division division = divide_by(*plane, sample);
            if (division.first > 0 && division.first < sample.size()) {
                // The node gets its place before its children, because both children append nodes.
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
