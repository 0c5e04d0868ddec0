"""A Part is one connected piece of surface: points and polygons, counter-clockwise from outside.

A solid part is closed (each edge used once in each direction); a sheet is open. The builders
below make the usual solids; everything that furniture needs is one of them, moved and turned.
"""

import math

from . import vec

# Coordinates are written with four decimals (0.1 mm), so a quad that is bent by less than this
# cannot be told from a flat one; a quad that is bent by more is split into two triangles.
FLAT = 1.2e-4


class Part:
    def __init__(self, points, faces, solid=True):
        self.points = [tuple(map(float, p)) for p in points]
        self.faces = [tuple(f) for f in faces]
        self.solid = solid

    def mapped(self, function):
        return Part([function(p) for p in self.points], self.faces, self.solid)

    def moved(self, x=0.0, y=0.0, z=0.0):
        return self.mapped(lambda p: (p[0] + x, p[1] + y, p[2] + z))

    def turned(self, axis, degrees):
        return self.mapped(lambda p: vec.rotate(p, axis, degrees))

    def reversed(self):
        return Part(self.points, [tuple(reversed(f)) for f in self.faces], self.solid)

    def polygon(self, face):
        return [self.points[i] for i in face]

    def area(self):
        return sum(vec.length(vec.area_vector(self.polygon(f))) for f in self.faces)

    def volume(self):
        """Signed volume enclosed; positive when the faces of a solid look outward."""
        return sum(vec.dot(self.polygon(f)[0], vec.area_vector(self.polygon(f)))
                   for f in self.faces) / 3.0

    def finished(self):
        """Rounded to what is written, doubled corners dropped, bent faces split."""
        points, index = [], {}
        remap = []
        for p in self.points:
            key = tuple(round(c, 4) + 0.0 for c in p)
            remap.append(index.setdefault(key, len(points)))
            if remap[-1] == len(points):
                points.append(key)
        faces = []
        for face in self.faces:
            ring = [remap[i] for i in face]
            ring = [v for k, v in enumerate(ring) if v != ring[k - 1]]
            if len(ring) >= 3:
                faces.extend(_flat_pieces(points, ring))
        return Part(points, faces, self.solid)


def bend(polygon):
    """Largest distance of a corner from the polygon's mean plane."""
    normal, centre = vec.unit(vec.area_vector(polygon)), vec.mean(polygon)
    return max(abs(vec.dot(vec.sub(p, centre), normal)) for p in polygon)


def _flat_pieces(points, ring):
    if len(ring) == 3 or bend([points[i] for i in ring]) <= FLAT:
        return [tuple(ring)]
    assert len(ring) == 4, "only quads can be bent"
    return [(ring[0], ring[1], ring[2]), (ring[0], ring[2], ring[3])]


def sheet(*polygons):
    """Open surface from explicit polygons."""
    points = [p for polygon in polygons for p in polygon]
    faces, first = [], 0
    for polygon in polygons:
        faces.append(tuple(range(first, first + len(polygon))))
        first += len(polygon)
    return Part(points, faces, solid=False)


def stack(rings, cap_bottom=True, cap_top=True):
    """Rings of equal length, bottom to top, counter-clockwise seen from the top; joined by quads.

    A ring of one point is an apex. Without caps the result is a sheet.
    """
    points, first = [], []
    for ring in rings:
        first.append(len(points))
        points.extend(ring)
    n = max(len(r) for r in rings)
    faces = []
    for k in range(len(rings) - 1):
        for i in range(n):
            j = (i + 1) % n
            low = ([first[k]] if len(rings[k]) == 1 else [first[k] + i, first[k] + j])
            high = ([first[k + 1]] if len(rings[k + 1]) == 1
                    else [first[k + 1] + j, first[k + 1] + i])
            faces.append(tuple(low + high))
    if len(rings[0]) > 1 and cap_bottom:
        faces.append(tuple(reversed(range(first[0], first[0] + n))))
    if len(rings[-1]) > 1 and cap_top:
        faces.append(tuple(range(first[-1], first[-1] + n)))
    return Part(points, faces, solid=cap_bottom and cap_top)


def box(low, high):
    (x0, y0, z0), (x1, y1, z1) = low, high
    return stack([[(x0, y0, z0), (x1, y0, z0), (x1, y1, z0), (x0, y1, z0)],
                  [(x0, y0, z1), (x1, y0, z1), (x1, y1, z1), (x0, y1, z1)]])


def block(centre, size):
    """Box that stands on centre's height: centre is the middle of its bottom face."""
    (x, y, z), (w, d, h) = centre, size
    return box((x - w / 2, y - d / 2, z), (x + w / 2, y + d / 2, z + h))


def rounded_rect(w, d, r, corner_steps, inset=0.0):
    """Outline in XY around the origin; offset inward by inset along concentric corners."""
    outline = []
    for cx, cy, start in ((1, 1, 0), (-1, 1, 90), (-1, -1, 180), (1, -1, 270)):
        for k in range(corner_steps + 1):
            a = math.radians(start + 90 * k / corner_steps)
            outline.append((cx * (w / 2 - r) + (r - inset) * math.cos(a),
                            cy * (d / 2 - r) + (r - inset) * math.sin(a)))
    return outline


