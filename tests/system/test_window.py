#!/usr/bin/env python3
"""The walkthrough in a real window with real input. Usage: test_window.py PENUMBRA SCENES OUTPUT

What the display showed is kept in OUTPUT, as PNG where oiiotool is at hand.
"""
import os
import pathlib
import re
import shutil
import signal
import statistics
import struct
import subprocess
import sys
import time

sys.path.insert(0, str(pathlib.Path(__file__).parent))
import xwindow  # noqa: E402

PENUMBRA, SCENES, OUTPUT = (pathlib.Path(argument).resolve() for argument in sys.argv[1:4])


def check(holds, what):
    print(("ok      " if holds else "FAILED  ") + what, flush=True)
    if not holds:
        sys.exit(1)


def without_a_display():
    """One line that says what to do instead, and exit code 1."""
    for display in (None, ":4711"):
        environment = {k: v for k, v in os.environ.items() if k != "DISPLAY"}
        if display:
            environment["DISPLAY"] = display
        done = subprocess.run([PENUMBRA, "view", SCENES / "cornell.usda"], env=environment,
                              capture_output=True, text=True, timeout=60)
        check(done.returncode == 1, f"exit code 1 with DISPLAY {display}")
        check(len(done.stderr.splitlines()) == 1 and "penumbra render" in done.stderr,
              f"one line that names penumbra render: {done.stderr.strip()}")


def recording_over_a_layer(display):
    """A session is never recorded over a layer that the scene is read from."""
    walls = OUTPUT / "walls.usda"
    shutil.copy(SCENES / "cornell.usda", walls)
    (OUTPUT / "over.usda").write_text("#usda 1.0\n(\n    subLayers = [@./walls.usda@]\n)\n")
    before = walls.read_bytes()
    done = subprocess.run([PENUMBRA, "view", "over.usda", "--record", "walls.usda"],
                          env=dict(display.environment, XDG_CONFIG_HOME=str(OUTPUT / "config")),
                          cwd=OUTPUT, capture_output=True, text=True, timeout=60)
    check(done.returncode == 2 and "would overwrite" in done.stderr,
          f"--record over a sublayer: exit code {done.returncode}, {done.stderr.strip()}")
    check(walls.read_bytes() == before, "the sublayer is as it was")


class View:
    """A running walkthrough."""

    def __init__(self, display, *arguments, program=PENUMBRA):
        self.display = display
        environment = dict(display.environment, XDG_CONFIG_HOME=str(OUTPUT / "config"))
        self.program = xwindow.Program([str(program), "view", *map(str, arguments)], environment,
                                       OUTPUT / "view.log", OUTPUT)
        xwindow.until(lambda: "(loading)" not in (self.title() or "(loading)"), what="the window")
        display.hands("mousemove", 640, 400)

    def title(self):
        if self.program.process.poll() is not None:
            sys.exit("FAILED  it ended: " + self.program.said())
        return self.display.hands("search", "--name", "Penumbra", "getwindowname")

    def lit(self):
        """Waits until the light has settled."""
        time.sleep(0.3)  # for the last edit to be noticed
        xwindow.until(lambda: "(" not in self.title(), seconds=240, what="the light to settle")

    def shot(self, name):
        """The display, kept as a picture."""
        self.display.save(OUTPUT / f"{name}.ppm")
        rows = self.display.pixels()
        if shutil.which("oiiotool"):
            subprocess.run(["oiiotool", OUTPUT / f"{name}.ppm", "-o", OUTPUT / f"{name}.png"],
                           check=True)
            (OUTPUT / f"{name}.ppm").unlink()
        return rows

    def save(self):
        """A frame saved by F12: its EXR file; its PNG file, of the same name, is there before."""
        before = set(OUTPUT.glob("*.exr"))
        self.display.hands("key", "F12")
        new = xwindow.until(lambda: set(OUTPUT.glob("*.exr")) - before, what="the EXR file").pop()
        check(new.with_suffix(".png").exists(), "F12 saves a PNG with the EXR")
        return new

    def exr(self):
        """A frame saved by F12: its luminances [nit], row by row."""
        return luminances(self.save())

    def rest(self):
        """The picture once it has come to rest: for a second, for exposure adapts ever slower."""
        taken = []

        def still():
            taken.append(self.display.pixels())
            time.sleep(0.25)
            if len(taken) < 5:
                return False
            return xwindow.difference(taken.pop(0), taken[-1]) < 0.05 and taken[-1]
        return xwindow.until(still, what="a picture at rest")


