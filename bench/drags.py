#!/usr/bin/env python3
"""Plays drags as the window shows them, and writes what they cost and what can be seen of them as JSON.

Usage: bench/drags.py PROGRAM [--scenes NAMES] [--element-size M] [--out FILE.json]
PROGRAM is penumbra_popping of a release build; bench/popping/ says what it measures. The drags are of a seat in the
office and of a column in the gallery, 1280 x 720, direct light, previewed by rays."""
import argparse
import pathlib
import re
import subprocess

import measured

NUMBER = r"\s*([-+.\d]+)"
# What is found where in the program's report.
FIGURES = [
    ("elements lights", r": (\d+) elements, (\d+) "),
    ("handover handover_most handover_share flicker", r"\|" + NUMBER * 2 + NUMBER + r" % \|" + NUMBER + r" \|"),
    ("exact_frames", r"\|\s+\d+" + NUMBER + r"\s*\n"),
    ("first_frames", r"first frames: 99.9 %" + NUMBER),
    ("drag_kB after_kB", r"card:" + NUMBER + " kB a frame in motion," + NUMBER),
    ("from_scratch_most", r"from scratch: at most" + NUMBER),
]
TIMES = {"idle": "idle", "turning": "turning", "moving": "in motion"}
TIME = ("clock_ms longest_ms cpu_ms", ",".join([NUMBER] * 3))


def figures(report, wanted):
    """By name. Ends the program if the report is not as expected."""
    found = {}
    for names, pattern in wanted:
        match = re.search(pattern, report)
        if not match:
            raise SystemExit(f"drags.py: no '{names}' in what the program printed:\n{report}")
        found.update(zip(names.split(), map(float, match.groups())))
    return found


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program", type=pathlib.Path)
    parser.add_argument("--out", type=pathlib.Path, default=pathlib.Path("penumbra_drags.json"))
    parser.add_argument("--scenes", default="office,gallery")
    parser.add_argument("--element-size", help="of both scenes [m] (default: the scene's)")
    options = parser.parse_args()
    results = []
    for scene in options.scenes.split(","):
        command = [options.program.resolve(), scene, "--rays", "--direct-only", "--variant", "0", "--hd"]
        command += ["--element-size", options.element_size] if options.element_size else []
        stamp = measured.stamp()
        run = subprocess.run(command, stdout=subprocess.PIPE, text=True)
        if run.returncode != 0:
            raise SystemExit(run.returncode)  # the program has said why
        report = run.stdout
        print(report)
        results.append({"name": f"drag/{scene}", **stamp, **figures(report, FIGURES)})
        for name, words in TIMES.items():
            results.append({"name": f"drag/{scene}/{name}", **stamp, **figures(report, [(TIME[0], words + TIME[1])])})
        measured.write(options.out, results)


if __name__ == "__main__":
    main()