def slab(w, d, h, r, corner_steps=2, edge=0.0):
    """Rounded-corner plate of height h on the plane z = 0; edge chamfers its rims."""
    def ring(inset, z):
        return [(x, y, z) for x, y in rounded_rect(w, d, r, corner_steps, inset)]
    if edge <= 0:
        return stack([ring(0, 0), ring(0, h)])
    return stack([ring(edge, 0), ring(0, edge), ring(0, h - edge), ring(edge, h)])


def cushion(w, d, h, edge):
    """Box with all edges and corners cut off at 45 degrees (26 faces), on the plane z = 0."""
    def ring(inset, z):
        x, y, e = w / 2 - inset, d / 2 - inset, edge - inset
        return [(x, -y + e, z), (x, y - e, z), (x - e, y, z), (-x + e, y, z),
                (-x, y - e, z), (-x, -y + e, z), (-x + e, -y, z), (x - e, -y, z)]
    # The outermost rings have doubled corners, which finished() drops.
    return stack([ring(edge, 0), ring(0, edge), ring(0, h - edge), ring(edge, h)])


def lathe(profile, n, start=0.0):
    """Turn (radius, z) pairs about the z axis in n steps. Runs from the bottom of the outside
    up, and for a hollow body over the rim and down the inside; ends off the axis get a cap."""
    rings = []
    for r, z in profile:
        if r < 1e-6:
            rings.append([(0.0, 0.0, z)])
        else:
            turn = [math.radians(start + 360.0 * i / n) for i in range(n)]
            rings.append([(r * math.cos(a), r * math.sin(a), z) for a in turn])
    return stack(rings)


def cylinder(r, z0, z1, n, start=0.0):
    return lathe([(r, z0), (r, z1)], n, start)


def prism(outline, low, high, axis="z"):
    """Closed prism over a counter-clockwise XY outline, pushed along z (or x: outline is YZ;
    or y: outline is ZX)."""
    part = stack([[(u, v, low) for u, v in outline], [(u, v, high) for u, v in outline]])
    if axis == "x":
        return part.mapped(lambda p: (p[2], p[0], p[1]))
    if axis == "y":
        return part.mapped(lambda p: (p[1], p[2], p[0]))
    return part


def tube(path, radius, n, start=0.0):
    """Round bar along a path with mitred bends: each side stays flat because every ring is the
    previous one pushed along the segment onto the mitre plane."""
    radii = radius if isinstance(radius, (list, tuple)) else [radius] * len(path)
    along = vec.unit(vec.sub(path[1], path[0]))
    helper = (0, 0, 1) if abs(along[2]) < 0.9 else (1, 0, 0)
    u = vec.unit(vec.cross(helper, along))
    v = vec.cross(along, u)
    ring = []
    for i in range(n):
        a = math.radians(start + 360.0 * i / n)
        ring.append(vec.add(path[0], vec.add(vec.mul(u, radii[0] * math.cos(a)),
                                             vec.mul(v, radii[0] * math.sin(a)))))
    rings = [ring]
    for k in range(1, len(path)):
        along = vec.unit(vec.sub(path[k], path[k - 1]))
        onward = vec.unit(vec.sub(path[k + 1], path[k])) if k + 1 < len(path) else along
        normal = vec.unit(vec.add(along, onward))
        moved = []
        for p in rings[-1]:
            t = vec.dot(vec.sub(path[k], p), normal) / vec.dot(along, normal)
            moved.append(vec.add(p, vec.mul(along, t)))
        if radii[k] != radii[k - 1]:
            s = radii[k] / radii[k - 1]
            moved = [vec.add(path[k], vec.mul(vec.sub(p, path[k]), s)) for p in moved]
        rings.append(moved)
    return stack(rings)


def ball(r, n, rows, centre=(0, 0, 0)):
    profile = [(r * math.sin(math.pi * k / rows), -r * math.cos(math.pi * k / rows))
               for k in range(rows + 1)]
    return lathe(profile, n).moved(*centre)


def plate(function, columns, rows, thickness):
    """Curved plate: function(u, v), u and v in [0, 1], is the front; the back lies thickness
    behind. The front looks along d/du x d/dv."""
    def normal(u, v):
        e = 1e-4
        du = vec.sub(function(u + e, v), function(u - e, v))
        dv = vec.sub(function(u, v + e), function(u, v - e))
        return vec.unit(vec.cross(du, dv))
    front, back = [], []
    for j in range(rows + 1):
        for i in range(columns + 1):
            u, v = i / columns, j / rows
            front.append(function(u, v))
            back.append(vec.sub(function(u, v), vec.mul(normal(u, v), thickness)))
    w, m = columns + 1, len(front)
    faces = []
    for j in range(rows):
        for i in range(columns):
            a, b, c, d = j * w + i, j * w + i + 1, (j + 1) * w + i + 1, (j + 1) * w + i
            faces += [(a, b, c, d), (d + m, c + m, b + m, a + m)]
    rim = [i for i in range(columns)] + [j * w + columns for j in range(rows)]
    rim += [rows * w + i for i in range(columns, 0, -1)] + [j * w for j in range(rows, 0, -1)]
    for k, a in enumerate(rim):
        b = rim[(k + 1) % len(rim)]
        faces.append((b, a, a + m, b + m))
    return Part(front + back, faces)
