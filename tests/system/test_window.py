#!/usr/bin/env python3
"""The walkthrough in a real window with real input. Usage: test_window.py PENUMBRA SCENES OUTPUT"""
import os
import pathlib
import signal
import subprocess
import sys
import time

sys.path.insert(0, str(pathlib.Path(__file__).parent))
import xwindow  # noqa: E402

PENUMBRA, SCENES, OUTPUT = sys.argv[1], pathlib.Path(sys.argv[2]), pathlib.Path(sys.argv[3])
SKIPPED = 77


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


def opened(display, *arguments):
    """A running walkthrough whose scene is there."""
    OUTPUT.mkdir(parents=True, exist_ok=True)
    program = xwindow.Program([PENUMBRA, "view", *map(str, arguments)], display.environment,
                              OUTPUT / "view.log")
    def there():
        if program.process.poll() is not None:
            sys.exit("FAILED  it ended: " + program.said())
        name = display.hands("search", "--name", "Penumbra", "getwindowname")
        return name and "(loading)" not in name
    xwindow.until(there, what="the window")
    display.hands("mousemove", 640, 400)
    return program


def lively(rows):
    """How many different colours a picture has, on a coarse grid."""
    return len({row[x:x + 3] for row in rows[::9] for x in range(0, len(row), 27)})


def settled(display):
    """The picture once it has come to rest."""
    before = display.pixels()
    def still():
        nonlocal before
        time.sleep(0.4)
        now = display.pixels()
        same = xwindow.difference(before, now) < 0.02
        before = now
        return same and now
    return xwindow.until(still, what="a picture at rest")


def walk(display):
    program = opened(display, SCENES / "cornell.usda")
    first = xwindow.until(lambda: lively(display.pixels()) > 50 and settled(display),
                          what="the first picture")
    display.save(OUTPUT / "first.ppm")
    display.hands("keydown", "w")
    time.sleep(0.4)
    display.hands("keyup", "w")
    walked = settled(display)
    display.save(OUTPUT / "walked.ppm")
    check(xwindow.difference(first, walked) > 2, "W walks")
    display.hands("mousedown", 3)
    display.hands("mousemove_relative", "--", 60, 20)
    display.hands("mouseup", 3)
    check(xwindow.difference(walked, settled(display)) > 2, "the right button looks around")
    display.hands("key", "1")
    time.sleep(1)
    back = settled(display)
    check(xwindow.difference(first, back) < 1, "1 goes back to the camera of the file")
    display.hands("type", "]]]")
    check(xwindow.difference(back, settled(display)) > 5, "] makes the picture brighter")
    check(program.end(signal.SIGTERM) == 0, "SIGTERM ends it with exit code 0")
    check(program.said() == "", "and without a word: " + program.said())


def main():
    without_a_display()
    missing = xwindow.missing()
    if missing:
        print(f"skipped: no {', '.join(missing)} (scripts/deps installs them)")
        sys.exit(SKIPPED)
    with xwindow.Display() as display:
        walk(display)
        program = opened(display, SCENES / "cornell.usda")
        display.hands("key", "ctrl+q")
        check(program.wait() == 0, "Ctrl+Q ends it with exit code 0")


if __name__ == "__main__":
    main()
