"""Checks of a scene's geometry: every complaint is one line; an empty list is a good scene."""

from . import vec
from .part import bend

PLANAR = 2e-4     # coordinates are rounded to 1e-4, which bends a quad by as much
PIERCE = 4e-4     # an edge must go this far through a face to count as interpenetration
TOUCH = 1.6e-3    # what stands on or hangs from something is no farther from it than this;
CAGE_TOUCH = 0.1  # a cage may be, for only its smooth surface touches


def complaints(scene):
    found = []
    for obj in scene.objects:
        for (material, double_sided), parts in obj.parts.items():
            for k, part in enumerate(parts):
                where = f"{scene.name}: {obj.name}/{material} part {k}"
                found += [f"{where}: {text}" for text in part_complaints(part)]
                if not part.solid and not double_sided:
                    found += [f"{where}: {text}" for text in sheet_complaints(scene, obj, part)]
        for material, cage, _ in obj.cages:
            found += [f"{scene.name}: {obj.name}/{material}: {text}"
                      for text in closed_complaints(cage)]
    return found + contact_complaints(scene)


def part_complaints(part):
    found = []
    for face in part.faces:
        ring = part.polygon(face)
        if vec.length(vec.area_vector(ring)) < 2e-8:
            found.append(f"face {face} has no area")
        elif bend(ring) > PLANAR:
            found.append(f"face {face} is bent by {bend(ring):.5f} m")
    return found + (closed_complaints(part) if part.solid else [])


def closed_complaints(part):
    """A solid uses each edge once in each direction and encloses a positive volume."""
    uses = {}
    for face in part.faces:
        for i, a in enumerate(face):
            edge = (a, face[(i + 1) % len(face)])
            uses[edge] = uses.get(edge, 0) + 1
    if any(n != 1 or (b, a) not in uses for (a, b), n in uses.items()):
        return ["not closed, or with faces turned against each other"]
    return [] if part.volume() > 0 else ["turned inside out"]


def sheet_complaints(scene, obj, part):
    """Single-sided sheets look into the room's air: a shell's faces have the wall behind them."""
    def in_air(p):
        return any(all(low[k] < p[k] < high[k] for k in range(3)) for low, high in scene.air)
    found = []
    for face in part.faces:
        ring = [obj.world(p) for p in part.polygon(face)]
        centre, normal = vec.mean(ring), vec.unit(vec.area_vector(ring))
        if not in_air(vec.add(centre, vec.mul(normal, 1e-3))):
            found.append(f"sheet at {centre} looks out of the room")
        shell = not obj.movable and obj.name.startswith(("Room", "Hall", "Doorway"))
        if shell and in_air(vec.sub(centre, vec.mul(normal, 1e-3))):
            found.append(f"wall at {centre} has air on both sides")
    return found


class Body:
    """An object's triangles in world space with their bounding boxes."""

    def __init__(self, obj):
        self.name, self.movable = obj.name, obj.movable
        self.triangles = []
        for part in obj.all_parts():
            points = [obj.world(p) for p in part.points]
            for f in part.faces:
                # A fan is exact only for convex faces; contact tests can live with that.
                for i in range(1, len(f) - 1):
                    self.triangles.append(Triangle(points[f[0]], points[f[i]], points[f[i + 1]]))
        for material, cage, _ in obj.cages:
            for f in cage.faces:
                p = [obj.world(cage.points[i]) for i in f]
                self.triangles += [Triangle(p[0], p[i], p[i + 1]) for i in range(1, len(p) - 1)]
        self.subdivided = bool(obj.cages)
        self.low, self.high = bounds([corner for t in self.triangles for corner in (t.low, t.high)])

    def near(self, other, gap):
        return [t for t in self.triangles if overlap(t, other, gap)]


class Triangle:
    __slots__ = ("p", "normal", "low", "high")

    def __init__(self, a, b, c):
        self.p = (a, b, c)
        self.normal = vec.unit(vec.cross(vec.sub(b, a), vec.sub(c, a)))
        self.low, self.high = bounds(self.p)

    def holds(self, p, margin):
        """Is p, a point of the plane, inside by at least margin (negative: outside by that)?"""
        for i in range(3):
            a, b = self.p[i], self.p[(i + 1) % 3]
            side = vec.sub(b, a)
            size = vec.length(side)
            if size == 0 or vec.dot(vec.cross(side, vec.sub(p, a)), self.normal) < margin * size:
                return False
        return True


def bounds(points):
    return (tuple(min(p[k] for p in points) for k in range(3)),
            tuple(max(p[k] for p in points) for k in range(3)))


def overlap(a, b, gap):
    return all(a.low[k] <= b.high[k] + gap and b.low[k] <= a.high[k] + gap for k in range(3))


def contact_complaints(scene):
    """No two objects pierce each other; every movable one touches something."""
    bodies = [Body(o) for o in scene.objects if o.parts or o.cages]
    touching, found = set(), []
    for i, a in enumerate(bodies):
        for b in bodies[i + 1:]:
            problems, contact = meeting(a, b)
            found += [f"{scene.name}: {text}" for text in problems]
            if contact:
                touching |= {a.name, b.name}
    lonely = [b.name for b in bodies if b.movable and b.name not in touching]
    return found + [f"{scene.name}: {name} touches nothing" for name in lonely]


def meeting(a, b):
    """What is wrong between two bodies, and whether they touch."""
    if not overlap(a, b, TOUCH):
        return [], False
    found = []
    ours, theirs = a.near(b, TOUCH), b.near(a, TOUCH)
    pairs = [(s, t) for s in ours for t in theirs if overlap(s, t, TOUCH)]
    # A cage lies outside its smooth surface, so it may dip into its plinth.
    if not (a.subdivided or b.subdivided):
        if any(pierces(s, t) or pierces(t, s) for s, t in pairs):
            found.append(f"{a.name} and {b.name} interpenetrate")
        if any(coincide(s, t) for s, t in pairs):
            found.append(f"{a.name} and {b.name} have faces in one place")
    gap = CAGE_TOUCH if a.subdivided or b.subdivided else TOUCH
    return found, any(touches(s, t, gap) or touches(t, s, gap) for s, t in pairs)


def pierces(s, t):
    """Does an edge of s go through t, clear of both ends and of t's border?"""
    d = [vec.dot(vec.sub(p, t.p[0]), t.normal) for p in s.p]
    for i in range(3):
        u, v = d[i], d[(i + 1) % 3]
        if min(u, v) < -PIERCE and max(u, v) > PIERCE:
            if t.holds(vec.lerp(s.p[i], s.p[(i + 1) % 3], u / (u - v)), PIERCE):
                return True
    return False


def touches(s, t, gap):
    return any(abs(vec.dot(vec.sub(p, t.p[0]), t.normal)) < gap and t.holds(p, -gap) for p in s.p)


def coincide(s, t):
    """Same plane, same side and overlapping: the eye would see both flicker."""
    if vec.dot(s.normal, t.normal) < 0.9999:
        return False
    if any(abs(vec.dot(vec.sub(p, t.p[0]), t.normal)) > 1.5e-4 for p in s.p):
        return False
    return t.holds(vec.mean(s.p), PIERCE) or s.holds(vec.mean(t.p), PIERCE)
