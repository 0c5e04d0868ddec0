#!/usr/bin/env python3
"""Compares scheduling policies by a fixed script of moves and cameras.

Usage: bench/policies.py PROGRAM [--element-size M] [--orders A,B]
                       [--all-light] [--cameras NAMES] [--cut | --pan DEGREES]
                       [--dirty perfect] [--out FOLDER] [--json FILE]

For each camera, `penumbra compare` plays three moves of the office's seat or a sculpture of the
gallery (20 cm, 1.2 m, 3.3 m); figures are means over moves and cameras, of edits that are seen. The
dirty set is that of bounding shafts: blocks whose shaft to the light meets the moved object's box,
those in which it was a blocker, and its own. With --dirty perfect it is what comes out otherwise: work
that changes nothing is not done, and times leave out finding it.
The settled solution of the same mesh is the truth. Several seeds of the random policy (random,random2,
...) also make a row of their mean. With --cut the viewer looks through another camera until a tenth
of the work is done; with --pan they turn by so many degrees while it is done, and the error is that
in the view of the moment. Writes a report (HTML, JSON) for each camera to FOLDER, the means to FILE,
and a table of them to standard output."""
import argparse
import json
import math
import pathlib
import subprocess

import measured

SCENES = pathlib.Path(__file__).resolve().parent.parent / "scenes"

# What moves, and where it is at frames 1 to 4 [m].
MOVES = {
    "office": ("Seat", [(2.79, 2.21, 0), (2.97, 2.12, 0), (3.9, 1.35, 0), (1.0, 1.9, 0)]),
    "gallery": ("PiercedCube", [(10.2, 15.2, 0.6), (10.38, 15.11, 0.6), (11.31, 14.34, 0.6),
                                (14.2, 15.93, 0.6)]),
}

# Cameras: position [m], turns [degrees]. "dark" is the first one with most lights at 1/1000.
CAMERAS = {
    "office": {
        "on-screen": ((0.55, 0.42, 1.62), (75, 0, -49.25)),
        "part-hidden": ((6.6, 4.9, 1.2), (82, 0, 128)),
        "off-screen": ((3.6, 2.4, 1.6), (84, 0, 20)),
        "dark": ((0.55, 0.42, 1.62), (75, 0, -49.25)),
    },
    "gallery": {
        "on-screen": ((16.4, 8.6, 1.7), (84, 0, 45)),
        "part-hidden": ((14.5, 10.4, 1.3), (84, 0, 41.6)),  # the knot stands in the middle
        "off-screen": ((13, 10, 1.6), (84, 0, -100)),
        "dark": ((16.4, 8.6, 1.7), (84, 0, 45)),
    },
}
# Lights that are dimmed, by a thousand: lights and their intensities in the files.
DIMMED = {
    "office": [(f"CeilingLamp{i}/Panel", 2400) for i in (1, 2, 3)],
    "gallery": [("CeilingLamp7/Panel", 1500), ("CeilingLamp8/Panel", 1500), ("Spot2/Bulb", 60000)],
}


def samples(name, kind, values):
    lines = ",\n".join(f"            {i + 1}: {v}" for i, v in enumerate(values))
    return f"        {kind} {name}.timeSamples = {{\n{lines}\n        }}\n"


def camera_prim(name, scene, camera):
    at, turn = CAMERAS[scene][camera]
    return f"""    def Camera "{name}"
    {{
        float2 clippingRange = (0.02, 200)
        float focalLength = 21
        float horizontalAperture = 36
        float verticalAperture = 20.25
        float3 xformOp:rotateXYZ = {turn}
        double3 xformOp:translate = {at}
        uniform token[] xformOpOrder = ["xformOp:translate", "xformOp:rotateXYZ"]
    }}
"""


def layer(scene, camera):
    thing, places = MOVES[scene]
    text = f"""#usda 1.0
(
    defaultPrim = "World"
    endTimeCode = {len(places)}
    metersPerUnit = 1
    startTimeCode = 1
    subLayers = [
        @{SCENES / (scene + ".usda")}@
    ]
    upAxis = "Z"
)

over "World"
{{
    over "{thing}"
    {{
"""
    text += samples("xformOp:translate", "double3", places) + "    }\n"
    if camera == "dark":
        for path, intensity in DIMMED[scene]:
            lamp, light = path.split("/")
            text += f"""    over "{lamp}"
    {{
        over "{light}"
        {{
            float inputs:intensity = {intensity / 1000}
        }}
    }}
"""
    before = "off-screen" if camera != "off-screen" else "on-screen"
    return text + camera_prim("Judge", scene, camera) + camera_prim("Before", scene, before) + "}\n"


def area(samples, last):
    """Mean error as a share of what it was at first, until work `last`."""
    first = samples[0]["mean_jnd"]
    total = 0
    for here, after in zip(samples, samples[1:] + [None]):
        until = min(after["work"] if after else last, last)
        total += max(0, until - min(here["work"], last)) * here["mean_jnd"]
    return total / (first * last)


