"""Desks and what stands on them. Local frames: the user sits on the -y side, looking along +y."""

import math

from . import vec
from .part import block, box, cylinder, lathe, prism, sheet, slab, stack, tube

DESK_TOP = 0.74   # height of a desk's writing surface [m]


def desk(obj, width=1.6, depth=0.8, drawers=1):
    """Top on two trestle frames; drawers: +1 pedestal on the right, -1 left, 0 none."""
    obj.add("Birch", slab(width, depth, 0.026, 0.03, 3, edge=0.003).moved(z=DESK_TOP - 0.026))
    under = DESK_TOP - 0.026
    for side in (-1, 1):
        x = side * (width / 2 - 0.09)
        y = depth / 2 - 0.09
        for ys in (-y, y):
            obj.add("DarkSteel", block((x, ys, 0.012), (0.045, 0.045, under - 0.052)))
            obj.add("BlackPlastic", cylinder(0.02, 0, 0.012, 6).moved(x, ys))
        obj.add("DarkSteel", box((x - 0.0225, -y - 0.0225, under - 0.04),
                                 (x + 0.0225, y + 0.0225, under)))
    reach = width / 2 - 0.09 - 0.0225
    obj.add("DarkSteel", box((-reach, depth / 2 - 0.11, under - 0.06),
                             (reach, depth / 2 - 0.08, under - 0.01)))
    obj.add("GreyPlastic", box((-reach * 0.75, depth / 2 - 0.20, under - 0.09),
                               (reach * 0.75, depth / 2 - 0.115, under - 0.02)))   # cable tray
    if drawers:
        pedestal(obj, drawers * (width / 2 - 0.34), -0.03)
    return obj


def pedestal(obj, x, y):
    """Rolling drawer unit: carcass, three fronts with bar handles, four feet."""
    w, d, z0, z1 = 0.40, 0.54, 0.04, 0.60
    obj.add("WhiteMetal", box((x - w / 2, y - d / 2, z0), (x + w / 2, y + d / 2, z1)))
    heights = (0.12, 0.16, 0.25)
    z = z1 - 0.008
    for h in heights:
        front = y - d / 2
        obj.add("Oak", box((x - w / 2 + 0.004, front - 0.016, z - h),
                           (x + w / 2 - 0.004, front, z)))
        obj.add("Steel", box((x - 0.06, front - 0.030, z - 0.034),
                             (x + 0.06, front - 0.016, z - 0.026)))
        z -= h + 0.006
    for sx in (-1, 1):
        for sy in (-1, 1):
            obj.add("BlackPlastic", cylinder(0.018, 0, z0, 6)
                    .moved(x + sx * (w / 2 - 0.04), y + sy * (d / 2 - 0.04)))


def monitor(obj, glow=None, w=0.61, h=0.36, stand=0.13):
    """Flat screen on a foot; glow names a luminous material, None is switched off."""
    obj.add("BlackPlastic", slab(0.26, 0.20, 0.010, 0.03, 2))
    obj.add("DarkSteel", box((-0.03, 0.045, 0.010), (0.03, 0.065, stand + 0.22)))
    obj.add("BlackPlastic", box((-0.10, 0.025, stand + 0.10), (0.10, 0.045, stand + 0.24)))
    # The housing is a rounded plate standing upright, screen side towards -y.
    body = slab(w, h, 0.03, 0.012, 1, edge=0.005).turned("x", 90).moved(0, 0.025, stand + h / 2)
    obj.add("BlackPlastic", body)
    y, zc = -0.006, stand + h / 2 + 0.004
    sw, sh = w / 2 - 0.012, h / 2 - 0.014

    def pane(x0, z0, x1, z1, front):
        """Rectangle facing the user, in fractions of the screen."""
        return sheet([(sw * x0, front, zc + sh * z0), (sw * x1, front, zc + sh * z0),
                      (sw * x1, front, zc + sh * z1), (sw * x0, front, zc + sh * z1)])
    obj.add(glow or "Screen", pane(-1, -1, 1, 1, y))
    if glow:
        # A few dark and white panes, a millimetre in front: windows, a side bar, a dock.
        obj.add("Ink", pane(-1, 0.90, 1, 1, y - 0.001), pane(-0.94, -0.80, -0.55, 0.78, y - 0.001))
        for k in range(7):
            length = (0.75, 0.5, 0.62, 0.3, 0.7, 0.45, 0.2)[k]
            top = 0.62 - 0.16 * k
            obj.add("Ink", pane(-0.42, top - 0.05, -0.42 + length, top, y - 0.001))
        obj.add("PaintRed", pane(0.48, 0.30, 0.92, 0.62, y - 0.001))
        obj.add("BookBlue", pane(0.48, -0.75, 0.92, 0.1, y - 0.001))
    return obj


