#!/usr/bin/env python3
"""check_docs.py must pass what is there and name what is not."""
import unittest

from check_project import run_check

SOURCES = {"io/Camera.h": "class Camera {\n    void frame();\n    int sumBlock;\n};", "tests/CameraTest.cpp": "TEST(Frames, Once)",
           "io/Other.h": "void zoom();"}


def check(line, document="README.md"):
    """Exit status and output of the check on a project with one line of text."""
    return run_check("check_docs.py", {**SOURCES, document: line})


class CheckDocs(unittest.TestCase):
    def test_passes_what_exists(self):
        for line in ("[a](io/Camera.h)", "`io/Camera.h`", "`Camera.h: Camera::frame`", "`frame()`", "`Camera::frame()`",
                     "`Camera::sumBlock`", "`CameraTest`", "`other words`"):
            self.assertEqual(check(line)[0], 0, line)

    def fails_with(self, text, line):
        self.assertEqual(check(line), (1, f"README.md:1: {text}"))

    def test_names_what_does_not(self):
        self.fails_with("there is no io/Gone.h", "[a](io/Gone.h)")
        self.fails_with("there is no io/Gone.h", "`io/Gone.h`")
        self.fails_with("there is no turn", "`turn()`")
        self.fails_with("there is no TurnTest", "`TurnTest`")

    def test_a_part_of_a_name_is_not_the_name(self):
        self.fails_with("Camera.h does not mention sum", "`Camera.h: sum`")

    def test_a_member_of_another_class_is_not_there(self):
        self.fails_with("there is no Camera::zoom", "`Camera::zoom()`")

    def test_the_changelog_may_tell_of_what_is_gone(self):
        self.assertEqual(check("`Camera::turn()` has become `Camera::frame()`", "CHANGELOG.md")[0], 0)


if __name__ == "__main__":
    unittest.main()
