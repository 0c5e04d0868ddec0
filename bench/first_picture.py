#!/usr/bin/env python3
"""How long it takes from the start of the walkthrough to its first picture, in a real window.

Usage: bench/first_picture.py PROGRAM SCENE... [--settle]
PROGRAM is penumbra of a release build. Each scene is shown on a display of its own (Xvfb, 1280 x 720);
what is there after how many seconds is read off its pixels and the window's title: the window, a
picture of the scene (not lit yet), light on all of it. --settle waits until the light has settled
and prints the memory of the window's process and of the radiosity process beside it [MB]."""
import pathlib
import sys
import tempfile
import time

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent / "tests" / "system"))
import xwindow  # noqa: E402

PATIENCE = 300  # [s]
COLOURS = 24    # so many different ones in the middle of the display are a picture


def colours(rows):
    """Different colours in the middle third of a display, on a coarse grid."""
    height, width = len(rows), len(rows[0]) // 3
    return len({rows[y][3 * x:3 * x + 3] for y in range(height // 3, 2 * height // 3, 6)
                for x in range(width // 3, 2 * width // 3, 8)})


def memory(process):
    """Resident memory of a process [MB]: now, at most."""
    lines = pathlib.Path(f"/proc/{process}/status").read_text().splitlines()
    kilobytes = {line.split(":")[0]: line.split()[1] for line in lines if line.startswith("Vm")}
    return int(kilobytes["VmRSS"]) // 1000, int(kilobytes["VmHWM"]) // 1000


def look(program, scene, settle):
    """Starts the walkthrough once; prints what is there when."""
    with xwindow.Display(1280, 720) as display, tempfile.TemporaryDirectory() as folder:
        environment = dict(display.environment, XDG_CONFIG_HOME=folder)
        start = time.monotonic()
        view = xwindow.Program([program, "view", scene], environment, folder + "/log", folder)

        def since(holds):
            while not holds() and time.monotonic() - start < PATIENCE:
                if view.process.poll() is not None:
                    sys.exit(view.said())
                time.sleep(0.01)
            return time.monotonic() - start

        def title():
            return display.hands("search", "--name", "Penumbra", "getwindowname")

        window = since(lambda: colours(display.pixels()) > 1)
        picture = since(lambda: colours(display.pixels()) >= COLOURS)
        print(f"{pathlib.Path(scene).name}: window {window:.2f} s, picture {picture:.2f} s", end="")
        if settle:
            settled = since(lambda: title() and "(" not in title())
            children = pathlib.Path(f"/proc/{view.process.pid}/task/{view.process.pid}/children")
            others = children.read_text().split()
            print(f", settled {settled:.1f} s; memory {memory(view.process.pid)} MB, "
                  f"radiosity {[memory(other) for other in others]} MB", end="")
        print()
        view.end()


def main():
    arguments = [word for word in sys.argv[1:] if word != "--settle"]
    if len(arguments) < 2 or xwindow.missing():
        sys.exit(__doc__)
    program = str(pathlib.Path(arguments[0]).resolve())
    for scene in arguments[1:]:
        look(program, str(pathlib.Path(scene).resolve()), "--settle" in sys.argv)


if __name__ == "__main__":
    main()