KEY_ROWS = (   # widths in key pitches, from the space bar up; negative is a gap
    (1.25,) * 3 + (6.25,) + (1.25,) * 4 + (-0.25, 1, 1, 1),
    (2.25,) + (1,) * 10 + (2.75, -0.25, -1, 1, -1),
    (1.75,) + (1,) * 11 + (2.25, -3.25),
    (1.5,) + (1,) * 12 + (1.5, -0.25, 1, 1, 1),
    (1,) * 13 + (2, -0.25, 1, 1, 1),
)


def keyboard(obj, caps="GreyPlastic", body="BlackPlastic", compact=False):
    pitch, gap = 0.0186, 0.0028
    columns = 15 if compact else 18.25   # the main block alone, or cursor keys too
    w, d = columns * pitch + 0.016, 5 * pitch + 0.016
    obj.add(body, slab(w, d, 0.014, 0.008, 2))
    for row, widths in enumerate(KEY_ROWS):
        x = -columns * pitch / 2
        y = (row - 2.5) * pitch
        for k in widths:
            size = abs(k) * pitch
            if x + size > columns * pitch / 2 + 1e-6:
                break
            if k > 0:
                x0, x1, y0, y1 = x + gap / 2, x + size - gap / 2, y + gap / 2, y + pitch - gap / 2
                t = 0.0025   # caps taper towards the finger
                obj.add(caps, stack([
                    [(x0, y0, 0.014), (x1, y0, 0.014), (x1, y1, 0.014), (x0, y1, 0.014)],
                    [(x0 + t, y0 + t, 0.021), (x1 - t, y0 + t, 0.021),
                     (x1 - t, y1 - t, 0.021), (x0 + t, y1 - t, 0.021)]]))
            x += size
    return obj


def laptop(obj):
    """A closed notebook computer: base, lid, and the slit between them."""
    obj.add("GreyPlastic", slab(0.32, 0.22, 0.010, 0.012, 2))
    obj.add("Ink", slab(0.31, 0.21, 0.002, 0.010, 1).moved(z=0.010))
    obj.add("GreyPlastic", slab(0.32, 0.22, 0.006, 0.012, 2).moved(z=0.012))
    return obj


def mouse(obj, material="BlackPlastic"):
    body = stack([[(x * s, y * s, z) for x, y in _oval(0.031, 0.055, 14)]
                  for s, z in ((1.0, 0.0), (1.0, 0.010), (0.86, 0.024), (0.5, 0.034))])
    obj.add(material, body)
    return obj


def _oval(a, b, n):
    return [(a * math.cos(2 * math.pi * i / n), b * math.sin(2 * math.pi * i / n))
            for i in range(n)]


def mug(obj, china, filled=True, n=16):
    r, h = 0.040, 0.095
    obj.add(china, lathe([(r - 0.006, 0), (r, 0.008), (r, h), (r - 0.004, h), (r - 0.004, 0.010)],
                         n))
    # The handle's ends lie flat against the wall: it starts at a facet of the cup.
    x = r * math.cos(math.pi / n)
    obj.add(china, tube([(x, 0, 0.075), (x + 0.022, 0, 0.075), (x + 0.028, 0, 0.05),
                         (x + 0.020, 0, 0.025), (x, 0, 0.022)], 0.005, 6).turned("z", 180 / n))
    if filled:
        obj.add("Coffee", sheet([vec.rotate((r - 0.0042, 0, h - 0.02), "z", 360 * i / n)
                                 for i in range(n)]))
    return obj


