#!/usr/bin/env python3
"""What `penumbra solve` costs: a first solution, and each move after it, in rays, memory and processor time.

Usage: bench/solutions.py PROGRAM [--scenes NAMES] [--out FILE.json]
PROGRAM is penumbra of a release build. Each scene is solved twice: at one frame, and over some frames in which
something moves. What the second takes more are its moves. Processor time is that of all threads; it counts on a busy
machine too, where time by the clock says little."""
import argparse
import json
import os
import pathlib
import subprocess
import tempfile

import measured

SCENES = pathlib.Path(__file__).resolve().parent.parent / "scenes"
# What is played: a file and its frames.
PLAYS = {"chamber": ("chamber-move", 1, 13), "office": ("office-seat", 13, 19), "gallery": ("gallery-walk", 10, 14)}


def solve(program, layer, first, last):
    """What --stats says of a run, and its processor time [s]."""
    with tempfile.TemporaryDirectory() as folder:
        stats = pathlib.Path(folder) / "stats.json"
        before = os.times()
        subprocess.run([program, "solve", SCENES / f"{layer}.usda", "--frames", f"{first}:{last}", "--quiet",
                        "--stats", stats], check=True, stdout=subprocess.DEVNULL)
        after = os.times()
        return json.loads(stats.read_text()), sum(after[2:4]) - sum(before[2:4])


def first_figures(stats, processor):
    scene, cost, rows = stats["scene"], stats["solve"], stats["sffl"]
    return {"patches": scene["patches"], "elements": scene["elements"], "emitters": scene["emitters"],
            "direct_rays": cost["direct_rays"], "indirect_rays": cost["indirect_rays"],
            "detail_rays": cost["detail_rays"], "cpu_s": processor,
            "entries": rows["entries"], "bytes_per_entry": rows["bytes"] / rows["entries"],
            "rows_MB": rows["bytes"] * 1e-6, "peak_MB": stats["memory"]["peak_bytes"] * 1e-6}


def rays_of(cost):
    return cost["direct"]["rays"] + cost["indirect"]["rays"] + cost["detail"]["rays"]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program", type=pathlib.Path)
    parser.add_argument("--out", type=pathlib.Path, default=pathlib.Path("penumbra_solutions.json"))
    parser.add_argument("--scenes", default=",".join(PLAYS))
    options = parser.parse_args()
    program, results = options.program.resolve(), []
    for name in options.scenes.split(","):
        layer, first, last = PLAYS[name]
        stamp = measured.stamp()
        one, once = solve(program, layer, first, first)
        played, all_of_it = solve(program, layer, first, last)
        figures = first_figures(one, once)
        moves = played["frames"][1:]
        rays = sum(map(rays_of, moves)) / len(moves)
        figures |= {"moves": len(moves), "move_rays": rays, "move_cpu_s": (all_of_it - once) / len(moves),
                    "move_rays_ratio": rays_of(played["frames"][0]) / rays,
                    "move_cpu_ratio": once * len(moves) / (all_of_it - once)}
        results.append({"name": f"solution/{name}", **stamp, **figures})
        measured.write(options.out, results)
        print(json.dumps(results[-1], indent=1), flush=True)


if __name__ == "__main__":
    main()
