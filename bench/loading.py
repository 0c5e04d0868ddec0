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


def case(file, readers):
    """One file, as every reader takes it as a layer and as a scene: bytes a second, and peak memory over its size."""
    size = file.stat().st_size
    figures = {**measured.stamp(), "name": f"loading/{file.name}", "file_MB": size / 1e6}
    for reader, command in readers.items():
        for what in ("layer", "scene"):
            one = best([*command, what, file])
            if "error" in one:
                print(f"{file.name}: {reader}, {what}: {one['error']}", flush=True)
                continue
            figures[f"{reader}_{what}_MB_per_s"] = size / 1e6 / one["seconds"]
            figures[f"{reader}_{what}_peak_over_file"] = one["peak_bytes"] / size
            print(f"{file.name}: {reader}, {what}: {one['seconds']:.3f} s, {size / 1e6 / one['seconds']:.0f} MB/s, "
                  f"{one['peak_bytes'] / 1e6:.0f} MB, {one['peak_bytes'] / size:.1f} times the file", flush=True)
    return figures


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("program", type=pathlib.Path)
    parser.add_argument("--out", type=pathlib.Path, default=pathlib.Path("loading.json"))
    parser.add_argument("--tinyusdz", type=pathlib.Path)
    options = parser.parse_args()
    readers = {"penumbra": [options.program]}
    if options.tinyusdz:
        readers["tinyusdz"] = ["node", OTHER, options.tinyusdz.resolve()]
    with tempfile.TemporaryDirectory() as folder:
        subprocess.run([options.program, "write", folder], check=True)
        results = [case(file, readers) for file in sorted(pathlib.Path(folder).iterdir())]
    measured.write(options.out, results)


if __name__ == "__main__":
    main()
