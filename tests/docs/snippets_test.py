# SPDX-License-Identifier: BSD-3-Clause
"""Snippets of the examples are copied into the documents, and nothing goes wrong in silence."""
import os
import sys
import unittest

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), '../../scripts'))
from snippets_to_docs import snippet_of, with_snippets  # noqa: E402

SOURCE = '''int main() {
  // snippet: loop
  for (;;) {
    Run();
  }

  Other();
  // snippet: last
  End();
}
// snippet: none

'''


class Snippets(unittest.TestCase):
    def test_a_snippet_ends_at_an_empty_line_or_a_smaller_indent(self):
        self.assertEqual(snippet_of(SOURCE, 'loop'), 'for (;;) {\n  Run();\n}\n')
        self.assertEqual(snippet_of(SOURCE, 'last'), 'End();\n')

    def test_what_is_missing_is_an_error(self):
        for name in ('none', 'unknown'):
            with self.assertRaises(ValueError):
                snippet_of(SOURCE, name)
        with self.assertRaises(ValueError):
            snippet_of(SOURCE + SOURCE, 'loop')

    def test_a_page_gets_the_snippet(self):
        page = 'a\n<!-- example x.cc last -->\nold\n<!-- /example -->\nb\n'
        new = with_snippets(page, lambda path: SOURCE)
        self.assertEqual(new, 'a\n<!-- example x.cc last -->\n```cpp\n// x.cc\nEnd();\n```\n'
                         '<!-- /example -->\nb\n')
        self.assertEqual(with_snippets(new, lambda path: SOURCE), new)

    def test_marks_without_end_and_other_code_are_errors(self):
        for page in ('<!-- example x.cc last -->\n', 'a\n```cpp\nEnd();\n```\n'):
            with self.assertRaises(ValueError):
                with_snippets(page, lambda path: SOURCE)


if __name__ == '__main__':
    unittest.main()
