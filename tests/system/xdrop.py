"""Drops a file on a window, as a file manager does: the source's side of XDND 5, by libX11."""
import ctypes
import pathlib
import select
import sys
import time

# https://www.freedesktop.org/wiki/Specifications/XDND/
CLIENT_MESSAGE, SELECTION_REQUEST, SELECTION_NOTIFY = 33, 30, 31
COPY_TIME, REPLACE = 0, 0


class Event(ctypes.Union):
    """An XEvent: fields of the events used here, in machine words (64-bit Xlib)."""
    _fields_ = [("type", ctypes.c_int), ("words", ctypes.c_long * 24)]


class Source:
    """An X client that offers one file."""

    def __init__(self, file):
        self.x = ctypes.CDLL("libX11.so.6")
        self.x.XOpenDisplay.restype = ctypes.c_void_p
        for name, result in (("XDefaultRootWindow", ctypes.c_ulong), ("XInternAtom", ctypes.c_ulong),
                             ("XCreateSimpleWindow", ctypes.c_ulong)):
            getattr(self.x, name).restype = result
        self.display = ctypes.c_void_p(self.x.XOpenDisplay(None))
        if not self.display:
            sys.exit("no display")
        root = ctypes.c_ulong(self.x.XDefaultRootWindow(self.display))
        self.window = self.x.XCreateSimpleWindow(self.display, root, 0, 0, 1, 1, 0,
                                                 ctypes.c_ulong(0), ctypes.c_ulong(0))
        self.list = (pathlib.Path(file).resolve().as_uri() + "\r\n").encode()
        self.x.XSetSelectionOwner(self.display, self.atom("XdndSelection"),
                                  ctypes.c_ulong(self.window), ctypes.c_ulong(COPY_TIME))

    def atom(self, name):
        return ctypes.c_ulong(self.x.XInternAtom(self.display, name.encode(), 0))

    def send(self, window, event):
        self.x.XSendEvent(self.display, ctypes.c_ulong(window), 0, ctypes.c_long(0),
                          ctypes.byref(event))
        self.x.XFlush(self.display)

    def say(self, target, name, *data):
        event = Event()
        event.type = CLIENT_MESSAGE
        words = [target, self.atom(name).value, 32, self.window, *data]
        for i, word in enumerate(words):
            event.words[4 + i] = word
        self.send(target, event)

    def answer(self, request):
        """Hands the list of files to who asks for it."""
        requestor, selection, target, prop = request.words[5:9]
        self.x.XChangeProperty(self.display, ctypes.c_ulong(requestor), ctypes.c_ulong(prop),
                               ctypes.c_ulong(target), 8, REPLACE, self.list, len(self.list))
        event = Event()
        event.type = SELECTION_NOTIFY
        for i, word in enumerate((requestor, selection, target, prop, request.words[9])):
            event.words[4 + i] = word
        self.send(requestor, event)

    def finished(self, seconds):
        """Serves until the target says XdndFinished; whether it did."""
        end, done = time.monotonic() + seconds, self.atom("XdndFinished").value
        while time.monotonic() < end:
            if not self.x.XPending(self.display):
                select.select([self.x.XConnectionNumber(self.display)], [], [], 0.1)
                continue
            event = Event()
            self.x.XNextEvent(self.display, ctypes.byref(event))
            if event.type == SELECTION_REQUEST:
                self.answer(event)
            if event.type == CLIENT_MESSAGE and event.words[5] == done:
                return True
        return False


def main():
    """Usage: xdrop.py WINDOW X Y FILE, on the display of $DISPLAY."""
    window, x, y = map(int, sys.argv[1:4])
    source = Source(sys.argv[4])
    uris, copy = source.atom("text/uri-list").value, source.atom("XdndActionCopy").value
    source.say(window, "XdndEnter", 5 << 24, uris, 0, 0)
    source.say(window, "XdndPosition", 0, x << 16 | y, 0, copy)
    time.sleep(0.2)
    source.say(window, "XdndDrop", 0, 0, 0, 0)
    sys.exit(0 if source.finished(20) else "nobody took the file")


if __name__ == "__main__":
    main()
