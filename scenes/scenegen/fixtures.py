"""Lamps that hang, stand or sit in a ceiling, and the parts of a room's shell."""

from . import vec
from .part import box, cylinder, lathe, slab, tube


def ceiling_panel(obj, w, d, nits, kelvin, drop=0.0, depth=0.045, rim=0.012, name="Panel"):
    """Flat lamp; local z = 0 is the ceiling. A white tray with a raised rim; the light fills it.

    The RectLight lies 2 mm below the tray's floor and 4 mm inside its rim: it emits downward from
    within the housing and its own back is hidden.
    """
    z1, z0 = -drop, -drop - depth
    obj.add("WhiteMetal", box((-w / 2 - rim, -d / 2 - rim, z0), (w / 2 + rim, d / 2 + rim, z1)))
    low = z0 - 0.006
    for x0, y0, x1, y1 in ((-w / 2 - rim, -d / 2 - rim, w / 2 + rim, -d / 2),
                           (-w / 2 - rim, d / 2, w / 2 + rim, d / 2 + rim),
                           (-w / 2 - rim, -d / 2, -w / 2, d / 2),
                           (w / 2, -d / 2, w / 2 + rim, d / 2)):
        obj.add("WhiteMetal", box((x0, y0, low), (x1, y1, z0)))
    if drop:
        for x in (-w / 2 + 0.1, w / 2 - 0.1):
            obj.add("Steel", tube([(x, 0, z1), (x, 0, -0.02)], 0.0025, 4),
                    cylinder(0.03, -0.02, 0, 12).moved(x, 0))
    obj.light("RectLight", name, (0, 0, z0 - 0.002), nits,
              {"width": w - 0.004, "height": d - 0.004}, kelvin)
    return obj


def floor_lamp(obj, height=1.72, nits=20000, kelvin=2700):
    """Uplighter: round foot, pole, bowl; the disk in the bowl shines at the ceiling."""
    obj.add("DarkSteel", lathe([(0.14, 0), (0.14, 0.012), (0.13, 0.02), (0.014, 0.028)], 20),
            cylinder(0.011, 0.028, height - 0.10, 10))
    obj.add("Brass", lathe([(0.012, height - 0.10), (0.075, height - 0.085), (0.165, height),
                            (0.162, height), (0.07, height - 0.078)], 24))
    obj.light("DiskLight", "Bulb", (0, 0, height - 0.060), nits, {"radius": 0.07}, kelvin,
              tilt=(180, 0, 0))
    return obj


def spot(obj, heading, down, nits, kelvin, radius=0.05):
    """Can spot on a short stem below the ceiling (local z = 0), aimed heading/down [degrees]."""
    obj.add("WhiteMetal", cylinder(0.045, -0.03, 0, 14), cylinder(0.012, -0.16, -0.03, 8))
    at = (0, 0, -0.26)
    r = radius + 0.012
    shell = lathe([(radius + 0.004, 0.03), (radius + 0.004, -0.09), (r, -0.09), (r, 0.075),
                   (r * 0.6, 0.10)], 18)
    def aim(p):
        return vec.rotate(vec.rotate(p, "x", 90 - down), "z", heading - 90)
    obj.add("WhiteMetal", shell.mapped(aim).moved(*at))
    bulb = vec.add(at, aim((0, 0, 0.02)))
    obj.light("DiskLight", "Bulb", bulb, nits, {"radius": radius}, kelvin,
              tilt=(90 - down, 0, heading - 90))
    return obj


def wall_with_hole(x0, x1, z0, z1, hole):
    """Four rectangles (x, z) around a hole given as (x0, x1, z0, z1); sharing no overlap."""
    a, b, c, d = hole
    pieces = [(x0, a, z0, z1), (b, x1, z0, z1), (a, b, z0, c), (a, b, d, z1)]
    return [p for p in pieces if p[1] - p[0] > 1e-6 and p[3] - p[2] > 1e-6]


