#!/usr/bin/env python3
"""Models and other scenes in a real window: opened, dropped, dragged about, left.
Usage: test_opening.py PENUMBRA SCENES OUTPUT"""
import shutil
import subprocess
import sys
import time

import xwindow
from test_window import OUTPUT, PENUMBRA, SCENES, View, check, orange_places

# A floor, a stool on it and a panel that shines; no camera, and no word of what an object is.
BOX = ((1, 2, 4, 3), (5, 7, 8, 6), (1, 5, 6, 2), (3, 4, 8, 7), (1, 3, 7, 5), (2, 6, 8, 4))
MATERIALS = """newmtl Grey
Kd 0.5 0.5 0.5
newmtl Orange
Kd 0.7 0.1 0.02
newmtl Shine
Kd 0 0 0
Ke 3000 3000 3000
"""


def write_model(folder):
    lines = ["mtllib room.mtl", "o Floor", "usemtl Grey", "v -2 0 -2", "v -2 0 2", "v 2 0 2",
             "v 2 0 -2", "f 1 2 3 4", "o Stool", "usemtl Orange"]
    lines += [f"v {x} {y} {z}" for z in (-0.4, 0.4) for y in (0.01, 0.81) for x in (-0.4, 0.4)]
    lines += ["f " + " ".join(str(4 + corner) for corner in reversed(face)) for face in BOX]
    lines += ["o Panel", "usemtl Shine", "v -2 3 -0.5", "v -1.5 3 -0.5", "v -1.5 3 0.5",
              "v -2 3 0.5", "f 13 14 15 16"]
    (folder / "room.mtl").write_text(MATERIALS)
    (folder / "room.obj").write_text("\n".join(lines) + "\n")
    return folder / "room.obj"


def middle(rows):
    """The middle of what is orange [pixel]."""
    places = orange_places(rows)
    check(len(places) > 200, "the stool is seen")
    xs, ys = sorted(x for x, _ in places), sorted(y for _, y in places)
    return xs[len(xs) // 2], ys[len(ys) // 2]


def drag_the_stool(view):
    display = view.display
    x, y = middle(view.rest())
    display.hands("mousemove", x, y)
    display.hands("mousedown", 1)
    for step in range(1, 9):
        display.hands("mousemove", x + 8 * step, y)
    display.hands("mouseup", 1)
    view.lit()
    there, _ = middle(view.rest())
    view.shot("opening-dragged")
    check(there - x > 30, f"the stool was dragged: {there - x} pixels to the right")


def drop(view, file):
    display = view.display
    window = display.hands("search", "--name", "Penumbra").split()[-1]
    done = subprocess.run([sys.executable, str(xwindow.HERE / "xdrop.py"), window, "400", "300",
                           str(file)], env=display.environment, capture_output=True, text=True,
                          timeout=60)
    check(done.returncode == 0, "the window takes a dropped file" + done.stderr)


def opened(view, name):
    xwindow.until(lambda: view.title().startswith(name), what=f"{name} to be opened")
    print(f"ok      {name} is shown", flush=True)


def press_from_the_left(view, row, until_true):
    """Clicks along a row of a dialog in the middle of the window, until something comes of it."""
    for x in range(420, 860, 15):
        view.display.hands("mousemove", x, row, "click", 1)
        time.sleep(0.1)
        if until_true():
            return True
    return False


def edits_are_asked_about(view):
    """A changed scene is left only when people say so; Save writes a layer over it."""
    display, saved = view.display, OUTPUT / "room-edited.usda"
    before = view.rest()
    drop(view, SCENES / "cornell.usda")
    time.sleep(2)
    asked = view.shot("opening-asked")
    check(view.title().startswith("room.obj"), "a changed scene stays until people have answered")
    check(xwindow.difference(before, asked) > 0.3, "they are asked")
    display.hands("key", "Escape")
    time.sleep(1)
    check(view.title().startswith("room.obj"), "Escape: it stays")
    drop(view, SCENES / "cornell.usda")
    time.sleep(2)
    check(any(press_from_the_left(view, row, saved.exists) for row in (430, 424, 436, 418, 442, 406, 454)),
          "Save writes " + saved.name)
    check("xformOp:translate:session" in saved.read_text(), "with the stool where it is now")
    opened(view, "cornell.usda")


def the_end_is_asked_about(view):
    """Ctrl+Q and F5 ask, too, where something was changed; a second Ctrl+Q is an answer."""
    display = view.display
    before = view.rest()
    for key in ("F5", "ctrl+q"):
        display.hands("key", key)
        time.sleep(1)
        check(xwindow.difference(before, view.shot("opening-end")) > 0.3, key + ": they are asked")
        display.hands("key", "Escape")
        time.sleep(1)
        check(xwindow.difference(before, view.rest()) < 0.3, "Escape: the scene stays")
    display.hands("key", "ctrl+q")
    time.sleep(1)
    display.hands("key", "ctrl+q")
    check(view.program.wait() == 0, "Ctrl+Q, twice, ends it with exit code 0")


def open_by_the_dialog(view):
    """Ctrl+O lists first what was opened lately: the model, below the scene that is shown."""
    display = view.display
    for y in range(264, 340, 8):  # as far down as the fonts of this machine have it
        view.lit()
        display.hands("key", "Escape")
        display.hands("key", "ctrl+o")
        time.sleep(1)
        if y == 264:
            view.shot("opening-dialog")
        display.hands("mousemove", 560, y, "click", 1)
        time.sleep(2)
        if view.title().startswith("room.obj"):
            print("ok      Ctrl+O opens what was opened lately", flush=True)
            return
    check(False, "Ctrl+O opens what was opened lately")


def has_a_worker(view):
    """A program that people call otherwise is its own worker all the same."""
    process = view.program.process.pid
    with open(f"/proc/{process}/task/{process}/children") as children:
        check(len(children.read().split()) == 1, f"{view.program.process.args[0]} has a worker")


def main():
    xwindow.prepared(OUTPUT)
    model = write_model(OUTPUT)
    renamed = shutil.copy(PENUMBRA, OUTPUT / "penumbra-today")
    with xwindow.Display() as display:
        xwindow.remember_size(OUTPUT / "config", 1280, 800)
        view = View(display, model, "--patch-size", "0.4", "--quiet", program=renamed)
        view.lit()
        has_a_worker(view)
        view.shot("opening-model")
        drag_the_stool(view)
        edits_are_asked_about(view)
        open_by_the_dialog(view)
        drag_the_stool(view)
        the_end_is_asked_about(view)


if __name__ == "__main__":
    main()
