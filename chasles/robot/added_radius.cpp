#include "chasles/robot/added_radius.h"

#include "chasles/algebra/double_double.h"
#include "chasles/base/invalid_input.h"
#include "chasles/base/number_text.h"

#include <cmath>
#include <limits>

namespace chasles {

double added_radius(double of_shape, double added) {
    const auto sum = algebra::DoubleDouble(of_shape) + added;
    const bool is_rounded_down = sum.low() > 0;
    const double radius =
        is_rounded_down ? std::nextafter(sum.high(), std::numeric_limits<double>::infinity()) : sum.high();
    if (of_shape > 0 && !(radius > 0))
        throw InvalidInput("radius: that of the shape, " + number_text(of_shape) + ", and the added one, " +
                           number_text(added) + ", must be above 0 together");
    return radius;
}

Polyhedron with_added_radius(const Polyhedron& shape, double added) {
    return added == 0 ? shape : shape.with_radius(added_radius(shape.radius(), added));
}

} // namespace chasles