def window(obj, w, h, depth, panes=3):
    """Window in a recess: local origin is the middle of its lower edge on the wall plane y = 0,
    the room is at -y, the glass at y = depth. Frame, mullions, a sill board, a half-drawn blind."""
    t, front = 0.05, depth - 0.05
    obj.add("FrameWhite", box((-w / 2, front, 0), (w / 2, depth, t)),
            box((-w / 2, front, h - t), (w / 2, depth, h)),
            box((-w / 2, front, t), (-w / 2 + t, depth, h - t)),
            box((w / 2 - t, front, t), (w / 2, depth, h - t)))
    for k in range(1, panes):
        x = -w / 2 + w * k / panes
        obj.add("FrameWhite", box((x - t / 2, front, t), (x + t / 2, depth, h - t)))
    # The transom's pieces fit between the uprights.
    edges = [-w / 2 + t] + [e for k in range(1, panes) for e in
                            (-w / 2 + w * k / panes - t / 2,
                             -w / 2 + w * k / panes + t / 2)] + [w / 2 - t]
    for k in range(panes):
        obj.add("FrameWhite", box((edges[2 * k], front, h * 0.74),
                                  (edges[2 * k + 1], depth, h * 0.74 + 0.04)))
    obj.add("Birch", box((-w / 2 - 0.05, -0.06, -0.03), (w / 2 + 0.05, 0, 0)))
    return obj


def blind(obj, w, drop, slats=12, tilt=28):
    """Venetian blind: head rail at local z = 0, slats below, hung at y = 0."""
    obj.add("WhiteMetal", box((-w / 2, -0.02, -0.03), (w / 2, 0.02, 0)))
    step = (drop - 0.06) / slats
    for k in range(slats):
        z = -0.04 - step * (k + 0.5)
        slat = box((-w / 2 + 0.005, -0.0125, -0.0006), (w / 2 - 0.005, 0.0125, 0.0006))
        obj.add("WhiteMetal", slat.turned("x", tilt).moved(z=z))
    obj.add("WhiteMetal", box((-w / 2 + 0.005, -0.013, -drop),
                              (w / 2 - 0.005, 0.013, -drop + 0.014)))
    for x in (-w * 0.36, w * 0.36):
        obj.add("WhiteMetal", box((x - 0.001, -0.0165, -drop + 0.005), (x + 0.001, -0.0145, -0.03)))
    return obj


def door(obj, w=0.9, h=2.05, leaf="DoorPaint"):
    """Closed door on the wall y = 0, room at -y: frame, leaf with two raised panels, handle."""
    a = 0.07
    obj.add("FrameWhite", box((-w / 2 - a, -0.022, 0), (-w / 2, 0, h)),
            box((w / 2, -0.022, 0), (w / 2 + a, 0, h)),
            box((-w / 2 - a, -0.022, h), (w / 2 + a, 0, h + a)))
    obj.add(leaf, box((-w / 2 + 0.003, -0.012, 0.006), (w / 2 - 0.003, 0, h - 0.003)))
    for z0, z1 in ((0.20, 0.92), (1.12, 1.88)):
        panel = slab(w - 0.28, z1 - z0, 0.008, 0.004, 1, edge=0.0035).turned("x", 90)
        obj.add(leaf, panel.moved(0, -0.012, (z0 + z1) / 2))
    x = -w / 2 + 0.07
    obj.add("Steel", box((x - 0.02, -0.017, 0.93), (x + 0.02, -0.012, 1.11)))
    obj.add("Steel", tube([(x, -0.017, 1.03), (x, -0.062, 1.03), (x + 0.115, -0.062, 1.03)], 0.009,
                          8))
    return obj


def radiator(obj, w=1.4, h=0.55, fins=22):
    """Panel radiator with vertical ribs, on brackets before the wall y = 0."""
    y0, y1, z0 = -0.09, -0.04, 0.14
    obj.add("WhiteMetal", box((-w / 2, y0, z0), (w / 2, y1, z0 + h)))
    for k in range(fins):
        x = -w / 2 + 0.03 + (w - 0.06) * (k + 0.5) / fins
        obj.add("WhiteMetal", box((x - 0.011, y0 - 0.010, z0 + 0.03),
                                  (x + 0.011, y0, z0 + h - 0.03)))
    for x in (-w / 2 + 0.15, w / 2 - 0.15):
        obj.add("WhiteMetal", box((x - 0.015, y1, z0 + 0.1), (x + 0.015, 0, z0 + h - 0.1)))
    obj.add("Steel", tube([(w / 2 + 0.04, -0.065, 0), (w / 2 + 0.04, -0.065, 0.20),
                           (w / 2, -0.065, 0.20)], 0.009, 8))
    return obj
