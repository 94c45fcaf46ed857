// Runs fixed sets of queries and prints a digest of all bits of all answers, one line per set. Builds with different
// compilers, optimisations or instruction sets, and any number of threads, must print the same digests. Usage: bits
// [THREADS]. Exit status 77 means that the processor lacks an instruction set of this program.
#include "chasles/query/batch.h"
#include "chasles/query/path.h"
#include "scenes/nut_motions.h"
#include "scenes/threaded_fastener.h"

#include <array>
#include <bit>
#include <cinttypes>
#include <cstdio>
#include <cstdlib>
#include <random>

namespace chasles::bits {
namespace {

/// The FNV-1a hash of its input.
class Digest {
public:
    void add(std::uint64_t word) {
        for (int i = 0; i < 8; ++i, word >>= 8)
            hash_ = (hash_ ^ (word & 0xff)) * 0x100000001b3u;
    }
    void add(double number) { add(std::bit_cast<std::uint64_t>(number)); }
    void add(const Eigen::Vector3d& v) {
        for (const double x : v)
            add(x);
    }
    void add(const Bracket& bracket) {
        add(bracket.lower);
        add(bracket.upper);
    }
    void add(const Feature& feature) { add(std::uint64_t(feature.first) << 32 | feature.second); }
    void add(const Contact& contact) {
        add(std::uint64_t(contact.kind));
        add(contact.moving);
        add(contact.fixed);
        add(contact.point);
        add(contact.normal);
        add(contact.approach_speed);
    }
    void add(const Overlap& overlap) {
        add(std::uint64_t(overlap.edge_is_moving) << 1 | std::uint64_t(overlap.certain));
        add(overlap.edge);
        add(overlap.face);
        add(overlap.point);
    }
    void add(const FirstContact& found) {
        add(std::uint64_t(found.verdict) << 1 | std::uint64_t(found.certain));
        add(found.time);
        add(found.tau);
        for (const Contact& contact : found.contacts)
            add(contact);
        if (found.overlap)
            add(*found.overlap);
        add(found.pose.translation);
        for (const double x : found.pose.rotation.coeffs())
            add(x);
        for (const std::uint64_t count : {found.work.node_pairs, found.work.face_pairs, found.work.elementary_tests,
                                          found.work.root_brackets, found.work.refined})
            add(count);
    }
    void print(const char* name) const { std::printf("%-10s %016" PRIx64 "\n", name, hash_); }

private:
    std::uint64_t hash_ = 0xcbf29ce484222325u;
};

/// Random numbers that are identical for every standard library. With `steps`, the numbers lie on a grid of `steps`
/// points per unit.
class Random {
public:
    explicit Random(std::uint64_t seed, double steps = 0) : engine_(seed), steps_(steps) {}

    double number(double size) {
        const double x = size * (double(engine_() >> 11) * 0x1p-52 - 1);
        return steps_ > 0 ? double(long(x * steps_)) / steps_ : x;
    }
    Eigen::Vector3d point(double size) {
        const double x = number(size);
        const double y = number(size);
        return {x, y, number(size)};
    }
    Pose pose(double size) {
        const Eigen::Vector3d position = point(size);
        const Eigen::Vector3d v = point(1);
        return {position, Eigen::Quaterniond(2, v.x(), v.y(), v.z())};
    }

private:
    std::mt19937_64 engine_;
    double steps_;
};

using Faces = std::vector<std::vector<std::uint32_t>>;

/// An octahedron of eight triangles with displaced corners.
Polyhedron octahedron(Random& random) {
    std::vector<Eigen::Vector3d> vertices;
    for (int axis = 0; axis < 3; ++axis)
        for (const double sign : {1.0, -1.0})
            vertices.emplace_back(sign * Eigen::Vector3d::Unit(axis) + random.point(0.25));
    const Faces faces{{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4}, {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}};
    return Polyhedron::from_polygons(vertices, faces);
}

void ask(Digest& digest, const Polyhedron& moving, const Polyhedron& fixed, const Motion& motion) {
    for (const Find find : {Find::first, Find::any, Find::first_with_all_contacts})
        digest.add(first_contact({.moving = moving, .fixed = fixed, .motion = motion, .options = {.find = find}}));
}

/// Random bodies. On a grid, edges are parallel, faces share planes, and touches are exact.
void small_bodies(const char* name, int count, Random random) {
    Digest digest;
    for (int i = 0; i < count; ++i) {
        const Polyhedron a = octahedron(random);
        const Polyhedron b = octahedron(random);
        const Pose start = random.pose(3);
        const Pose goal = random.pose(3);
        const Pose fixed_goal = random.pose(1);
        ask(digest, a, b, ScrewMotion::between(start, goal));
        ask(digest, a, b, SweepMotion::between(start, goal, random.point(1)));
        ask(digest, a, b, ScrewMotion::relative(start, goal, Pose(), fixed_goal));
        ask(digest, a, b, ScrewMotion::between(start, Pose(goal.translation, start.rotation)));
    }
    digest.print(name);
}

/// A nut on its bolt: along the thread, and with a wrong pitch.
void large_bodies(unsigned threads) {
    scenes::ThreadedFastener fastener;
    fastener.segments = 24;
    fastener.radial_clearance = 0.2;
    const Polyhedron bolt = scenes::bolt(fastener);
    const Polyhedron nut = scenes::nut(fastener);
    Digest path_digest;
    Digest batch_digest;
    for (const double slide : {2.0, 2.5}) {
        const std::vector<Pose> poses = scenes::nut_path({.height = 16, .turns = 0.25, .slide_per_turn = slide});
        const PathContact found = first_contact_on_path({.moving = nut, .fixed = bolt, .motions = screws_along(poses)});
        path_digest.add(std::uint64_t(found.segment));
        path_digest.add(found.contact);
        std::vector<Motion> motions;
        for (std::size_t i = 0; i + 1 < poses.size(); ++i) {
            motions.emplace_back(ScrewMotion::between(poses[i], poses[i + 1]));
            motions.emplace_back(SweepMotion::between(poses[i], poses[i + 1]));
        }
        for (const FirstContact& one :
             first_contact_batch({.moving = nut, .fixed = bolt, .motions = motions, .batch = {.threads = threads}}))
            batch_digest.add(one);
    }
    path_digest.print("path");
    batch_digest.print("batch");
}

/// Many motions of one pair, distributed over threads.
void many_motions(unsigned threads) {
    Random random(3);
    const Polyhedron a = octahedron(random);
    const Polyhedron b = octahedron(random);
    std::vector<Motion> motions;
    for (int i = 0; i < 400; ++i) {
        const Pose start = random.pose(3);
        motions.emplace_back(ScrewMotion::between(start, random.pose(3)));
    }
    Digest digest;
    for (const FirstContact& one :
         first_contact_batch({.moving = a, .fixed = b, .motions = motions, .batch = {.threads = threads}}))
        digest.add(one);
    digest.print("motions");
}

} // namespace
} // namespace chasles::bits

int main(int count, char** arguments) {
#if defined(__AVX2__)
    if (!__builtin_cpu_supports("avx2") || !__builtin_cpu_supports("fma"))
        return 77;
#endif
    using namespace chasles::bits;
    const auto threads = count > 1 ? unsigned(std::atoi(arguments[1])) : 1u;
    small_bodies("random", 150, Random(1));
    small_bodies("grid", 150, Random(2, 4));
    many_motions(threads);
    large_bodies(threads);
}
