// The checker, which shares nothing with the library, verifies what the library certifies, and refuses what is altered.
#include "chasles/certificate/certificate.h"

#include "chasles/base/limit.h"
#include "chasles/base/sha256.h"
#include "chasles/mesh/primitives.h"
#include "tests/certificate/checked.h"
#include "tests/support/grid.h"
#include "tests/support/own_file.h"
#include "tests/support/refusal.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>

namespace chasles::test {
namespace {

TEST(Sha256, HasTheValuesOfItsStandard) {
    const auto digest = [](const std::string& text) {
        Sha256 hash;
        hash.add({reinterpret_cast<const unsigned char*>(text.data()), text.size()});
        return hash.digest();
    };
    EXPECT_EQ(digest(""), "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855");
    EXPECT_EQ(digest("abc"), "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
    EXPECT_EQ(digest("abcdbcdecdefdefgefghfghighijhijkijkljklmklmnlmnomnopnopq"),
              "248d6a61d20638b8e5c026930c3e6039a33ce45964ff2167f6ecedd419db06c1");
}

class Certificates : public ::testing::Test {
protected:
    [[nodiscard]] Polyhedron random_body() { return bodies_(random_); }
    [[nodiscard]] FirstContactQuery random_query() {
        const Pose start = random_pose(random_, 2);
        const Pose goal = random_goal(random_, start, random_.uniform(0, 3), 2);
        FirstContactQuery query{random_body(), random_body(), ScrewMotion::between(start, goal)};
        query.options.margin = random_.chance(0.3) ? random_.uniform(0, 0.3) : 0;
        return query;
    }

    Random random_{4747};
    RandomBodies bodies_;
};

TEST_F(Certificates, OfRandomQuestionsAreVerified) {
    std::map<Verdict, int> count;
    int inside = 0;
    for (int round = 0; round < 800; ++round) {
        const FirstContactQuery query = random_query();
        const Verdict verdict = first_contact(query).verdict;
        const Certificate proof = expect_verified(query, verdict);
        ASSERT_FALSE(HasFailure()) << round;
        ++count[verdict];
        inside += proof.text.find("witness inside") != std::string::npos;
    }
    EXPECT_GT(count[Verdict::clear], 100);
    EXPECT_GT(count[Verdict::contact], 80);
    EXPECT_GT(count[Verdict::contact_at_start], 80);
    EXPECT_GT(inside, 5);
}

/// Every line is needed: the head, orders, rays, planes, and the witness. (A division and one of its planes may go
/// together, if the other plane keeps both parts apart.)
TEST_F(Certificates, WithoutOneOfTheirLinesAreRefused) {
    int tried = 0;
    for (int round = 0; round < 60; ++round) {
        const FirstContactQuery query = random_query();
        const std::string text = certify(query).text;
        std::vector<std::size_t> begins{0};
        while (begins.back() < text.size())
            begins.push_back(text.find('\n', begins.back()) + 1);
        const std::size_t step = 1 + begins.size() / 20;
        for (std::size_t i = round % step; i + 1 < begins.size(); i += step) {
            if (std::string("TAB").find(text[begins[i]]) != std::string::npos)
                continue;
            ++tried;
            const std::string without = text.substr(0, begins[i]) + text.substr(begins[i + 1]);
            EXPECT_FALSE(checked(query.moving, query.fixed, without).holds) << text.substr(begins[i], 20) << " of\n"
                                                                            << text;
        }
    }
    EXPECT_GT(tried, 500);
}

TEST_F(Certificates, WrongClaimsAreRefused) {
    const Polyhedron cube = box({0.5, 0.5, 0.5}).polyhedron();
    const Pose start = shifted(3, 0, 0), near = shifted(1.25, 0, 0), through = shifted(0.2, 0.1, 0);
    const auto text_of = [&](const Pose& goal, double margin) {
        FirstContactQuery query{cube, cube, ScrewMotion::between(start, goal)};
        query.options.margin = margin;
        return certify(query).text;
    };
    const auto holds = [&](const std::string& text) { return checked(cube, cube, text).holds; };
    const auto with = [](std::string text, const std::string& from, const std::string& to) {
        EXPECT_NE(text.find(from), std::string::npos) << from;
        return text.replace(text.find(from), from.size(), to);
    };
    const std::string clear = text_of(near, 0.125), contact = text_of(through, 0);
    ASSERT_EQ(checked(cube, cube, clear).message.substr(0, 15), "verified: clear") << clear;
    ASSERT_TRUE(holds(contact));
    EXPECT_FALSE(holds(with(clear, "margin 0x1p-3", "margin 0x1p-2"))); // the gap is 0.25
    EXPECT_TRUE(holds(with(clear, "margin 0x1p-3", "margin 0x0p+0")));  // a weaker claim
    EXPECT_FALSE(holds(
        with(contact,
             contact.substr(contact.find("verdict contact"), contact.find("order") - contact.find("verdict contact")),
             "verdict clear\n")));
    EXPECT_FALSE(holds(with(clear, "solid both", "solid moving")));
    EXPECT_FALSE(checked(cube, box({0.5, 0.5, 0.5000001}).polyhedron(), clear).holds);
    EXPECT_FALSE(is_about(clear, ScrewMotion::between(start, through)));
}

/// A cube slides over another one, and reaches its rim.
TEST_F(Certificates, OfFacesInOnePlaneAreVerified) {
    const Polyhedron cube = box({0.5, 0.5, 0.5}).polyhedron();
    for (const double gap : {0.0, 0x1p-50, 0x1p-20}) {
        const FirstContactQuery query{cube, cube,
                                      ScrewMotion::between(shifted(-2, 0.25, 1 + gap), shifted(2, 0.25, 1 + gap))};
        const Certificate proof = certify(query);
        EXPECT_EQ(proof.missing, "");
        EXPECT_NE(proof.text.find(gap > 0 ? "verdict clear" : "verdict contact"), std::string::npos);
        EXPECT_EQ(checked(cube, cube, proof.text).message.substr(0, 9), "verified:")
            << checked(cube, cube, proof.text).message << proof.text;
    }
}

/// A face that is not convex is no witness.
TEST_F(Certificates, SayWhatIsMissing) {
    Body corner{{{0, 0, 0}, {4, 0, 0}, {4, 1, 0}, {1, 1, 0}, {1, 4, 0}, {0, 4, 0}}, {{0, 1, 2, 3, 4, 5}}};
    const Polyhedron plate = corner.polyhedron(), tip = triangle({0, 0, 0}, {0.1, 0, 1}, {0, 0.1, 1}).polyhedron();
    const Certificate proof = certify({tip, plate, ScrewMotion::between(shifted(2, 0.5, 1), shifted(2, 0.5, -0.5))});
    EXPECT_EQ(proof.missing, "not proven: the contact: no edge was found that passes through a convex face");
    EXPECT_FALSE(checked(tip, plate, proof.text).holds);
}

/// An answer that a limit has cut is none.
TEST_F(Certificates, NeedAnAnswerInTime) {
    Body sheet;
    constexpr std::uint32_t n = 100;
    for (std::uint32_t i = 0; i <= n; ++i)
        for (std::uint32_t j = 0; j <= n; ++j)
            sheet.vertices.emplace_back(double(i) / n, double(j) / n, 0);
    for (const auto& face : grid_triangles(n, n))
        sheet.faces.emplace_back(face.begin(), face.end());
    const Polyhedron body = sheet.polyhedron();
    const Pose goal(Eigen::Vector3d(0.4, 0.1, 1e-9), Eigen::Quaterniond(0.92, 0, 0, 0.39));
    const FirstContactQuery query{body, body, ScrewMotion::between(shifted(0, 0.1, 1e-9), goal)};
    const Limit limit(1e-9);
    ASSERT_EQ(first_contact(query).verdict, Verdict::unknown);
    EXPECT_THROW(static_cast<void>(certify(query)), Cancelled);
}

TEST_F(Certificates, RefuseWhatTheyCannotSay) {
    const Polyhedron cube = box({0.5, 0.5, 0.5}).polyhedron();
    const Pose start = shifted(3, 0, 0), goal = shifted(2, 0, 0);
    const auto why = [](const FirstContactQuery& query) { return refusal([&] { static_cast<void>(certify(query)); }); };
    EXPECT_EQ(why({cube, cube, Motion::hinge({0, 0, 0}, {0, 0, 1}, {0, 0, 1})}),
              "certificate: the motion is none of those that are certified: screws, sweeps, and products of poses, "
              "velocities, twists, hinges and sliders that move evenly between the same times");
    const Pose half_turned(goal.translation, Eigen::Quaterniond(0, 1, 0, 0));
    EXPECT_EQ(why({cube, cube, SweepMotion::between(start, half_turned)}), "certificate: the sweep is a half turn");
    EXPECT_EQ(why({cube, cube, ConstantVelocity::between(start, half_turned)}),
              "certificate: piece 0 is a half turn, which has no shorter way round");
    EXPECT_NE(why({cube.with_radius(-0.1), cube, ScrewMotion::between(start, goal)}).find("moved inwards"),
              std::string::npos);
    QueryOptions hold;
    hold.margin = 1;
    hold.hold = 0.5;
    EXPECT_EQ(why({cube, cube, ScrewMotion::between(start, goal), hold}),
              "certificate: answers with `hold` are not certified");
}

TEST(MeshesOfTheChecker, AreReadAsEditorsWriteThem) {
    const std::string plain = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
    const auto read = [](const std::string& text) {
        const std::filesystem::path file = own_file("mesh.obj");
        std::ofstream(file, std::ios::binary) << text;
        ::certificate::Mesh mesh = ::certificate::read_mesh(file.string());
        std::filesystem::remove(file);
        return mesh;
    };
    std::string returns = plain, windows;
    std::ranges::replace(returns, '\n', '\r');
    for (const char c : plain)
        windows += c == '\n' ? "\r\n" : std::string(1, c);
    const ::certificate::Mesh expected = read(plain);
    EXPECT_EQ(expected.size(), 1);
    EXPECT_EQ(read(returns), expected);
    EXPECT_EQ(read(windows), expected);
    EXPECT_EQ(read("\xEF\xBB\xBF" + plain), expected); // a mark of the byte order
    EXPECT_EQ(read("v 0 0 0\nv 1 0 0\nv 0 1 0\nf +1 +2 +3\n"), expected);
}

TEST(Checker, TakesNumbersAndBytesOfThePageOnly) {
    const Polyhedron cube = box({0.5, 0.5, 0.5}).polyhedron();
    const Certificate proof = certify(FirstContactQuery{cube, cube, Motion::twist(shifted(3, 0, 0), shifted(2, 0, 0))});
    const auto with = [&](const std::string& from, const std::string& to) {
        std::string text = proof.text;
        return text.replace(text.find(from), from.size(), to);
    };
    EXPECT_TRUE(checked(cube, cube, proof.text).holds);
    EXPECT_TRUE(checked(cube, cube, with("\nsolid", "\t# a comment\r\nsolid")).holds);
    for (const std::string& text :
         {with("\nsolid", " # \xC3\xBC\nsolid"), with("\nsolid", "\v\nsolid"), with("proof 0", "proof 00"),
          with("motion sweep 1", "motion sweep 01"), with("0x1p", "0x" + std::string(40, '0') + "1p")})
        EXPECT_FALSE(checked(cube, cube, text).holds) << text;
}

} // namespace
} // namespace chasles::test