def luminances(exr):
    """The luminances of an EXR file's beauty layer as one list of floats."""
    tiff = exr.with_suffix(".tif")
    subprocess.run(["oiiotool", exr, "--ch", "R,G,B", "--chsum:weight=0.2126,0.7152,0.0722",
                    "--compression", "none", "-d", "float", "-o", tiff], check=True)
    data = tiff.read_bytes()
    tiff.unlink()
    order = "<" if data[:2] == b"II" else ">"
    first, = struct.unpack_from(order + "I", data, 4)
    count, = struct.unpack_from(order + "H", data, first)
    fields = {}
    for i in range(count):  # tag -> the numbers it has; 3: 16 bits, 4: 32 bits
        tag, kind, size = struct.unpack_from(order + "HHI", data, first + 2 + 12 * i)
        letter = {3: "H", 4: "I"}.get(kind)
        if letter:
            at = first + 10 + 12 * i
            if struct.calcsize(letter) * size > 4:
                at, = struct.unpack_from(order + "I", data, at)
            fields[tag] = struct.unpack_from(f"{order}{size}{letter}", data, at)
    values = []
    for offset, size in zip(fields[273], fields[279]):  # strips
        values += struct.unpack_from(f"{order}{size // 4}f", data, offset)
    return values


def rows_of(picture):
    """The rows of a PNG: bytes, three a pixel."""
    ppm = picture.with_suffix(".saved.ppm")
    subprocess.run(["oiiotool", picture, "-o", ppm], check=True)
    data = ppm.read_bytes()
    ppm.unlink()
    head = re.match(rb"P6\s+(\d+)\s+(\d+)\s+255\s", data)
    row, pixels = 3 * int(head.group(1)), data[head.end():]
    return [pixels[at:at + row] for at in range(0, len(pixels), row)]


def differing(a, b, relative):
    """The share of pixels whose luminances differ by more than that."""
    return sum(abs(p - q) > relative * max(p, q, 0.01) for p, q in zip(a, b)) / len(a)


def lively(rows):
    """How many different colours a picture has, on a coarse grid."""
    return len({row[x:x + 3] for row in rows[::9] for x in range(0, len(row), 27)})


def at_the_camera(view, first):
    """Presses 1, which goes to the camera of the file: the picture is again as it was at first."""
    def back():
        view.display.hands("key", "1")  # again, should a busy machine have lost it
        time.sleep(2)
        return xwindow.difference(first, view.display.pixels()) < 1
    xwindow.until(back, what="the first camera's picture, exposure and all, after 1")
    return view.rest()


def walk_about(display):
    view = View(display, SCENES / "cornell.usda", "--patch-size", "0.2", "--quiet")
    xwindow.until(lambda: lively(display.pixels()) > 50, seconds=20, what="the first picture")
    display.hands("key", "n")  # the panels off
    view.lit()
    first = view.rest()
    view.shot("cornell")
    display.hands("keydown", "w")
    time.sleep(0.2)
    display.hands("keyup", "w")
    check(xwindow.difference(first, view.rest()) > 2, "W walks")
    view.shot("cornell-walked")
    back = at_the_camera(view, first)
    display.hands("mousedown", 3)
    display.hands("mousemove_relative", "--", 60, 20)
    display.hands("mouseup", 3)
    check(xwindow.difference(back, view.rest()) > 2, "the right button looks around")
    view.shot("cornell-looked")
    back = at_the_camera(view, first)
    display.hands("type", "]]]")
    check(xwindow.difference(back, view.rest()) > 5, "] makes the picture brighter")
    display.hands("type", "?")
    view.rest()
    view.shot("help")
    check(view.program.end(signal.SIGTERM) == 0, "SIGTERM ends it with exit code 0")
    check(view.program.said() == "", "and without a word: " + view.program.said())
    settings = (OUTPUT / "config/penumbra/viewer.conf").read_text()
    check("compensation = 1\n" in settings and "panels = 0" in settings, "it remembers settings")


