"""Runs one of the checks on a small project made for the purpose."""
import pathlib
import subprocess
import sys
import tempfile


def run_check(name, files):
    """Exit status and output of tests/<name> on a project of these files (path -> text)."""
    with tempfile.TemporaryDirectory() as root:
        for path, text in files.items():
            file = pathlib.Path(root, path)
            file.parent.mkdir(parents=True, exist_ok=True)
            file.write_text(text + "\n", encoding="utf-8")
        check = pathlib.Path(__file__).with_name(name)
        done = subprocess.run([sys.executable, check, root], capture_output=True, text=True)
        return done.returncode, done.stdout.strip()