def desk_lamp(obj, reach=0.30, nits=45000, kelvin=3000, shade="BookGreen"):
    """Jointed lamp; the head hangs reach in front (+x) of the foot and leans back towards it."""
    obj.add("DarkSteel", lathe([(0.085, 0), (0.085, 0.012), (0.078, 0.018), (0.016, 0.022),
                                (0.016, 0.045)], 20))
    foot, elbow, head = (0, 0, 0.062), (-0.14, 0, 0.40), (reach, 0, 0.545)
    for y in (-0.012, 0.012):
        obj.add("Brass", tube([vec.add(foot, (0, y, 0)), vec.add(elbow, (0, y, 0))], 0.005, 6))
        obj.add("Brass", tube([vec.add(elbow, (0, y * 0.5, 0)),
                               vec.add(head, (-0.022, y * 0.5, 0))], 0.005, 6))
    for centre, r in ((foot, 0.017), (elbow, 0.015)):
        knuckle = prism([(r * math.cos(2 * math.pi * i / 12), r * math.sin(2 * math.pi * i / 12))
                         for i in range(12)], -0.020, 0.020, "y")
        obj.add("DarkSteel", knuckle.moved(*centre))
    lean = 14
    at = vec.sub(head, vec.rotate((0, 0, 0.0865), "y", lean))   # the socket sits at the arm's end
    # A spun shade, 1.5 mm thick: from the ceiling inside down, over the rim and up to the neck.
    shell = lathe([(0.028, 0.058), (0.046, 0.040), (0.0965, -0.045), (0.098, -0.045),
                   (0.048, 0.040), (0.030, 0.060), (0.022, 0.075)], 20)
    obj.add(shade, shell.turned("y", lean).moved(*at))
    obj.add("DarkSteel", cylinder(0.016, 0.075, 0.098, 12).turned("y", lean).moved(*at))
    bulb = vec.add(at, vec.rotate((0, 0, 0.030), "y", lean))
    obj.light("DiskLight", "Bulb", bulb, nits, {"radius": 0.042}, kelvin, tilt=(0, lean, 0))
    return obj


def paper_stack(obj, rng, sheets=4, at=(0, 0, 0)):
    """Loose A4 sheets, each 1 mm of a pad, turned a little against each other."""
    z = at[2]
    for _ in range(sheets):
        h = 0.0015 if rng.random() < 0.7 else 0.006
        page = box((-0.105, -0.1485, 0), (0.105, 0.1485, h)).turned("z", rng.uniform(-9, 9))
        obj.add("Paper", page.moved(at[0], at[1], z))
        z += h
    return z


def pen(length=0.14, r=0.0045):
    """Hexagonal pencil lying along x, touching the plane z = 0."""
    part = tube([(0, 0, 0), (length - 0.016, 0, 0), (length, 0, 0)], [r, r, 0.001], 6)
    low = min(p[2] for p in part.points)
    return part.moved(z=-low)


def pencil_cup(obj, rng):
    obj.add("DarkSteel", lathe([(0.038, 0), (0.038, 0.10), (0.035, 0.10), (0.035, 0.004)], 16))
    for k, colour in enumerate(("BookRed", "BookOchre", "BookBlue", "Oak", "BookGreen")):
        a = 72 * k + rng.uniform(-15, 15)
        foot = vec.rotate((0.012, 0, 0.0055), "z", a)
        head = vec.rotate((0.027, 0, 0.10 + 0.0001), "z", a)
        tip = vec.lerp(foot, head, rng.uniform(1.45, 1.75))
        obj.add(colour, tube([foot, tip], 0.0035, 6))
    return obj
