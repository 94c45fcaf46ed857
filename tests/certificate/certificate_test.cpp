// The checker, which shares nothing with the library, verifies what the library certifies, and refuses what is altered.
#include "chasles/certificate/certificate.h"

#include "chasles/base/sha256.h"
#include "chasles/mesh/primitives.h"
#include "tests/query/bodies.h"
#include "tests/support/random_poses.h"
#include "tests/support/refusal.h"
#include "tools/verify.h"

#include <gtest/gtest.h>

#include <map>
#include <sstream>

namespace chasles::test {
namespace {

::certificate::Mesh mesh_of(const Polyhedron& body) {
    ::certificate::Mesh mesh;
    for (std::size_t face = 0; face < body.face_count(); ++face) {
        mesh.emplace_back();
        for (const std::uint32_t vertex : body.face(face)) {
            const Eigen::Vector3d& corner = body.vertices()[vertex];
            mesh.back().push_back({corner.x(), corner.y(), corner.z()});
        }
    }
    return mesh;
}

::certificate::Verified checked(const Polyhedron& moving, const Polyhedron& fixed, const std::string& text) {
    std::istringstream stream(text);
    return ::certificate::verify(mesh_of(moving), mesh_of(fixed), stream);
}

std::string word_of(Verdict verdict) {
    return verdict == Verdict::clear     ? "verdict clear\n"
           : verdict == Verdict::contact ? "verdict contact "
                                         : "verdict start\n";
}

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
    [[nodiscard]] Polyhedron random_body() {
        const double radius = random_.chance(0.3) ? random_.uniform(0, 0.3) : 0;
        PolyhedronOptions options;
        options.radius = radius;
        options.solid = random_.chance(0.3) ? Solid::no : Solid::automatic;
        const Body body = random_.chance(0.5)
                              ? random_octahedron(shapes_)
                              : box({random_.uniform(0.1, 1), random_.uniform(0.1, 1), random_.uniform(0.1, 1)});
        return Polyhedron::from_polygons(body.vertices, body.faces, options);
    }
    [[nodiscard]] FirstContactQuery random_query() {
        const Pose start = random_pose(random_, 2);
        const Pose goal = random_goal(random_, start, random_.uniform(0, 3), 2);
        FirstContactQuery query{random_body(), random_body(), ScrewMotion::between(start, goal)};
        query.options.margin = random_.chance(0.3) ? random_.uniform(0, 0.3) : 0;
        return query;
    }

    Random random_{4747};
    std::mt19937 shapes_{4747};
};

TEST_F(Certificates, OfRandomQuestionsAreVerified) {
    std::map<Verdict, int> count;
    int inside = 0;
    for (int round = 0; round < 600; ++round) {
        const FirstContactQuery query = random_query();
        const FirstContact found = first_contact(query);
        const Certificate proof = certify(query);
        ASSERT_EQ(proof.missing, "") << round;
        EXPECT_NE(proof.text.find(word_of(found.verdict)), std::string::npos) << round;
        const ::certificate::Verified verified = checked(query.moving, query.fixed, proof.text);
        ASSERT_TRUE(verified.holds) << round << ": " << verified.message << "\n" << proof.text;
        EXPECT_TRUE(is_about(proof.text, query.motion));
        ++count[found.verdict];
        inside += proof.text.find("witness inside") != std::string::npos;
    }
    EXPECT_GT(count[Verdict::clear], 100);
    EXPECT_GT(count[Verdict::contact], 100);
    EXPECT_GT(count[Verdict::contact_at_start], 100);
    EXPECT_GT(inside, 5);
}

/// One digit of a number changes, a line goes, or two lines change places: nothing that proves less is accepted. What
/// is accepted claims the same, by another plane or another order.
TEST_F(Certificates, ThatAreAlteredProveNothingElse) {
    int refused = 0, tried = 0;
    for (int round = 0; round < 60; ++round) {
        const FirstContactQuery query = random_query();
        const std::string text = certify(query).text;
        const std::string head = text.substr(0, text.find("order "));
        for (int change = 0; change < 20; ++change) {
            std::string altered = text;
            const std::size_t at = std::size_t(random_.uniform(0, double(text.size()))) % text.size();
            altered[at] = "0123456789abcdefPTAB?- \n"[std::size_t(random_.uniform(0, 24)) % 24];
            const ::certificate::Verified verified = checked(query.moving, query.fixed, altered);
            ++tried;
            refused += !verified.holds;
            if (verified.holds && altered.substr(0, head.size()) != head)
                EXPECT_EQ(checked(query.moving, query.fixed, text).message, verified.message) << altered;
        }
    }
    EXPECT_GT(refused, tried / 2);
}

TEST_F(Certificates, WrongClaimsAreRefused) {
    const Polyhedron cube = box({0.5, 0.5, 0.5}).polyhedron();
    const Pose start(Eigen::Vector3d(3, 0, 0)), near(Eigen::Vector3d(1.25, 0, 0)), through(Eigen::Vector3d(0.2, 0.1, 0));
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
    ASSERT_TRUE(holds(clear));
    ASSERT_TRUE(holds(contact));
    EXPECT_FALSE(holds(with(clear, "margin 0x1p-3", "margin 0x1p-2"))); // the gap is 0.25
    EXPECT_TRUE(holds(with(clear, "margin 0x1p-3", "margin 0x0p+0")));  // a weaker claim
    EXPECT_FALSE(holds(with(contact, contact.substr(contact.find("verdict contact"), contact.find("order") - contact.find("verdict contact")), "verdict clear\n")));
    EXPECT_FALSE(holds(with(clear, "solid both", "solid moving")));
    EXPECT_FALSE(checked(cube, box({0.5, 0.5, 0.5000001}).polyhedron(), clear).holds);
    EXPECT_FALSE(is_about(clear, ScrewMotion::between(start, through)));
}

TEST_F(Certificates, OfWhatOnlyTouchesSayWhatIsMissing) {
    const Polyhedron cube = box({0.5, 0.5, 0.5}).polyhedron();
    const Certificate graze =
        certify({cube, cube, ScrewMotion::between(Pose(Eigen::Vector3d(-2, 0, 1)), Pose(Eigen::Vector3d(2, 0, 1)))});
    EXPECT_NE(graze.missing.find("not proven"), std::string::npos);
    EXPECT_FALSE(checked(cube, cube, graze.text).holds);
}

TEST_F(Certificates, RefuseWhatTheyCannotSay) {
    const Polyhedron cube = box({0.5, 0.5, 0.5}).polyhedron();
    const Pose start(Eigen::Vector3d(3, 0, 0)), goal(Eigen::Vector3d(2, 0, 0));
    const auto why = [](const FirstContactQuery& query) {
        return refusal([&] { static_cast<void>(certify(query)); });
    };
    EXPECT_EQ(why({cube, cube, SweepMotion::between(start, goal)}),
              "certificate: only the motions that are the paper's screw are certified so far");
    EXPECT_EQ(why({cube, cube, ScrewMotion::relative(start, goal, start, goal)}),
              "certificate: the fixed body moves, too; only motions against a body at rest are certified so far");
    EXPECT_NE(why({cube.with_radius(-0.1), cube, ScrewMotion::between(start, goal)}).find("moved inwards"), std::string::npos);
    QueryOptions hold;
    hold.margin = 1;
    hold.hold = 0.5;
    EXPECT_EQ(why({cube, cube, ScrewMotion::between(start, goal), hold}), "certificate: answers with `hold` are not certified");
}

} // namespace
} // namespace chasles::test
