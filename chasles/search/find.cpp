#include "chasles/search/find.h"

namespace chasles {

Work& Work::operator+=(const Work& other) {
    node_pairs += other.node_pairs;
    face_pairs += other.face_pairs;
    elementary_tests += other.elementary_tests;
    root_brackets += other.root_brackets;
    refined += other.refined;
    exact += other.exact;
    return *this;
}

} // namespace chasles
