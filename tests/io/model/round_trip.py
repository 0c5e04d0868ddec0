#!/usr/bin/env python3
"""Whether another reader of USD finds in our files what we wrote: imports models and has npm's tinyusdz read the scenes.

Usage: tests/io/model/round_trip.py PENUMBRA TINYUSDZ MODEL ...
PENUMBRA is the program; TINYUSDZ the folder where `npm install tinyusdz` has put that package (it runs in node). Compares the
number of meshes, of triangles, and the box of all points, each in its mesh's own frame. Not part of the tests that CI
runs: node is no dependency of ours."""
import json
import math
import pathlib
import re
import subprocess
import sys
import tempfile

READER = pathlib.Path(__file__).with_name("round_trip.mjs")


def arrays(text, name):
    return re.findall(r"(?m)^\s*[\w\[\]]+ " + name + r" = \[(.*?)\]", text)


def written(text):
    """What the text of a scene holds, without any code of ours."""
    counts = [int(n) for array in arrays(text, "faceVertexCounts") for n in array.split(",") if n.strip()]
    low, high = [math.inf] * 3, [-math.inf] * 3
    for array in arrays(text, "points"):
        for point in re.findall(r"\(([^)]*)\)", array):
            for axis, value in enumerate(map(float, point.split(","))):
                low[axis], high[axis] = min(low[axis], value), max(high[axis], value)
    return {"meshes": len(re.findall(r"(?m)^\s*def Mesh ", text)), "triangles": sum(n - 2 for n in counts),
            "low": low, "high": high}


def close(a, b):
    return all(x == y or (x is not None and y is not None and abs(x - y) <= 1e-5 * max(1, abs(x))) for x, y in zip(a, b))


def compare(penumbra, tinyusdz, model, scene):
    """A line that says how it went, and whether it went well."""
    done = subprocess.run([penumbra, "import", model, "-o", scene], capture_output=True, text=True)
    if done.returncode:
        return f"not imported: {done.stderr.strip().splitlines()[-1]}", True
    ours = written(scene.read_text())
    done = subprocess.run(["node", READER, tinyusdz, scene], capture_output=True, text=True)
    if done.returncode:
        return f"not read: {done.stderr.strip()[:200]}", False
    theirs = json.loads(done.stdout.strip().splitlines()[-1])
    same = ours["meshes"] == theirs["meshes"] and ours["triangles"] == theirs["triangles"]
    if ours["meshes"]:
        same = same and close(ours["low"], theirs["low"]) and close(ours["high"], theirs["high"])
    return f"{ours['meshes']} meshes, {ours['triangles']} triangles" + ("" if same else f": READ AS {theirs}"), same


def main():
    if len(sys.argv) < 4:
        sys.exit(__doc__)
    penumbra, tinyusdz = (pathlib.Path(argument).resolve() for argument in sys.argv[1:3])
    wrong = 0
    with tempfile.TemporaryDirectory() as folder:
        for number, model in enumerate(sys.argv[3:]):
            line, good = compare(penumbra, tinyusdz, model, pathlib.Path(folder) / f"{number}.usda")
            print(f"{pathlib.Path(model).name}: {line}", flush=True)
            wrong += not good
    print(f"{len(sys.argv) - 3} models, {wrong} read differently")
    sys.exit(1 if wrong else 0)


if __name__ == "__main__":
    main()
