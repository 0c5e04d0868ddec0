"""Three-component vectors as plain tuples; enough of them to build furniture."""

import math


def add(a, b):
    return (a[0] + b[0], a[1] + b[1], a[2] + b[2])


def sub(a, b):
    return (a[0] - b[0], a[1] - b[1], a[2] - b[2])


def mul(a, s):
    return (a[0] * s, a[1] * s, a[2] * s)


def dot(a, b):
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


def cross(a, b):
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


def length(a):
    return math.sqrt(dot(a, a))


def unit(a):
    size = length(a)
    return mul(a, 1.0 / size) if size > 0 else (0.0, 0.0, 0.0)


def lerp(a, b, t):
    return add(mul(a, 1 - t), mul(b, t))


def mean(points):
    n = len(points)
    return (sum(p[0] for p in points) / n, sum(p[1] for p in points) / n,
            sum(p[2] for p in points) / n)


def area_vector(polygon):
    """Normal times area (Newell): right for concave and slightly bent polygons too."""
    total = (0.0, 0.0, 0.0)
    for i in range(1, len(polygon) - 1):
        total = add(total, cross(sub(polygon[i], polygon[0]), sub(polygon[i + 1], polygon[0])))
    return mul(total, 0.5)


def rotate(p, axis, degrees):
    """Right-handed turn of p about the x, y or z axis."""
    c, s = math.cos(math.radians(degrees)), math.sin(math.radians(degrees))
    x, y, z = p
    if axis == "x":
        return (x, y * c - z * s, y * s + z * c)
    if axis == "y":
        return (x * c + z * s, y, z * c - x * s)
    return (x * c - y * s, x * s + y * c, z)
