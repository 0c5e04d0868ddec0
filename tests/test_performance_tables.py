#!/usr/bin/env python3
"""scripts/performance_tables must write tables that its check takes, and refuse what was changed by hand."""
import json
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import unittest

PROJECT = pathlib.Path(__file__).resolve().parent.parent
SCRIPT = PROJECT / "scripts" / "performance_tables"


class PerformanceTables(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)
        self.root = pathlib.Path(self.folder.name)
        (self.root / "docs").mkdir()
        for name in ("performance.md", "performance.json"):
            shutil.copy(PROJECT / "docs" / name, self.root / "docs")
        self.document = self.root / "docs" / "performance.md"

    def run_script(self, *arguments):
        """Exit status and what it said."""
        done = subprocess.run([sys.executable, SCRIPT, "--root", self.root, *arguments], capture_output=True, text=True)
        return done.returncode, done.stderr.strip()

    def change(self, pattern, by):
        before = self.document.read_text(encoding="utf-8")
        after = re.sub(pattern, by, before, count=1, flags=re.S)
        self.assertNotEqual(before, after)
        self.document.write_text(after, encoding="utf-8")

    def result(self, name, **figures):
        """A file of a benchmark with one case."""
        path = self.root / "result.json"
        case = {"name": name, "day": "2001-02-03", "machine": "an abacus", "load": 7, **figures}
        path.write_text(json.dumps({"benchmarks": [case]}), encoding="utf-8")
        return path

    def test_a_figure_changed_by_hand_is_found_and_mended(self):
        self.change(r"(\| oracle \| )[^|]*", r"\g<1>0.001 ")
        status, text = self.run_script("--check")
        self.assertEqual(status, 1)
        self.assertIn("not those of docs/performance.json", text)
        self.assertEqual(self.run_script(), (0, ""))
        self.assertEqual(self.run_script("--check"), (0, ""))

    def test_a_new_figure_takes_the_place_of_the_old_one(self):
        path = self.result("policy/office/oracle", edits=9, area=0.5, work90=0.25, work=2)
        self.assertEqual(self.run_script(path), (0, ""))
        text = self.document.read_text(encoding="utf-8")
        self.assertIn("| oracle | 9 | 0.5 | 0.25 | 2 |", text)
        self.assertIn("an abacus", text)
        self.assertEqual(self.run_script("--check"), (0, ""))

    def test_cases_are_found_by_the_names_that_google_benchmark_gives_them(self):
        path = self.result("edit/building/16/iterations:1/manual_time", update_rays=123.0)
        self.assertEqual(self.run_script(path), (0, ""))
        self.assertIn("| in 16 offices |  |  | 123 |", self.document.read_text(encoding="utf-8"))

    def test_a_table_that_is_missing_is_named(self):
        self.change(r"<!-- table: policies -->.*?<!-- end -->\n", "")
        status, text = self.run_script("--check")
        self.assertEqual(status, 1)
        self.assertIn("policies", text)

    def test_a_document_that_grows_is_refused(self):
        self.change(r"\Z", "what was tried last year\n" * 50)
        status, text = self.run_script("--check")
        self.assertEqual(status, 1)
        self.assertIn("history belongs to git", text)

    def test_a_figure_without_day_and_machine_is_refused(self):
        path = self.root / "result.json"
        path.write_text(json.dumps({"benchmarks": [{"name": "policy/office/oracle", "area": 1}]}), encoding="utf-8")
        status, text = self.run_script(path)
        self.assertEqual(status, 1)
        self.assertIn("policy/office/oracle", text)

    def test_a_file_that_no_benchmark_wrote_is_named(self):
        path = self.root / "other.json"
        path.write_text("{}", encoding="utf-8")
        status, text = self.run_script(path)
        self.assertEqual(status, 1)
        self.assertIn("other.json", text)


if __name__ == "__main__":
    unittest.main()
