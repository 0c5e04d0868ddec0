"""Cages of the gallery's sculptures: closed meshes of 50 to 500 faces plus their creases.

Each builder returns (part, creases) in a local frame with z up, about its own foot.
"""

import math

from . import vec
from .part import Part, stack
from .subdivision import subdivide


def swept_loop(centre_line, section, shift=0):
    """Closed tube: section(k) gives the ring of points at station k; shift joins the last ring to
    the first turned by that many points (a Moebius band has half its section as shift)."""
    n, m = centre_line, len(section(0))
    points = [p for k in range(n) for p in section(k)]
    faces = []
    for k in range(n):
        turn = shift if k == n - 1 else 0
        for i in range(m):
            j = (i + 1) % m
            a, b = k * m + i, k * m + j
            c, d = (k + 1) % n * m + (j + turn) % m, (k + 1) % n * m + (i + turn) % m
            faces.append((a, b, c, d))
    part = Part(points, faces)
    return part if part.volume() > 0 else part.reversed()


def torus_knot(p=2, q=3, radius=0.5, pipe=0.19, thickness=0.105, stations=54, sides=5):
    """(p, q) knot on a torus standing upright; its section is an oval."""
    def curve(t):
        a, b = p * t, q * t
        r = radius + pipe * math.cos(b)
        return (r * math.cos(a), pipe * 1.15 * math.sin(b), r * math.sin(a))

    def section(k):
        t = 2 * math.pi * k / stations
        e = 1e-4
        c = curve(t)
        along = vec.unit(vec.sub(curve(t + e), curve(t - e)))
        core = (radius * math.cos(p * t), 0, radius * math.sin(p * t))
        out = vec.sub(c, core)
        u = vec.unit(vec.sub(out, vec.mul(along, vec.dot(out, along))))
        v = vec.cross(along, u)
        ring = []
        for i in range(sides):
            a = 2 * math.pi * i / sides
            ring.append(vec.add(c, vec.add(vec.mul(u, thickness * 0.85 * math.cos(a)),
                                           vec.mul(v, thickness * 1.15 * math.sin(a)))))
        return ring
    return swept_loop(stations, section), []


def twisted_column(height=2.2, radius=0.30, layers=14, twist=240):
    """Quatrefoil shaft that turns as it rises; four ridges are semi-sharp, the ends are sharp."""
    rings = []
    for k in range(layers + 1):
        t = k / layers
        swell = 1 - 0.28 * math.sin(math.pi * t) + 0.10 * (1 - t)
        ring = []
        for i in range(8):
            a = math.radians(45 * i + twist * t)
            r = radius * swell * (1.0 if i % 2 == 0 else 0.50)
            ring.append((r * math.cos(a), r * math.sin(a), height * t))
        rings.append(ring)
    part = stack(rings)
    creases = [([k * 8 + i for k in range(layers + 1)], 3.5) for i in range(0, 8, 2)]
    for ring in (0, layers):
        creases.append(([ring * 8 + i for i in range(8)] + [ring * 8], 10))
    return part, creases


