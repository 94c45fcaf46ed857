// Reads poses and points from text. chasles/motion/pose.h checks the numbers of a pose.
// Every message quotes the invalid word.
#include "chasles/io/pose_text.h"

#include "chasles/base/invalid_input.h"
#include "chasles/io/text_scan.h"

#include <cmath>
#include <string>

namespace chasles::io {
namespace {

// The number in a word, or InvalidInput.
double finite_number(std::string_view word) {
    const auto number = parse_number(word);
    if (!number)
        throw InvalidInput("not a number: " + in_quotes(word));
    if (!std::isfinite(*number))
        throw InvalidInput("not a finite number: " + in_quotes(word));
    return *number;
}

// Appends the numbers of a text without commas.
void add_words(std::string_view text, std::vector<double>& numbers) {
    Words words(text);
    for (std::string_view word = words.next(); !word.empty(); word = words.next())
        numbers.push_back(finite_number(word));
}

// "1 number" or "N numbers".
std::string number_count(std::size_t numbers) {
    return std::to_string(numbers) + (numbers == 1 ? " number" : " numbers");
}

} // namespace

// Each part between two commas must contain a number. A text without commas may be empty.
std::vector<double> parse_numbers(std::string_view text) {
    std::vector<double> numbers;
    while (true) {
        const std::size_t comma = text.find(',');
        const std::size_t before = numbers.size();
        add_words(text.substr(0, comma), numbers);
        if (comma == std::string_view::npos && (before == 0 || numbers.size() > before))
            return numbers;
        if (numbers.size() == before)
            throw InvalidInput("a number is missing before or after a comma");
        text.remove_prefix(comma + 1);
    }
}

// The number of values determines the form of the pose.
Pose pose_from_numbers(std::span<const double> n) {
    if (n.size() == 3)
        return {{n[0], n[1], n[2]}, Eigen::Quaterniond::Identity()};
    if (n.size() == 7)
        return {{n[0], n[1], n[2]}, {n[3], n[4], n[5], n[6]}};
    if (n.size() == 16)
        return Pose::from_matrix(Eigen::Map<const Eigen::Matrix<double, 4, 4, Eigen::RowMajor>>(n.data()));
    throw InvalidInput(number_count(n.size()) +
                       " found; a pose has 3 (x y z), 7 (x y z qw qx qy qz) or 16 (4x4, row by row)");
}

Pose parse_pose(std::string_view text) {
    return pose_from_numbers(parse_numbers(text));
}

Eigen::Vector3d parse_point(std::string_view text) {
    const std::vector<double> n = parse_numbers(text);
    if (n.size() != 3)
        throw InvalidInput(number_count(n.size()) + " found; a point has 3 (x y z)");
    return {n[0], n[1], n[2]};
}

} // namespace chasles::io
