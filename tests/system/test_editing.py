#!/usr/bin/env python3
"""A house is edited in a real window: a wall is dragged, a shelf removed, a desk duplicated, and all
of it taken back. No file says what may be moved. Usage: test_editing.py PENUMBRA SCENES OUTPUT"""
import re
import signal
import subprocess

import xwindow
from test_window import OUTPUT, PENUMBRA, View, check, differing, luminances

WHITE, ORANGE, GREEN, BLUE = (0.7, 0.7, 0.7), (0.7, 0.1, 0.02), (0.1, 0.5, 0.1), (0.08, 0.12, 0.6)
SIZES = ("--patch-size", "0.6", "--element-size", "0.3")


def box(name, lower, upper, colour):
    middle = [(a + b) / 2 for a, b in zip(lower, upper)]
    size = [b - a for a, b in zip(lower, upper)]
    return f"""def Cube "{name}"
{{
    double size = 1
    color3f[] primvars:displayColor = [{colour}]
    double3 xformOp:translate = {tuple(middle)}
    double3 xformOp:scale = {tuple(size)}
    uniform token[] xformOpOrder = ["xformOp:translate", "xformOp:scale"]
}}
"""


def thing(name, parts):
    return f'def Xform "{name}"\n{{\n{"".join(parts)}}}\n'


def house():
    """A room of 6 x 4.5 x 2.6 m, each wall a thing of its own, with a shelf and a desk."""
    walls = [box("Floor", (-0.1, -0.1, -0.1), (6.1, 4.6, 0), WHITE),
             box("Ceiling", (-0.1, -0.1, 2.6), (6.1, 4.6, 2.7), WHITE),
             box("West", (-0.1, 0, 0), (0, 4.5, 2.6), ORANGE),
             box("East", (6, 0, 0), (6.1, 4.5, 2.6), WHITE),
             box("South", (-0.1, -0.1, 0), (6.1, 0, 2.6), WHITE),
             box("North", (-0.1, 4.5, 0), (6.1, 4.6, 2.6), WHITE)]
    sides = [box(f"Side{k}", (x, 4.2, 0), (x + 0.05, 4.49, 1.8), GREEN)
             for k, x in enumerate((3.4, 4.4))]
    boards = [box(f"Board{k}", (3.45, 4.2, z), (4.4, 4.49, z + 0.05), GREEN)
              for k, z in enumerate((0.1, 0.7, 1.3, 1.75))]
    legs = [box(f"Leg{k}", (x, 2.5, 0), (x + 0.05, 3.1, 0.7), BLUE)
            for k, x in enumerate((1.5, 2.65))]
    return "".join(["#usda 1.0\n(\n    metersPerUnit = 1\n    upAxis = \"Z\"\n)\n", *walls,
                    thing("Shelf", sides + boards),
                    thing("Desk", legs + [box("Top", (1.5, 2.5, 0.7), (2.7, 3.1, 0.75), BLUE)]),
                    """def RectLight "Light"
{
    float inputs:width = 1
    float inputs:height = 1
    float inputs:intensity = 2000
    double3 xformOp:translate = (3, 2, 2.55)
    uniform token[] xformOpOrder = ["xformOp:translate"]
}
def Camera "Eye"
{
    float focalLength = 12
    float horizontalAperture = 36
    double3 xformOp:translate = (3, 0.4, 1.6)
    float xformOp:rotateX = 84
    uniform token[] xformOpOrder = ["xformOp:translate", "xformOp:rotateX"]
}
"""])


def orange(r, g, b):
    return r > 80 and g < 0.75 * r and b < 0.6 * r


def green(r, g, b):
    return g > 1.25 * r and g > 1.25 * b


def blue(r, g, b):
    return b > 1.25 * r and b > 1.1 * g


def places(rows, colour):
    """The pixels of a colour, every other one, left of the panels and above the status line."""
    return [(x, y) for y, row in enumerate(rows[:740]) if y % 2 == 0
            for x in range(0, 900, 2) if colour(*row[3 * x:3 * x + 3])]


