# SPDX-License-Identifier: BSD-3-Clause
"""check_sizes_test.py: what check_sizes.py measures, on sources made up here."""
import unittest

import check_sizes

SOURCE = check_sizes.LICENCE + '''
namespace a {
struct Point {
  // } a brace in a comment, and in a string: {
  Point(int x, std::map<int, int> y) : text("}{") {
    Use(x, {x, x}, R"(
}
)");
  }
};

std::vector<std::pair<int, int>>
Class::Long(int a, const std::function<void(int, int)>& b,
            const Options& c = {}) const {
  for (int i = 0; i < a; ++i) {
    const auto sum = [&](int x, int y) {
      return x + y;
    };
  }
#if 0
#endif
}

const std::vector<int> kTable = {
    1, 2,
};
bool operator<(const Point& a, const Point& b) {
  return a.x < b.x;
}
void None() {
  f(1, 2);
}
}  // namespace a
'''


class Sizes(unittest.TestCase):
    def test_blocks(self):
        found = {header.split("(")[0].split()[-1]: (line, length, check_sizes.parameters_of(header))
                 for line, length, header in check_sizes.blocks(SOURCE) if not header.startswith("for")}
        self.assertEqual(found, {"Point": (5, 5, 2), "Class::Long": (13, 10, 3), "[&]": (16, 3, 2),
                                 "operator<": (27, 3, 2), "None": (30, 3, 0)})

    def test_what_is_too_long(self):
        def breaches(text):
            return list(check_sizes.breaches_in("x.cc", check_sizes.LICENCE + "\n" + text))

        def body(lines):
            return "void F(int a) {\n" + "  g();\n" * (lines - 2) + "}\n"
        self.assertEqual(breaches(body(60)), [])
        self.assertEqual(breaches(body(61)), ["x.cc:2: a function of 61 lines, more than 60"])
        self.assertEqual(breaches("void F(A a, B b, C c, D d, E e, F f, G g) {\n}\n"),
                         ["x.cc:2: 7 parameters, more than 6"])
        self.assertEqual(breaches("int a;\n" * 349), [])
        self.assertEqual(breaches("int a;\n" * 350), ["x.cc: 351 lines, more than 350"])
        self.assertEqual(len(list(check_sizes.breaches_in("x.cc", "int a;\n"))), 1, "no licence")


if __name__ == "__main__":
    unittest.main()
