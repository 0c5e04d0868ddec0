"""Sculptures grown from unit cubes, which Catmull-Clark subdivision rounds into one body."""

import math

from . import vec
from .part import Part
from .sculptures import standing
from .subdivision import subdivide


def voxel_body(layers, size, bend=0.0, relax=0):
    """Smooth body grown from unit cubes: layers of text rows, '#' is filled, first layer lowest.

    Catmull-Clark turns the stairs into flesh and the gaps into holes. The lowest loop is sharp so
    that the body stands flat."""
    filled = {(x, y, z) for z, layer in enumerate(layers)
              for y, row in enumerate(layer) for x, c in enumerate(row) if c == "#"}
    points, index, faces = [], {}, []
    sides = (((1, 0, 0), ((1, 0, 0), (1, 1, 0), (1, 1, 1), (1, 0, 1))),
             ((-1, 0, 0), ((0, 0, 0), (0, 0, 1), (0, 1, 1), (0, 1, 0))),
             ((0, 1, 0), ((0, 1, 0), (0, 1, 1), (1, 1, 1), (1, 1, 0))),
             ((0, -1, 0), ((0, 0, 0), (1, 0, 0), (1, 0, 1), (0, 0, 1))),
             ((0, 0, 1), ((0, 0, 1), (1, 0, 1), (1, 1, 1), (0, 1, 1))),
             ((0, 0, -1), ((0, 0, 0), (0, 1, 0), (1, 1, 0), (1, 0, 0))))
    for cube in sorted(filled):
        for step, corners in sides:
            if vec.add(cube, step) in filled:
                continue
            ring = []
            for corner in corners:
                p = vec.add(cube, corner)
                if p not in index:
                    index[p] = len(points)
                    points.append(p)
                ring.append(index[p])
            faces.append(tuple(ring))
    middle = vec.mean(points)
    sharp = {}
    for f in faces:
        if all(points[i][2] == 0 for i in f):
            for i, v in enumerate(f):
                key = tuple(sorted((v, f[(i + 1) % 4])))
                sharp[key] = sharp.get(key, 0) + 1
    creases = [(list(edge), 10) for edge, uses in sorted(sharp.items()) if uses == 1]

    def shape(p):
        x, y, z = (p[0] - middle[0]) * size[0], (p[1] - middle[1]) * size[1], p[2] * size[2]
        return (x, y + bend * x * x, z)
    for _ in range(relax):
        points = relaxed(points, faces)
    return Part([shape(p) for p in points], faces), creases


def relaxed(points, faces):
    """Each point moves half way to the mean of its neighbours; those on the ground stay there."""
    near = {}
    for f in faces:
        for i, v in enumerate(f):
            near.setdefault(v, set()).update((f[i - 1], f[(i + 1) % len(f)]))
    moved = []
    for v, p in enumerate(points):
        q = vec.lerp(p, vec.mean([points[i] for i in sorted(near[v])]), 0.5)
        moved.append((q[0], q[1], p[2] if p[2] == 0 else q[2]))
    return moved


RECLINING = (   # each layer seen from above: knees at the left, an arch, a propped shoulder, a head
    (".###....###.", ".###....###.", ".###....###."),
    ("####....###.", "####....###.", "####....###."),
    ("####...####.", "###########.", "####...####."),
    ("###....#####", "###########.", "###....#####"),
    (".##.....####", ".##.....####", ".##.....####"),
    ("........###.", "........###.", "........###."),
    (".........###", ".........###", ".........###"),
)

GATE = (        # two legs, a low lintel, a window off centre, a round head
    ("##...##", "##...##"), ("##...##", "##...##"), ("##...##", "##...##"), ("###.###", "###.###"),
    ("#######", "#######"), ("#######", "#######"), ("##..###", "##..###"), ("##..###", "##..###"),
    ("#######", "#######"), (".#####.", ".#####."),
)


def reclining():
    return voxel_body(RECLINING, (0.19, 0.25, 0.20), bend=0.10, relax=1)


def gate():
    return voxel_body(GATE, (0.22, 0.26, 0.25), relax=1)


def pierced_cube(size=0.7):
    """Cube with a square tunnel through each pair of faces; outer edges semi-sharp."""
    layers = []
    for z in range(3):
        layers.append(["".join("." if sum(c == 1 for c in (x, y, z)) >= 2 else "#"
                               for x in range(3))
                       for y in range(3)])
    part, foot = voxel_body(layers, (size / 3,) * 3)
    corner = {tuple(round(c, 6) for c in p): i for i, p in enumerate(part.points)}
    h, third = size / 2, size / 3
    marks = [round(-h + third * k, 6) for k in range(4)]
    heights = [round(third * k, 6) for k in range(4)]
    creases = [c for c in foot]
    for sx in (-1, 1):
        for sy in (-1, 1):
            creases.append(([corner[(round(sx * h, 6), round(sy * h, 6), z)] for z in heights], 2))
        creases.append(([corner[(x, round(sx * h, 6), heights[3])] for x in marks], 2))
        creases.append(([corner[(round(sx * h, 6), y, heights[3])] for y in marks], 2))
    return part, creases


def stone(size, wobble, phase):
    """Pebble: a cube of 54 faces blown up towards an ellipsoid, dented by a few waves."""
    layers = [["###"] * 3] * 3
    part, _ = voxel_body(layers, (2 / 3,) * 3)

    def shape(p):
        q = (p[0], p[1], p[2] - 1)
        d = vec.unit(q)
        r = 0.75 + 0.25 * vec.length(q) / 1.2
        r *= 1 + wobble * math.sin(3.1 * d[0] + phase) * math.cos(2.3 * d[1] - phase)
        return (d[0] * r * size[0], d[1] * r * size[1], d[2] * r * size[2])
    return part.mapped(shape), []


def cairn(sizes):
    """Stones balanced on each other; every one rests with its smooth surface on the last."""
    stones, z = [], 0.0
    for k, size in enumerate(sizes):
        part, _ = standing(stone(size, 0.10, 1.3 * k))
        part = part.turned("z", 70 * k)
        top = max(p[2] for p in subdivide(part, (), 3).points)
        stones.append(Part([tuple(round(c, 4) + 0.0 for c in (p[0], p[1], p[2] + z))
                            for p in part.points],
                           part.faces))
        z += top - 0.004   # a little sunk in, as real stones have flats
    return stones
