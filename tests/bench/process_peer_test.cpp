// Peers in separate processes: every query returns an answer or a reason of one line within its time limit.
#include "bench/process_peer.h"

#include "bench/bodies.h"
#include "tests/support/refusal.h"

#include <gtest/gtest.h>

namespace chasles::bench {
namespace {

/// A peer that is a shell script.
ProcessPeer shell(const std::string& script) {
    return {.name = "shell", .command = {"/bin/sh", "-c", script}, .pose_at = {}};
}

const std::string takes_bodies = "echo ready; read a; echo done; ";

/// The answer to one query with two copies of a body.
PeerAnswer answer_of(const Peer& peer) {
    static const Polyhedron body = bumpy_torus(8, 8);
    const PeerPair pair = peer.prepare(body, body);
    return pair.ask({});
}

std::string reason_of_no_answer(const std::string& script) {
    const Peer peer = process_peer(shell(script));
    return test::refusal<PeerFailed>([&] { answer_of(peer); });
}

TEST(ProcessPeer, Answers) {
    const PeerAnswer contact = answer_of(process_peer(shell(takes_bodies + "read a; echo answer 1 0.25 1e-3")));
    EXPECT_TRUE(contact.touches);
    EXPECT_EQ(contact.time, 0.25);
    EXPECT_EQ(contact.seconds, 1e-3);
    const PeerAnswer clear = answer_of(process_peer(shell(takes_bodies + "read a; echo answer 0 - 0")));
    EXPECT_FALSE(clear.touches);
    EXPECT_FALSE(clear.time);
}

TEST(ProcessPeer, IsToldEachBodyOnceAndThePoses) {
    const std::string repeats = takes_bodies + "read question; echo failed \"$question\"";
    EXPECT_EQ(reason_of_no_answer(repeats), "ask 0 0 0 0 0 1 0 0 0 0 0 0 1 0 0 0");
}

TEST(ProcessPeer, ThatDoesNotStartSaysWhy) {
    ProcessPeer nowhere = shell("");
    nowhere.command = {"/no/such/program"};
    EXPECT_EQ(test::refusal<PeerFailed>([&] { process_peer(nowhere); }),
              "it does not start: No such file or directory");
    EXPECT_EQ(test::refusal<PeerFailed>([&] { process_peer(shell("exit 3")); }), "it ended with exit status 3");
    EXPECT_EQ(test::refusal<PeerFailed>([&] { process_peer(shell("echo absent no library; exit 1")); }), "no library");
    EXPECT_EQ(test::refusal<PeerFailed>([&] { process_peer(shell("echo hello")); }), "it talks nonsense: hello");
}

TEST(ProcessPeer, ThatDiesSaysHow) {
    EXPECT_EQ(reason_of_no_answer(takes_bodies + "read a; exit 7"), "it ended with exit status 7");
    EXPECT_EQ(reason_of_no_answer(takes_bodies + "read a; kill -SEGV $$"), "it ended by signal 11");
    EXPECT_EQ(reason_of_no_answer("echo ready; exit 1"), "it ended with exit status 1");
}

TEST(ProcessPeer, ThatHangsIsNotWaitedFor) {
    ProcessPeer hanging = shell(takes_bodies + "read a; exec sleep 60");
    hanging.limits.question = ChildProcess::Limit(0.5);
    const Peer peer = process_peer(hanging);
    const auto start = std::chrono::steady_clock::now();
    EXPECT_EQ(test::refusal<PeerFailed>([&] { answer_of(peer); }), "no answer within 0.5 s");
    EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(20));
}

TEST(ProcessPeer, ThatDoesNotReadIsNotWaitedFor) {
    ProcessPeer deaf = shell("echo ready; exec sleep 60");
    deaf.limits.body = ChildProcess::Limit(0.5);
    const Polyhedron large = bumpy_torus(200, 200); // more than the buffer of the socket
    const Peer peer = process_peer(deaf);
    EXPECT_EQ(test::refusal<PeerFailed>([&] { peer.prepare(large, large); }), "no answer within 0.5 s");
}

TEST(ProcessPeer, ThatTalksNonsenseIsNotBelieved) {
    for (const char* line : {"", "answer", "answer 1", "answer 2 0.5 1", "answer 1 0.5 -1", "answer 1 1.5 1",
                             "answer 1 0.5x 1", "answer 1 nan 1", "answer 0 - 1 more", "reply 0 - 1"})
        EXPECT_EQ(reason_of_no_answer(takes_bodies + "read a; echo '" + line + "'"),
                  std::string("it talks nonsense: ") + line);
}

TEST(ProcessPeer, StartsAgainAfterAFailure) {
    const std::string mark = testing::TempDir() + "chasles_process_peer_" +
                             std::to_string(::testing::UnitTest::GetInstance()->random_seed());
    std::remove(mark.c_str());
    const Peer peer = process_peer(
        shell(takes_bodies + "read a; [ -e " + mark + " ] || { touch " + mark + "; exit 1; }; echo answer 0 - 1"));
    EXPECT_EQ(test::refusal<PeerFailed>([&] { answer_of(peer); }), "it ended with exit status 1");
    EXPECT_FALSE(answer_of(peer).touches);
    std::remove(mark.c_str());
}

} // namespace
} // namespace chasles::bench
