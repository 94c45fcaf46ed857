// A build without the viewer, pretended: this program is linked to the source that such a build has.
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
