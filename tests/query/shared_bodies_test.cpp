// Many threads share one body: for any simultaneous queries, each thread gets the answers of a single thread. The test
// uses threads of the standard library, which the thread sanitizer supports, instead of oneTBB.
#include "chasles/query/path.h"
#include "tests/query/bodies.h"

#include <atomic>
#include <gtest/gtest.h>
#include <thread>

namespace chasles::test {
namespace {

constexpr int thread_count = 8;

/// Runs all kinds of queries in one thread. `first` selects the first query, which differs between threads.
std::vector<FirstContact> ask_all(const Polyhedron& moving, const Polyhedron& fixed, std::span<const Pose> poses,
                                  std::size_t first) {
    std::vector<FirstContact> answers(3 * (poses.size() - 1) + 1);
    for (std::size_t step = 0; step + 1 < poses.size(); ++step) {
        const std::size_t i = (first + step) % (poses.size() - 1);
        const Polyhedron copy = moving; // copies share their data
        const ScrewMotion screw = ScrewMotion::between(poses[i], poses[i + 1]);
        answers[3 * i] = first_contact({.moving = copy, .fixed = fixed, .motion = screw});
        answers[3 * i + 1] = first_contact({.moving = fixed,
                                            .fixed = copy,
                                            .motion = SweepMotion::between(poses[i], poses[i + 1]),
                                            .options = {.find = Find::first_with_all_contacts}});
        answers[3 * i + 2] =
            first_contact({.moving = moving, .fixed = moving, .motion = screw, .options = {.find = Find::any}});
    }
    answers.back() = first_contact_on_path({.moving = moving, .fixed = fixed, .motions = screws_along(poses)}).contact;
    return answers;
}

bool same(const FirstContact& a, const FirstContact& b) {
    const auto sizes = [](const FirstContact& x) { return std::pair(x.contacts.size(), x.overlap.has_value()); };
    return a.verdict == b.verdict && a.certain == b.certain && a.time.lower == b.time.lower &&
           a.time.upper == b.time.upper && a.tau.lower == b.tau.lower && a.tau.upper == b.tau.upper &&
           sizes(a) == sizes(b) && a.work.elementary_tests == b.work.elementary_tests;
}

TEST(SharedBodies, ManyThreadsGetTheAnswersOfOne) {
    std::mt19937 random(31);
    const Polyhedron moving = random_octahedron(random).polyhedron();
    const Polyhedron fixed = box({0.5, 0.4, 0.6}).polyhedron();
    std::vector<Pose> poses;
    for (int i = 0; i < 40; ++i)
        poses.push_back(random_pose(random, 2.5, 1));
    const std::vector<FirstContact> expected = ask_all(moving, fixed, poses, 0);
    std::atomic<int> same_answers = 0;
    std::vector<std::thread> threads;
    for (int t = 0; t < thread_count; ++t)
        threads.emplace_back([&, t] {
            const std::vector<FirstContact> found = ask_all(moving, fixed, poses, std::size_t(5 * t));
            for (std::size_t i = 0; i < found.size(); ++i)
                same_answers += same(found[i], expected[i]) ? 1 : 0;
        });
    for (std::thread& thread : threads)
        thread.join();
    EXPECT_EQ(same_answers, thread_count * int(expected.size()));
}

} // namespace
} // namespace chasles::test