def the_picture_is_the_window_s(display):
    """F12's PNG is what the window shows, byte for byte, and what render writes with its exposure."""
    (OUTPUT / "config/penumbra/viewer.conf").unlink()  # as when it is opened the first time
    view = View(display, SCENES / "cornell.usda", "--patch-size", "0.2", "--quiet",
                "--exposure", "7.5", "--tone", "aces")
    display.hands("key", "n")  # the panels off; the status line stays
    view.lit()
    display.hands("mousemove", 600, 600)  # below what is compared
    seen = view.rest()
    saved = rows_of(view.save().with_suffix(".png"))
    wide, high = len(saved[0]) // 3, len(saved)
    check(wide <= 1280 and high <= 640, f"at first the window fits a small screen: {wide} x {high}")
    at = next((top, left) for top in range(len(seen) - high + 1)
              for left in range(len(seen[0]) // 3 - wide + 1)
              if seen[top][3 * left:3 * (left + wide)] == saved[0]
              and seen[top + high // 2][3 * left:3 * (left + wide)] == saved[high // 2])
    above = high - 120  # of the status line, its notices and the pointer
    check(all(seen[at[0] + y][3 * at[1]:3 * (at[1] + wide)] == saved[y] for y in range(above)),
          "F12's PNG has the very bytes that the window shows")
    check(view.program.end() == 0, "SIGTERM ends it with exit code 0")
    kept = (OUTPUT / "config/penumbra/viewer.conf").read_text()
    check("compensation = 0\n" in kept and "tone = 0\n" in kept,
          "--exposure and --tone are not remembered")
    rendered = OUTPUT / "rendered.png"
    subprocess.run([PENUMBRA, "render", SCENES / "cornell.usda", "--png", rendered, "--patch-size",
                    "0.2", "--exposure", "7.5", "--tone", "aces", "--width", str(wide), "--height",
                    str(high), "--quiet"], check=True, timeout=120)
    check(xwindow.difference(saved, rows_of(rendered)) < 1.5, "render --png shows the same picture")


def spread(rows, box):
    """The colours in a box (left, top, right, bottom), on a grid [pixel]."""
    left, top, right, bottom = box
    return [tuple(rows[y][3 * x:3 * x + 3]) for y in range(top, bottom, 4)
            for x in range(left, right, 4)]


def overlays(display):
    """O lays one overlay after the other over the picture, each with its legend."""
    view = View(display, SCENES / "cornell.usda", "--patch-size", "0.2", "--quiet")
    view.lit()
    display.hands("type", "[[[")  # as walk_about() left it, and dark enough for lines to be seen
    plain = view.rest()
    legend, middle = (10, 10, 300, 60), (340, 100, 940, 700)
    display.hands("key", "o")
    mesh = view.rest()
    view.shot("overlay-mesh")
    check(spread(plain, legend) != spread(mesh, legend), "O: a legend comes with the patch mesh")
    lines = [p != m for p, m in zip(spread(plain, middle), spread(mesh, middle))]
    check(0.02 < sum(lines) / len(lines) < 0.7, "lines are drawn, and the picture is between them")
    display.hands("key", "o")
    time.sleep(1)
    age = display.pixels()
    view.shot("overlay-age")
    bluish = sum(b > r for r, _, b in spread(age, middle))
    check(bluish > 0.9 * len(spread(age, middle)), "O: light of seconds ago is blue")
    display.hands("type", "]]]")
    time.sleep(1)
    bright = display.pixels()
    # By the median: some light may come anew, and age goes on meanwhile.
    check(statistics.median(max(abs(p - q) for p, q in zip(a, b))
                            for a, b in zip(spread(age, middle), spread(bright, middle)))
          < 64, "exposure leaves the overlay as it is")
    display.hands("key", "shift+o", "shift+o")
    display.hands("type", "[[[")
    check(xwindow.difference(plain, view.rest()) < 0.5, "Shift+O goes back to the picture alone")
    work_overlays(view)
    check(view.program.end() == 0, "SIGTERM ends it with exit code 0")


def work_overlays(view):
    """Overlays that the lighting process, or the pointer, has something to say for."""
    display, legend = view.display, (10, 10, 300, 120)
    before = spread(view.rest(), legend)
    for keys, name in ((3, "open-work"), (1, "importance"), (1, "blockers")):
        display.hands("key", *["o"] * keys)
        time.sleep(0.5)
        now = spread(view.shot(f"overlay-{name}"), legend)
        check(now != before, f"O: a legend comes with {name}")
        before = now
    display.hands("key", "o")


def orange_places(rows):
    """The pixels that are orange, every other one of a row, left of the panels."""
    return [(x, y) for y, row in enumerate(rows) for x in range(0, 900, 2)
            if row[3 * x] > 110 and row[3 * x + 1] < 0.62 * row[3 * x]
            and row[3 * x + 2] < 0.45 * row[3 * x]]


def orange(rows):
    """The middle of what is orange like the seat in the office [pixel]."""
    places = [(x, y) for x, y in orange_places(rows) if y > 350]
    check(len(places) > 500, "the seat is seen")
    xs, ys = sorted(x for x, _ in places), sorted(y for _, y in places)
    return xs[len(xs) // 2], ys[len(ys) // 2]


def seat_samples(take):
    """Where the recorded seat was [m]."""
    text = take.read_text()
    seat = text[text.index('over "Seat"'):]
    block = re.search(r"xformOp:translate:session.timeSamples = \{(.*?)\}", seat, re.S)
    return [tuple(map(float, place.split(",")))
            for place in re.findall(r": \(([^)]*)\)", block.group(1))]


def office_session(display):
    take = OUTPUT / "take.usda"
    xwindow.remember_size(OUTPUT / "config", 1280, 720)  # as replayed() renders it
    view = View(display, SCENES / "office.usda", "--patch-size", "1", "--element-size", "0.5",
                "--record", take, "--quiet")
    check(take.exists(), "the recording is there from the start")
    view.shot("office-first")
    view.lit()
    start = view.rest()
    view.shot("office-lit")
    still = view.exr()
    x, y = orange(start)
    display.hands("mousemove", x, y)
    display.hands("mousedown", 1)
    for step in range(1, 9):
        display.hands("mousemove", x - 12 * step, y + 6 * step)
    dragged = display.pixels()
    view.shot("office-dragged")
    check(xwindow.difference(start, dragged) > 0.5, "the seat follows the pointer")
    display.hands("mouseup", 1)
    view.lit()
    view.rest()
    view.shot("office-released")
    moved = view.exr()
    check(differing(still, moved, 0.05) > 0.02, "the saved frame shows the seat elsewhere")
    display.hands("key", "ctrl+z")
    view.lit()
    back = view.exr()
    check(differing(still, back, 0.01) < 0.001, "undo brings the picture back")
    display.hands("key", "ctrl+shift+z")
    display.hands("key", "Escape")
    for _ in range(3):  # a stop
        display.hands("type", "-")
    view.lit()
    dimmed = view.exr()
    ratios = sorted(d / m for d, m in zip(dimmed, moved) if m > 0.1)
    check(0.49 < ratios[len(ratios) // 2] < 0.53, "three times - halves the light")
    display.hands("key", "ctrl+z")
    view.lit()
    again = view.exr()
    check(differing(moved, again, 0.01) < 0.001, "one undo takes the dimming back")
    check(view.program.end() == 0, "SIGTERM in the middle of a recording: exit code 0")
    check(view.program.said() == "", "and without a word: " + view.program.said())
    return take, again


def furnishing(display):
    """The seat is duplicated, hidden and removed, and all of it is taken back."""
    view = View(display, SCENES / "office.usda", "--patch-size", "1", "--element-size", "0.5",
                "--quiet")
    view.lit()
    start = view.rest()
    still = view.exr()
    pixels = len(orange_places(start))
    display.hands("mousemove", *orange(start))
    display.hands("click", 1)

    def after(key, name):
        display.hands("key", key)
        view.lit()
        rows = view.rest()
        view.shot(name)
        return len(orange_places(rows)) / pixels

    share = after("ctrl+d", "office-another-seat")
    check(share > 1.3, f"Ctrl+D: another seat, {share:.2f} times the orange")
    share = after("h", "office-seat-hidden")
    check(share < 1.2, f"H hides it: {share:.2f}")
    share = after("shift+h", "office-seat-shown")
    check(share > 1.3, f"Shift+H shows it: {share:.2f}")
    for _ in range(3):
        display.hands("key", "ctrl+z")
    view.rest()  # all three have been noticed
    view.lit()
    check(differing(still, view.exr(), 0.01) < 0.001, "undone, the light is as it was")
    display.hands("click", 1)
    share = after("Delete", "office-seat-removed")
    check(share < 0.5, f"Del removes the seat: {share:.2f}")
    display.hands("key", "ctrl+z")
    view.lit()
    check(differing(still, view.exr(), 0.01) < 0.001, "undone, it stands in its light again")
    check(view.program.end() == 0, "SIGTERM: exit code 0")
    check(view.program.said() == "", "and without a word: " + view.program.said())


def replayed(take, last):
    """The recording, played by another command: it ends with the picture that was seen last."""
    places = seat_samples(take)
    off = max(abs(a - b) for a, b in zip(places[0], places[-1]))
    check(off > 0.1, f"the recorded seat ends {off:.2f} m from where it was")
    check(max(abs(p[2] - places[0][2]) for p in places) < 1e-9, "it stayed on the floor")
    text = take.read_text()
    code = int(float(re.search(r"endTimeCode = (\S+)", text).group(1)))
    check("inputs:intensity.timeSamples" in text, "the dimmed lights are in the recording")
    frame = OUTPUT / "replayed.exr"
    subprocess.run([PENUMBRA, "render", take, "-o", frame, "--frame", str(code), "--width", "1280",
                    "--height", "720", "--patch-size", "1", "--element-size", "0.5", "--quiet"],
                   check=True, timeout=300)
    check(differing(luminances(frame), last, 0.02) < 0.01,
          "penumbra render shows the end of the session as the window did")


def replay_in_the_window(display, take):
    view = View(display, take, "--replay", "--patch-size", "1", "--element-size", "0.5", "--quiet")
    xwindow.until(lambda: lively(view.display.pixels()) > 50, seconds=20,
                  what="the first picture of the session")
    print("ok      view --replay shows the session")
    display.hands("key", "ctrl+q")
    check(view.program.wait() == 0, "Ctrl+Q ends it with exit code 0")


def main():
    without_a_display()
    xwindow.prepared(OUTPUT)
    with xwindow.Display() as display:
        recording_over_a_layer(display)
        xwindow.remember_size(OUTPUT / "config", 1280, 800)
        walk_about(display)
        overlays(display)
        take, last = office_session(display)
        replayed(take, last)
        furnishing(display)
        replay_in_the_window(display, take)
        the_picture_is_the_window_s(display)


if __name__ == "__main__":
    main()
