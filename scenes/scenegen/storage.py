"""Bookcases and their books, plants, bins, pictures and other things of a room."""

import math

from . import vec
from .part import ball, box, cylinder, lathe, sheet, tube

BOOK_COLOURS = ("BookRed", "BookBlue", "BookGreen", "BookOchre", "BookCream", "BookGrey")


def bookcase(obj, rng, width=0.9, height=2.0, depth=0.32, shelves=5, wood="Walnut", fill=0.86):
    """Open case, back against the wall at y = 0, front towards -y; books on every shelf."""
    t = 0.022
    obj.add(wood, box((-width / 2, -depth, 0), (-width / 2 + t, 0, height)),
            box((width / 2 - t, -depth, 0), (width / 2, 0, height)),
            box((-width / 2 + t, -0.008, 0.07), (width / 2 - t, 0, height - t)),
            box((-width / 2 + t, -depth, height - t), (width / 2 - t, 0, height)),
            box((-width / 2 + t, -depth + 0.03, 0), (width / 2 - t, -depth + 0.045, 0.07)))
    pitch = (height - t - 0.07) / shelves
    for k in range(shelves):
        z = 0.07 + k * pitch
        obj.add(wood, box((-width / 2 + t, -depth + 0.002, z), (width / 2 - t, -0.008, z + t)))
        books(obj, rng, -width / 2 + t + 0.004, width / 2 - t - 0.004, z + t, pitch - t - 0.03,
              -0.012, depth - 0.05, fill)
    return obj


def books(obj, rng, x0, x1, z, headroom, y_back, depth, fill):
    """A row of books from x0 on; a lying pile or a leaning book now and then."""
    x, end = x0, x0 + (x1 - x0) * min(1.0, fill + rng.uniform(-0.12, 0.14))
    last = rng.choice(BOOK_COLOURS)
    while True:
        w = rng.choice((0.024, 0.028, 0.034, 0.04, 0.046, 0.055))
        if x + w > end:
            break
        if rng.random() < 0.07 and x + 0.21 < end:      # a lying pile
            top = z
            for _ in range(rng.randint(2, 4)):
                h = rng.choice((0.02, 0.028, 0.035))
                l = rng.uniform(0.17, 0.2)
                obj.add(rng.choice(BOOK_COLOURS),
                        box((x, y_back - 0.2, top), (x + l, y_back - 0.02, top + h)))
                top += h
            x += 0.205
            continue
        h = min(headroom, rng.uniform(0.19, 0.30))
        d = min(depth, rng.uniform(0.15, 0.24))
        front = rng.uniform(0.0, 0.02)
        if rng.random() < 0.55:
            last = rng.choice(BOOK_COLOURS)               # runs of one series look real
        obj.add(last, box((x, y_back - front - d, z), (x + w, y_back - front, z + h)))
        x += w + 0.0006
    lean = rng.uniform(9, 15)
    h, w = min(headroom, 0.24) * 0.92, 0.024
    # A last book leaning on the row: its lower left corner stands on the shelf.
    reach = h * math.sin(math.radians(lean)) + w
    if x + reach + 0.01 < x1:
        book = box((0, 0, 0), (w, 0.17, h)).turned("y", -lean)
        low = min(p[2] for p in book.points)
        left = min(p[0] for p in book.points)
        obj.add(rng.choice(BOOK_COLOURS), book.moved(x - left + 0.0006, y_back - 0.19, z - low))


def leaf(length, width, droop, segments=3, fold=18):
    """One leaf from the origin along +x: two halves folded upward along a drooping midrib."""
    spine, left, right = [], [], []
    outline = {3: (0.0, 0.85, 0.9, 0.0), 4: (0.0, 0.7, 1.0, 0.72, 0.0),
               2: (0.0, 1.0, 0.0)}[segments]
    x = z = angle = 0.0
    for k in range(segments + 1):
        half = width / 2 * outline[k]
        rise = half * math.sin(math.radians(fold))
        spine.append((x, 0, z))
        side = half * math.cos(math.radians(fold))
        left.append((x, side, z + rise))
        right.append((x, -side, z + rise))
        angle -= droop / segments
        x += length / segments * math.cos(math.radians(angle))
        z += length / segments * math.sin(math.radians(angle))
    polygons = []
    for k in range(segments):
        for side, sign in ((left, 1), (right, -1)):
            ring = [spine[k], spine[k + 1], side[k + 1], side[k]]
            ring = [p for i, p in enumerate(ring) if p != ring[i - 1]]
            polygons.append(ring if sign > 0 else ring[::-1])
    return sheet(*polygons)