def middle(rows, colour):
    """The pixel of a colour that is nearest to the middle of them."""
    found = places(rows, colour)
    check(len(found) > 300, f"{len(found)} pixels are {colour.__name__}")
    x, y = (sorted(values)[len(found) // 2] for values in zip(*found))
    return min(found, key=lambda place: abs(place[0] - x) + abs(place[1] - y))


def settled(view, name):
    """The picture, kept, and its luminances, when the light has settled."""
    view.lit()
    rows = view.rest()
    view.shot(name)
    return rows, view.exr()


def drag_the_wall(view, rows):
    display = view.display
    x, y = middle(rows, orange)
    display.hands("mousemove", x, y)
    display.hands("mousedown", 1)
    for step in range(1, 13):
        display.hands("mousemove", x + 8 * step, y)
    view.shot("editing-wall-in-hand")
    display.hands("mouseup", 1)


def edits(view):
    """All edits, one after the other. \\return the luminances at first and at last"""
    display = view.display
    rows, first = settled(view, "editing-first")
    wall, shelf, desk = (len(places(rows, colour)) for colour in (orange, green, blue))
    drag_the_wall(view, rows)
    rows, moved = settled(view, "editing-wall")
    check(len(places(rows, orange)) > 1.1 * wall, "the wall has come nearer, at the first touch")
    check(differing(first, moved, 0.05) > 0.1, "and the light with it")
    view.program.process.send_signal(signal.SIGSTOP)  # a late frame: the hand has moved on
    display.hands("mousemove", *middle(rows, green), "click", 1, "mousemove", *middle(rows, blue))
    view.program.process.send_signal(signal.SIGCONT)
    display.hands("key", "Delete")
    rows, removed = settled(view, "editing-no-shelf")
    check(len(places(rows, green)) < 0.1 * shelf, "Del removes the shelf, on which the button went down")
    display.hands("mousemove", *middle(rows, blue), "click", 1, "key", "ctrl+d")
    rows, last = settled(view, "editing-desks")
    check(len(places(rows, blue)) > 1.5 * desk, "Ctrl+D: another desk")
    for edited, before, which in ((moved, first, "wall"), (removed, moved, "shelf"),
                                  (last, removed, "desk")):
        check(differing(edited, before, 0.02) > 0.02, f"the {which}: another picture")
    return first, last


def taken_back(view, first, last):
    for _ in range(3):
        view.display.hands("key", "ctrl+z")
    _, again = settled(view, "editing-undone")
    check(differing(first, again, 0.01) < 0.001, "undone, all stands in its light again")
    for _ in range(3):
        view.display.hands("key", "ctrl+shift+z")
    _, again = settled(view, "editing-redone")
    check(differing(last, again, 0.01) < 0.001, "made again, the light is that of the edited house")


def lit_from_scratch(take, last):
    """Another command opens the end of the session: nothing is left of the way there."""
    code = int(float(re.search(r"endTimeCode = (\S+)", take.read_text()).group(1)))
    frame = OUTPUT / "from-scratch.exr"
    subprocess.run([PENUMBRA, "render", take, "-o", frame, "--frame", str(code), "--width", "1280",
                    "--height", "720", *SIZES, "--quiet"], check=True, timeout=300)
    share = differing(luminances(frame), last, 0.02)
    check(share < 0.01, f"lit from scratch, the edited house looks the same: {share:.4f} differ")


def main():
    xwindow.prepared(OUTPUT)
    scene, take = OUTPUT / "house.usda", OUTPUT / "take.usda"
    scene.write_text(house())
    with xwindow.Display() as display:
        xwindow.remember_size(OUTPUT / "config", 1280, 720)
        view = View(display, scene, *SIZES, "--record", take, "--quiet")
        first, last = edits(view)
        taken_back(view, first, last)
        check(view.program.end() == 0, "SIGTERM: exit code 0")
        check(view.program.said() == "", "and without a word: " + view.program.said())
        lit_from_scratch(take, last)


if __name__ == "__main__":
    main()
