#!/usr/bin/env python3
"""check_words.py must name replaced words in code and in prose, and pass plain English."""
import unittest

from check_project import run_check


def check(name, text):
    """Exit status and output of the check on a project of one file."""
    return run_check("check_words.py", {name: text})


class CheckWords(unittest.TestCase):
    def test_names_an_identifier(self):
        self.assertEqual(check("radiosity/rows/Row.h", "int lampCount = 0;"),
                         (1, "radiosity/rows/Row.h:1: lampCount: write light (in the scene), emitter (in the solver)"))

    def test_names_a_comment_also_over_two_lines(self):
        self.assertEqual(check("radiosity/rows/Row.h", "int a = 0;\n/// All open\n/// work.\nint b = 0;"),
                         (1, "radiosity/rows/Row.h:2: open work: write dirty set, dirty blocks"))

    def test_names_a_string(self):
        self.assertEqual(check("tools/Help.cpp", 'say("An order of work");')[0], 1)
        self.assertEqual(check("tools/Help.cpp", 'say("5 lamps");')[0], 1)

    def test_names_an_identifier_of_a_shader(self):
        self.assertEqual(check("viewer/gl/Shaders.cpp", 'auto s = R"(\nuniform int lampCount;\n)";'),
                         (1, "viewer/gl/Shaders.cpp:2: lampCount: write light (in the scene), emitter (in the solver)"))

    def test_names_a_document(self):
        self.assertEqual(check("docs/radiosity.md", "What is put\noff comes last."),
                         (1, "docs/radiosity.md:1: put off: write deferred"))

    def test_passes_paths_plain_english_and_desk_lamps(self):
        for name, text in [("tests/laws/SomeTest.cpp", 'light("/lamp/light", "lamp.usda"); // at /World/lamp/light'),
                           ("viewer/app/View.h", "// Who looks at a thing that stands open does the work."),
                           ("scenes/README.md", "The desk lamp is turned."),
                           ("docs/architecture.md", "# A\n\n## Words\n\n| open work |\n\n## Rooms\n")]:
            self.assertEqual(check(name, text)[0], 0, name)

    def test_finds_old_words_behind_the_table_of_terms(self):
        self.assertEqual(check("docs/architecture.md", "# A\n\n## Words\n\n| x |\n\n## Rooms\n\nopen work\n"),
                         (1, "docs/architecture.md:9: open work: write dirty set, dirty blocks"))


if __name__ == "__main__":
    unittest.main()
