"""A display of its own (Xvfb) with real keyboard and mouse (xdotool), and its pixels."""
import mmap
import os
import pathlib
import shutil
import signal
import struct
import subprocess
import sys
import tempfile
import time

HERE = pathlib.Path(__file__).resolve().parent
TOOLS = ("Xvfb", "xdotool")
SKIPPED = 77  # the exit code that ctest knows


def missing():
    """The tools that are not installed; scripts/deps installs them."""
    return [tool for tool in TOOLS if not shutil.which(tool)]


def prepared(folder):
    """An empty folder for what a test makes; ends it as skipped where tools are missing."""
    if missing():
        print(f"skipped: no {', '.join(missing())} (scripts/deps installs them)")
        sys.exit(SKIPPED)
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir(parents=True)


class Display:
    """An X server without a screen, for as long as the `with` lasts."""

    def __init__(self, width=1280, height=800):
        self.size = (width, height)

    def __enter__(self):
        self.folder = tempfile.TemporaryDirectory(prefix="penumbra-display-")
        reader, writer = os.pipe()
        self.server = subprocess.Popen(
            ["Xvfb", "-displayfd", str(writer), "-screen", "0", "%dx%dx24" % self.size, "-noreset",
             "-nolisten", "tcp", "-fbdir", self.folder.name],
            pass_fds=[writer], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        os.close(writer)
        with os.fdopen(reader) as said:
            number = said.readline().strip()
        if not number:
            raise RuntimeError("Xvfb did not start")
        self.name = ":" + number
        self.environment = dict(os.environ, DISPLAY=self.name, LIBGL_ALWAYS_SOFTWARE="1")
        return self

    def __exit__(self, *_):
        self.server.terminate()
        self.server.wait()
        self.folder.cleanup()

    def hands(self, *words):
        """xdotool with these words; its answer."""
        done = subprocess.run(["xdotool", *map(str, words)], env=self.environment, text=True,
                              capture_output=True, timeout=30)
        time.sleep(0.05)
        return done.stdout.strip()

    def pixels(self):
        """What the display shows: rows of bytes, three a pixel, from the server's own memory."""
        with open(pathlib.Path(self.folder.name) / "Xvfb_screen0", "rb") as file:
            with mmap.mmap(file.fileno(), 0, access=mmap.ACCESS_READ) as data:
                header = struct.unpack(">25I", data[:100])  # of an XWD file
                size, width, height, row = header[0], header[4], header[5], header[12]
                start = size + header[19] * 12
                rows = []
                for y in range(height):
                    line = data[start + y * row:start + y * row + 4 * width]
                    rgb = bytearray(3 * width)
                    rgb[0::3], rgb[1::3], rgb[2::3] = line[2::4], line[1::4], line[0::4]
                    rows.append(bytes(rgb))
                return rows

    def save(self, path):
        """The display as a picture file (PPM)."""
        rows = self.pixels()
        with open(path, "wb") as file:
            file.write(b"P6\n%d %d\n255\n" % (len(rows[0]) // 3, len(rows)))
            file.writelines(rows)


def remember_size(config, width, height):
    """Walkthroughs with this $XDG_CONFIG_HOME open windows of this size, as if the last had been."""
    settings = pathlib.Path(config) / "penumbra/viewer.conf"
    settings.parent.mkdir(parents=True, exist_ok=True)
    others = [line for line in (settings.read_text() if settings.exists() else "").splitlines()
              if not line.startswith(("width", "height"))]
    settings.write_text("\n".join([*others, f"width = {width}", f"height = {height}", ""]))


class Program:
    """A running program; what it says to standard error goes to a file."""

    def __init__(self, arguments, environment, log, folder):
        self.log = pathlib.Path(log)
        with open(self.log, "wb") as out:
            self.process = subprocess.Popen(arguments, env=environment, stdout=out, stderr=out,
                                            cwd=folder)

    def end(self, how=signal.SIGTERM, seconds=60):
        """Asks it to end; its exit code."""
        self.process.send_signal(how)
        return self.wait(seconds)

    def wait(self, seconds=60):
        try:
            return self.process.wait(seconds)
        except subprocess.TimeoutExpired:
            self.process.kill()
            self.process.wait()
            return None

    def said(self):
        return self.log.read_text(errors="replace")


def until(holds, seconds=60, what="it"):
    """Waits until `holds()` is true; its value."""
    end = time.monotonic() + seconds
    while time.monotonic() < end:
        value = holds()
        if value:
            return value
        time.sleep(0.05)
    sys.exit(f"FAILED: waited {seconds} s for {what}")


def difference(a, b):
    """Mean absolute difference of two pictures of one size [8-bit steps]."""
    total = sum(abs(x - y) for p, q in zip(a[::4], b[::4]) for x, y in zip(p[::7], q[::7]))
    return total / sum(len(p[::7]) for p in a[::4])
