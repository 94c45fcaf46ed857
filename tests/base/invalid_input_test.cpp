// Messages of errors.
#include "chasles/base/invalid_input.h"

#include <gtest/gtest.h>

namespace chasles {
namespace {

TEST(InvalidInput, ACharacterWithTheCodeZeroDoesNotCutTheMessage) {
    EXPECT_STREQ(InvalidInput(std::string("scene: a\0b: is missing", 22)).what(), "scene: a?b: is missing");
    EXPECT_STREQ(InvalidInput("scene: ab").what(), "scene: ab");
}

} // namespace
} // namespace chasles
