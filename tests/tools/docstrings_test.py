#!/usr/bin/env python3
"""The texts that tools/docstrings.py finds in a header, and the lines that it ignores."""

import pathlib
import sys
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).parents[2] / "tools"))
import docstrings  # noqa: E402

HEADER = """
/// A body.
///
/// It has faces; see Other::name().
class CHASLES_EXPORT Body {
public:
    /// Makes it. Throws InvalidInput
    /// for none.
    static Body make(std::span<const int> faces, const Options& options = {});

    [[nodiscard]] int undocumented() const;
    [[nodiscard]] double size() const; ///< in metres
    /// Rows:
    ///
    ///     1 0
    Rows rows() const;

private:
    int count_ = 0;
};

struct [[nodiscard]] LIBRARY_EXPORT Answer {
    double time = 0; ///< first line
                     ///< and second
    std::optional<double> hold = {}; ///< perhaps
    Bracket tau;
};

enum class Verdict : std::uint8_t {
    clear,   ///< nothing
    contact, ///< something
};

/// On one line.
enum class Kind { a, b };

/// Free.
/// And
CHASLES_EXPORT Answer ask(const Question& question);
"""

EXPECTED = {
    "Body": "A body.\n\nIt has faces; see Other.name().",
    "Body.make": "Makes it. Throws InvalidInput for none.",
    "Body.size": "in metres",
    "Body.rows": "Rows:\n\n    1 0",
    "Answer.time": "first line and second",
    "Answer.hold": "perhaps",
    "Verdict.clear": "nothing",
    "Verdict.contact": "something",
    "Kind": "On one line.",
    "ask": "Free. And",
}


class Docstrings(unittest.TestCase):
    def test_every_comment_goes_to_the_name_that_it_is_about(self) -> None:
        self.assertEqual(docstrings.docstrings([HEADER]), EXPECTED)

    def test_of_two_headers_the_first_counts(self) -> None:
        found = docstrings.docstrings(["/// One.\nint f();\n", "/// Two.\nint f(int);\n"])
        self.assertEqual(found, {"f": "One."})

    def test_long_paragraphs_are_laid_out_anew(self) -> None:
        (text,) = docstrings.docstrings(["/// " + "word " * 40 + "\nint f();\n"]).values()
        self.assertLessEqual(max(map(len, text.splitlines())), docstrings.WIDTH)


if __name__ == "__main__":
    unittest.main()