def floor_plant(obj, rng, height=1.5, leaves=30):
    """Rubber-plant like: three bent stems with large leaves in a clay pot."""
    pot(obj, 0.19, 0.15, 0.34, 16)
    stems = []
    for k in range(3):
        heading = 120 * k + rng.uniform(-20, 20)
        lean = rng.uniform(0.10, 0.26)
        top = height * (1.0, 0.82, 0.68)[k]
        path = [vec.rotate((0.03, 0, 0.30), "z", heading),
                vec.rotate((0.03 + lean * 0.35, 0, 0.30 + (top - 0.30) * 0.5), "z", heading),
                vec.rotate((0.03 + lean, 0, top), "z", heading)]
        obj.add("Stem", tube(path, [0.012, 0.009, 0.004], 6))
        stems.append(path)
    for k in range(leaves):
        path = stems[k % 3]
        t = 0.22 + 0.78 * (k // 3) / (leaves / 3)
        low, high, s = (path[0], path[1], t * 2) if t < 0.5 else (path[1], path[2], t * 2 - 1)
        on = vec.lerp(low, high, min(1, s))
        up = 18 + 45 * t + rng.uniform(-8, 8)
        blade = leaf(rng.uniform(0.20, 0.30), rng.uniform(0.10, 0.14), rng.uniform(45, 85), 3)
        blade = blade.turned("y", -up).turned("z", 137.5 * k + rng.uniform(-12, 12))
        obj.add("Leaf", blade.moved(*on), double_sided=True)
    return obj


def pot(obj, r_top, r_bottom, h, n, material="Terracotta"):
    rim = 0.018
    obj.add(material, lathe([(r_bottom, 0), (r_top - 0.01, h - 0.05), (r_top, h - 0.05), (r_top, h),
                             (r_top - rim, h), (r_top - rim - 0.012, h - 0.06)], n))
    obj.add("Soil", sheet([vec.rotate((r_top - rim - 0.0095, 0, h - 0.045), "z", 360 * i / n)
                           for i in range(n)]))


def blade_plant(obj, rng, blades=9, height=0.42):
    """Snake plant: stiff upright blades in a white pot."""
    pot(obj, 0.085, 0.065, 0.15, 14, "ChinaWhite")
    for k in range(blades):
        a = 137.5 * k
        r = 0.012 + 0.038 * k / blades
        h = height * rng.uniform(0.65, 1.0)
        blade = leaf(h, 0.045, rng.uniform(4, 16), 4, fold=12)
        blade = blade.turned("y", -(86 - 22 * k / blades)).turned("z", a)
        obj.add("LeafPale" if k % 3 == 0 else "Leaf",
                blade.moved(*vec.rotate((r, 0, 0.104), "z", a)), double_sided=True)
    return obj


def bin_basket(obj, material="DarkSteel", n=14):
    obj.add(material, lathe([(0.11, 0), (0.145, 0.32), (0.150, 0.32), (0.150, 0.33), (0.140, 0.33),
                             (0.106, 0.006)], n))
    return obj


def crumpled(rng, r):
    """A ball of paper: an octahedral lump, resting on z = 0."""
    def dent(p):
        return vec.mul(p, 1 + 0.18 * math.sin(91 * p[0] + 57 * p[1] + 73 * p[2]))
    part = ball(r, 6, 4).mapped(dent)
    low = min(p[2] for p in part.points)
    return part.moved(z=-low)


def picture(obj, rng, w, h, frame, palette, cells=8):
    """Framed painting on a wall at y = 0, seen from -y: a rectangle cut up Mondrian's way.

    The canvas is a box; its front is tiled, 1 mm before it, by single-sided colour fields.
    """
    t, d = 0.025, 0.028
    for x0, z0, x1, z1 in ((-w / 2, -h / 2, w / 2, -h / 2 + t), (-w / 2, h / 2 - t, w / 2, h / 2),
                           (-w / 2, -h / 2 + t, -w / 2 + t, h / 2 - t),
                           (w / 2 - t, -h / 2 + t, w / 2, h / 2 - t)):
        obj.add(frame, box((x0, -d, z0), (x1, 0, z1)))
    obj.add("Paper", box((-w / 2 + t, -0.010, -h / 2 + t), (w / 2 - t, 0, h / 2 - t)))
    fields = [(-w / 2 + t + 0.05 * w, -h / 2 + t + 0.05 * h, w / 2 - t - 0.05 * w,
               h / 2 - t - 0.05 * h)]
    while len(fields) < cells:
        fields.sort(key=lambda f: (f[2] - f[0]) * (f[3] - f[1]))
        x0, z0, x1, z1 = fields.pop()
        cut = rng.uniform(0.32, 0.68)
        if (x1 - x0) > (z1 - z0) * rng.uniform(0.8, 1.2):
            m = x0 + (x1 - x0) * cut
            fields += [(x0, z0, m, z1), (m, z0, x1, z1)]
        else:
            m = z0 + (z1 - z0) * cut
            fields += [(x0, z0, x1, m), (x0, m, x1, z1)]
    for x0, z0, x1, z1 in fields:
        obj.add(rng.choice(palette), sheet([(x0, -0.011, z0), (x1, -0.011, z0), (x1, -0.011, z1),
                                            (x0, -0.011, z1)]))
    return obj


def wall_clock(obj, r=0.16):
    """Round clock on the wall y = 0: rim, face, hands at ten past ten."""
    def upright(part):
        return part.turned("x", 90)
    obj.add("DarkSteel", upright(lathe([(r, 0), (r, 0.035), (r - 0.012, 0.035),
                                        (r - 0.012, 0.012)], 28)))
    obj.add("Paper", upright(sheet([vec.rotate((r - 0.0125, 0, 0.0135), "z", 360 * i / 28)
                                    for i in range(28)])))
    for hour in range(0, 12, 3):
        mark = box((-0.003, r - 0.034, 0.0136), (0.003, r - 0.020, 0.0150)).turned("z", 30 * hour)
        obj.add("Ink", upright(mark))
    obj.add("Ink", upright(box((-0.005, -0.015, 0.0165), (0.005, 0.085, 0.0180)).turned("z", 55)),
            upright(box((-0.0035, -0.02, 0.0190), (0.0035, 0.118, 0.0205)).turned("z", -60)),
            upright(cylinder(0.009, 0.0140, 0.0240, 8)))
    return obj


def globe(obj, r=0.11):
    obj.add("Walnut", lathe([(0.07, 0), (0.07, 0.012), (0.02, 0.022), (0.012, 0.05)], 12))
    obj.add("Ocean", ball(r, 14, 9, (0, 0, 0.05 + r)))
    return obj
