// The examples of RFC 4648, and all byte values.
#include "view/base64.h"

#include "tests/view/packed.h"

#include <gtest/gtest.h>

namespace chasles {
namespace {

std::string packed(const std::string& bytes) {
    return view::base64(std::as_bytes(std::span(bytes)));
}

TEST(Base64, IsThatOfTheStandard) {
    EXPECT_EQ(packed(""), "");
    EXPECT_EQ(packed("f"), "Zg==");
    EXPECT_EQ(packed("fo"), "Zm8=");
    EXPECT_EQ(packed("foo"), "Zm9v");
    EXPECT_EQ(packed("foob"), "Zm9vYg==");
    EXPECT_EQ(packed("fooba"), "Zm9vYmE=");
    EXPECT_EQ(packed("foobar"), "Zm9vYmFy");
}

TEST(Base64, KeepsEveryByte) {
    std::string bytes;
    for (int i = 0; i < 256; ++i)
        bytes += static_cast<char>(i);
    EXPECT_EQ(tests::unpacked_bytes(packed(bytes)), bytes);
}

} // namespace
} // namespace chasles
