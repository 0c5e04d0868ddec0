#!/usr/bin/env python3
"""How fast large layers and scenes are read, and in how much memory, beside another reader of USD in the same run.

Usage: bench/loading.py PROGRAM [--out FILE.json] [--tinyusdz FOLDER]
PROGRAM is penumbra_loading of a release build, which writes the files: a mesh of a million points and 20,000 spheres, as
text and as crate files. FOLDER is where `npm install tinyusdz` has put that package (node_modules/tinyusdz), which is
WebAssembly and runs in node; without it ours is measured alone."""
import argparse
import json
import pathlib
import subprocess
import tempfile

import measured

OTHER = pathlib.Path(__file__).with_name("loading") / "tinyusdz.mjs"


def read(command):
    """What a process says of its reading: seconds, peak_bytes; or why it failed."""
    done = subprocess.run(command, capture_output=True, text=True, timeout=600)
    last = done.stdout.strip().splitlines()[-1:] or ["{}"]
    try:
        return {"error": done.stderr.strip()[:200]} if done.returncode else json.loads(last[0])
    except json.JSONDecodeError:
        return {"error": last[0][:200]}


def best(command, times=3):
    """The quickest of some runs: what else the machine did is not what is measured."""
    runs = [read(command) for _ in range(times)]
    failed = [run for run in runs if "error" in run]
    return failed[0] if failed else min(runs, key=lambda run: run["seconds"])


def case(reader, file, what, command):
    figures = {**measured.stamp(), **best(command)}
    figures["name"] = f"loading/{reader}/{file.name}/{what}"
    size = file.stat().st_size
    if "error" not in figures:
        figures.update(file_bytes=size, bytes_per_second=size / figures["seconds"],
                       peak_over_file=figures["peak_bytes"] / size)
        print(f"{figures['name']}: {figures['seconds']:.3f} s, {figures['bytes_per_second'] / 1e6:.0f} MB/s, "
              f"{figures['peak_bytes'] / 1e6:.0f} MB, {figures['peak_over_file']:.1f} times the file", flush=True)
    else:
        print(f"{figures['name']}: {figures['error']}", flush=True)
    return figures


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("program", type=pathlib.Path)
    parser.add_argument("--out", type=pathlib.Path, default=pathlib.Path("loading.json"))
    parser.add_argument("--tinyusdz", type=pathlib.Path)
    options = parser.parse_args()
    results = []
    with tempfile.TemporaryDirectory() as folder:
        subprocess.run([options.program, "write", folder], check=True)
        for file in sorted(pathlib.Path(folder).iterdir()):
            for what in ("layer", "scene"):
                results.append(case("penumbra", file, what, [options.program, what, file]))
                if options.tinyusdz:
                    command = ["node", OTHER, options.tinyusdz.resolve(), what, file]
                    results.append(case("tinyusdz", file, what, command))
    measured.write(options.out, results)


if __name__ == "__main__":
    main()
