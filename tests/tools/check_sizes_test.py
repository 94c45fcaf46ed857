#!/usr/bin/env python3
"""The size check finds every kind of function, and each of its limits can be broken."""

import unittest

from small_tree import SmallTree

import check_sizes  # in the folder that small_tree adds

SOUND = {"chasles/mesh/box.h": "// A box.\nstruct Box {\n    int sides() const { return 6; } // always\n};\n"}

# Every function is named for how many lines it has and how many parameters.
KINDS = """
namespace chasles {
namespace {

template <typename T, int n>
T lines_3_of_2(const std::map<T, T>& map, int (*call)(int, int)) {
    return T{}; // a brace } in a comment, "{" in a text
}

constexpr double number = maximum(1, 2);
const std::function<void(int)> none = {};
std::vector<int> list{1, 2};

} // namespace

class [[nodiscard]] EXPORT Body : public Base<int> {
public:
    lines_4_of_3(int a, int b = 2, std::span<const int> c = {})
        : a_(a), b_{b} {
        run([&](int x) { return x; });
    }
    bool operator==(const Body& other) const = default;
    Body& operator=(const Body& other) { return *this; }
    [[nodiscard]] auto lines_1_of_0() const noexcept -> std::pair<int, int> { return {a_, '{'}; }

private:
    int a_ = 0;
    std::array<int, 2> b_{};
};

enum class Kind { a, b };

requires(true)
void lines_6_of_1(
    int a) {
    if (a) {
    }
}

} // namespace chasles
"""


class CheckSizes(SmallTree):
    sound = SOUND
    check = check_sizes

    def test_sound_tree_passes(self) -> None:
        self.assertEqual(self.violations_with(), [])

    def test_every_function_is_found(self) -> None:
        found = {function.name: function for function in check_sizes.functions_of("kinds.h", KINDS)}
        self.assertEqual(
            {name: (function.lines, function.parameters) for name, function in found.items()},
            {"lines_3_of_2": (3, 2), "lines_4_of_3": (4, 3), "operator=": (1, 1), "lines_1_of_0": (1, 0), "lines_6_of_1": (6, 1)},
        )
        self.assertEqual(found["lines_3_of_2"].line, 6)

    def test_long_function_is_found(self) -> None:
        self.assertEqual(self.violations_with(**{"chasles/mesh/a.cpp": function_of(50)}), [])
        self.assert_violation("chasles/mesh/a.cpp", function_of(51), "run has 51 lines")

    def test_many_parameters_are_found(self) -> None:
        text = "// Runs.\nvoid run(int a, int b, int c, int d, int e, int f) {}\n"
        self.assertEqual(self.violations_with(**{"chasles/mesh/a.cpp": text}), [])
        self.assert_violation("chasles/mesh/a.cpp", text.replace(")", ", int g)"), "run has 7 parameters")

    def test_long_file_is_found(self) -> None:
        self.assert_violation("chasles/mesh/a.cpp", "int number; // of it\n" * 351, "351 lines")


def function_of(lines: int) -> str:
    """After a comment, and after enough short functions for it to be a rare one."""
    short = "".join(f"void short_{i}() {{}} // {i}\n" for i in range(40))
    return short + "void run() {\n" + "    step(); // once\n" * (lines - 2) + "}\n"


if __name__ == "__main__":
    unittest.main()
