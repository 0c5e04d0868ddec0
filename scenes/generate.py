#!/usr/bin/env python3
"""Writes the committed scene files, the same bytes each time.

    python3 scenes/generate.py            write all scenes and their layers beside this file
    python3 scenes/generate.py --check    compare and validate only; exit 1 on any difference
    python3 scenes/generate.py --stats    counts and areas as Markdown tables
"""

import argparse
import pathlib
import sys

from scenegen import check_model, check_motion, check_text, gallery, office, small, walkthroughs
from scenegen.subdivision import subdivide

HERE = pathlib.Path(__file__).resolve().parent
SCENES = (small.cornell, small.chamber, office.build, gallery.build)


def surface_area(scene):
    """Of all meshes, cages as the smooth surfaces they stand for [m2]."""
    total = sum(p.area() for o in scene.objects for p in o.all_parts())
    return total + sum(subdivide(part, creases, 2).area()
                       for o in scene.objects for _, part, creases in o.cages)


def stats(scenes):
    print("| scene | objects | marked | polygons | lights | surface [m2] | bytes |")
    print("| --- | ---: | ---: | ---: | ---: | ---: | ---: |")
    for scene in scenes:
        lights = sum(len(o.lights) for o in scene.objects)
        marked = sum(o.movable for o in scene.objects)
        print(f"| `{scene.name}.usda` | {len(scene.objects)} | {marked} | {scene.polygons()} "
              f"| {lights} | {surface_area(scene):.1f} | {len(scene.text())} |")


def layer_stats(layers):
    print("\n| layer | frames | a second | moves | bytes |")
    print("| --- | ---: | ---: | --- | ---: |")
    for layer in layers:
        moves = [f"`{name}`" for name in [*layer.eyes, *layer.poses]]
        moves += [f"`{name}`'s light" for name, _ in layer.lights]
        print(f"| `{layer.name}.usda` | {len(layer.frames)} | {layer.per_second} "
              f"| {', '.join(moves)} | {len(layer.text())} |")


def check(scenes, layers):
    problems = []
    for written in scenes + layers:
        path = HERE / f"{written.name}.usda"
        if not path.exists() or path.read_bytes() != written.text().encode():
            problems.append(f"{path.name}: differs from what generate.py writes")
    for scene in scenes:
        problems += check_text.complaints(scene.name, scene.text()) + check_model.complaints(scene)
    for layer in layers:
        problems += check_motion.complaints(layer)
    for problem in problems:
        print(problem, file=sys.stderr)
    return 1 if problems else 0


def main():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawTextHelpFormatter)
    parser.add_argument("--check", action="store_true", help="write nothing, compare and validate")
    parser.add_argument("--stats", action="store_true", help="write nothing, print counts")
    options = parser.parse_args()
    scenes = [build() for build in SCENES]
    layers = walkthroughs.build({scene.name: scene for scene in scenes})
    if options.stats:
        stats(scenes)
        layer_stats(layers)
    elif options.check:
        return check(scenes, layers)
    else:
        for written in scenes + layers:
            (HERE / f"{written.name}.usda").write_bytes(written.text().encode())
    return 0


if __name__ == "__main__":
    sys.exit(main())