def head(height=0.62, columns=16):
    """Abstract head on a neck: an egg with a sharp nose ridge, brow and hollow eyes; faces -y."""
    profile = ((0.000, 0.34, 0.00), (0.10, 0.29, 0.00), (0.20, 0.28, 0.02), (0.27, 0.34, 0.10),
               (0.33, 0.46, 0.14), (0.41, 0.52, 0.11), (0.49, 0.56, 0.06), (0.57, 0.60, 0.02),
               (0.66, 0.63, 0.00), (0.76, 0.64, -0.03), (0.86, 0.56, -0.05), (0.94, 0.38, -0.05))
    rings = []
    for row, (t, r, forward) in enumerate(profile):
        ring = []
        for i in range(columns):
            a = 2 * math.pi * i / columns - math.pi / 2      # i = 0 looks along -y
            x = r * 0.80 * math.cos(a)
            y = r * math.sin(a) - forward
            from_front = min(i, columns - i)
            if from_front == 0:                              # nose: out from brow to tip
                y -= {5: 0.02, 6: 0.22, 7: 0.13, 8: 0.07}.get(row, 0.0)
            elif from_front == 1:
                y += {7: 0.05, 6: 0.02}.get(row, 0.0)
                x *= {6: 0.75, 7: 0.7, 8: 0.8}.get(row, 1.0)
            elif from_front == 2:                            # eye hollows below the brow
                y += {7: 0.10, 6: 0.03, 8: -0.05}.get(row, 0.0)
            elif from_front == 4 and row in (6, 7):          # ears, only hinted at
                x *= 1.10
            ring.append((x, y, 2 * t))
        rings.append(ring)
    rings.append([(0, 0.05, 2.0)])
    part = stack(rings).mapped(lambda p: vec.mul(p, height / 2))
    nose = [row * columns for row in (6, 7, 8)]
    brow = [8 * columns + i for i in (columns - 3, columns - 2, columns - 1, 0, 1, 2, 3)]
    foot = [i for i in range(columns)] + [0]
    return part, [(nose, 3), (brow, 1.5), (foot, 10)]


def moebius(radius=0.55, width=0.30, thickness=0.07, stations=36, half_twists=3):
    """Band of rectangular section with an odd number of half twists; its edge is semi-sharp."""
    def section(k):
        a = 2 * math.pi * k / stations
        turn = half_twists * a / 2
        out = (math.cos(a), 0, math.sin(a))
        ring = []
        for sx, sy in ((1, 1), (-1, 1), (-1, -1), (1, -1)):
            u, v = sx * width / 2, sy * thickness / 2
            r = u * math.cos(turn) - v * math.sin(turn)
            y = u * math.sin(turn) + v * math.cos(turn)
            ring.append(vec.add(vec.mul(out, radius + r), (0, y, 0)))
        return ring
    part = swept_loop(stations, section, shift=2)
    # Going round once leads from each long edge to the opposite one: two loops of double length.
    creases = []
    for i in (0, 1):
        path = [k * 4 + i for k in range(stations)] + [k * 4 + (i + 2) % 4 for k in range(stations)]
        creases.append((path + [i], 2))
    return part, creases


def bloom(height=0.75, lobes=6):
    """Hollow vessel whose wall opens into petals; the rim is semi-sharp."""
    n = lobes * 3
    outside = ((0.0, 0.13, 0.0), (0.06, 0.17, 0.0), (0.25, 0.27, 0.02), (0.50, 0.30, 0.05),
               (0.72, 0.26, 0.10), (0.90, 0.30, 0.17), (1.0, 0.40, 0.24))
    inside = ((0.985, 0.36, 0.24), (0.88, 0.26, 0.17), (0.70, 0.22, 0.10), (0.48, 0.25, 0.05),
              (0.26, 0.22, 0.02), (0.12, 0.12, 0.0))
    rings = []
    for t, r, wave in outside + inside:
        ring = []
        for i in range(n):
            a = 2 * math.pi * i / n + 0.5 * t
            w = 1 + wave * math.cos(lobes * 2 * math.pi * i / n)
            ring.append((r * w * math.cos(a), r * w * math.sin(a),
                         height * (t + 0.25 * wave * t * math.cos(lobes * 2 * math.pi * i / n))))
        rings.append(ring)
    part = stack(rings)
    rim = [(len(outside) - 1) * n + i for i in range(n)]
    return part, [(list(range(n)) + [0], 10), (rim + rim[:1], 1.5)]


def standing(sculpture, gap=0.0):
    """The cage moved so that its smooth surface, not the cage, rests on z = gap."""
    part, creases = sculpture
    low = min(p[2] for p in subdivide(part, creases, 3).points)
    part = part.moved(z=gap - low)
    return Part([tuple(round(c, 4) + 0.0 for c in p) for p in part.points], part.faces), creases
