// Simulates a build without the viewer: this program is linked to the source that a build without the viewer uses.
#include "view/page.h"

#include <gtest/gtest.h>

namespace chasles {
namespace {

TEST(NoViewer, SaysWhatIsMissing) {
    try {
        view::require_page_template();
        FAIL() << "there is a template";
    } catch (const InvalidInput& error) {
        EXPECT_STREQ(error.what(), "view: this build has no viewer: there was no network");
    }
}

} // namespace
} // namespace chasles