def when_below(samples, share, key):
    limit = share * samples[0]["mean_jnd"]
    last = [i for i, s in enumerate(samples) if s["mean_jnd"] > limit]
    at = last[-1] + 1 if last else 0
    return samples[at][key] if at < len(samples) else samples[-1][key]


def mean(values):
    values = list(values)
    return sum(values) / len(values) if values else math.nan


def means(edits):
    return {key: mean(edit[key] for edit in edits)
            for key in ("area", "work90", "time90", "against", "total", "work")}


def figures(reports):
    """One row a policy: means over all edits that are seen at all."""
    names = [o["order"] for o in reports[0]["orders"]]
    rows, edits = {name: [] for name in names}, 0
    for report in reports:
        orders = {o["order"]: o["edits"] for o in report["orders"]}
        for i in range(len(orders[names[0]])):
            edits += 1
            runs = {n: orders[n][i]["samples"] for n in names}
            if runs[names[0]][0]["mean_jnd"] < 1e-3:
                continue
            last = max(r[-1]["work"] for r in runs.values())
            slowest = runs.get("plain", runs[names[0]])
            for name, run in runs.items():
                rows[name].append({
                    "area": area(run, last),
                    "work90": when_below(run, 0.1, "work") / last,
                    "time90": when_below(run, 0.1, "seconds") / slowest[-1]["seconds"],
                    "against": when_below(run, 0.1, "seconds")
                    / max(1e-9, when_below(slowest, 0.1, "seconds")),
                    "total": run[-1]["seconds"] / slowest[-1]["seconds"],
                    "work": run[-1]["work"] / slowest[-1]["work"],
                })
    print(f"{len(rows[names[0]])} of {edits} edits are seen\n")
    return rows


def with_mean_of_seeds(rows):
    """Adds the mean of all random orders, edit by edit."""
    seeds = [name for name in rows if name.startswith("random")]
    if len(seeds) > 1:
        edits = zip(*(rows[name] for name in seeds))
        rows[f"random, {len(seeds)} seeds"] = [
            {key: mean(edit[key] for edit in same) for key in same[0]} for same in edits]
    return rows


def main():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program")
    parser.add_argument("--scene", default="office", choices=sorted(CAMERAS))
    parser.add_argument("--element-size", default="0.051")
    parser.add_argument("--cameras", default="")
    parser.add_argument("--orders", default="plain,random,bound,geometry,importance,oracle")
    parser.add_argument("--all-light", action="store_true", help="indirect light as well")
    viewer = parser.add_mutually_exclusive_group()
    viewer.add_argument("--cut", action="store_true", help="look elsewhere at first")
    viewer.add_argument("--pan", default="0", metavar="DEGREES", help="turn meanwhile")
    parser.add_argument("--dirty", default="shafts", choices=["shafts", "perfect"])
    parser.add_argument("--sample-growth", default="1.15")
    parser.add_argument("--out", type=pathlib.Path, default=pathlib.Path("orders"))
    parser.add_argument("--json", type=pathlib.Path, help="all means, for scripts/performance_tables")
    args = parser.parse_args()
    args.out.mkdir(parents=True, exist_ok=True)
    reports, stamp = [], measured.stamp()
    for camera in args.cameras.split(",") if args.cameras else CAMERAS[args.scene]:
        scene = args.out / f"{args.scene}-{camera}.usda"
        scene.write_text(layer(args.scene, camera))
        report = args.out / f"{args.scene}-{camera}.html"
        command = [args.program, "compare", scene, "--frames", f"1:{len(MOVES[args.scene][1])}",
                   "--camera", "/World/Judge", "--element-size", args.element_size,
                   "--orders", args.orders, "--sample-growth", args.sample_growth, "--width", "320", "-o", report,
                   "--dirty", args.dirty, "--quiet"]
        command += [] if args.all_light else ["--direct-only"]
        command += ["--cut-from", "/World/Before"] if args.cut else ["--pan", args.pan]
        subprocess.run(command, check=True)
        reports.append(json.loads(report.with_suffix(".json").read_text()))
    rows = with_mean_of_seeds(figures(reports))
    if args.json:
        measured.write(args.json, [{"name": f"policy/{args.scene}/{name}", **stamp, "edits": len(edits), **means(edits)}
                                   for name, edits in rows.items()])
    print("| order | area | work to -90 % | time to -90 % of plain's total | of plain's to -90 % |"
          " total time / plain | total work / plain |")
    print("| --- | ---: | ---: | ---: | ---: | ---: | ---: |")
    for name, edits in rows.items():
        print(f"| {name} | " + " | ".join(f"{value:.3f}" for value in means(edits).values()) + " |")


if __name__ == "__main__":
    main()
