"""Office chair and armchair. Local frame: the sitter looks along +y, the floor is z = 0."""

import math

from . import vec
from .part import block, box, cushion, cylinder, lathe, plate, prism, slab, stack, tube

WHEEL = 0.03      # castor radius
LEGS = 5


def _castor(angle):
    """Castor under the end of one leg of the star base: a wheel beside its stem."""
    steel, black = [], []
    spin = angle * 2.7   # castors never all point the same way
    # Outline in ZX for a prism along y; its first point is the lowest: it touches the floor.
    wheel = [(-WHEEL * math.cos(math.radians(a)), -WHEEL * math.sin(math.radians(a)))
             for a in range(0, 360, 45)]
    black.append(prism(wheel, -0.022, 0.004, "y").moved(z=WHEEL).turned("z", spin))
    steel.append(box((-0.007, 0.0045, 0.02), (0.007, 0.0145, 0.072)).turned("z", spin))
    reach = 0.29
    at = vec.rotate((reach, 0, 0), "z", angle)
    return ([p.moved(*at) for p in steel], [p.moved(*at) for p in black])


def _star_leg(angle):
    """Tapered bar from the hub's face down to its castor."""
    x0, x1 = 0.0405, 0.31
    rings = [[(x, -w, z0), (x, w, z0), (x, w, z1), (x, -w, z1)]
             for x, w, z0, z1 in ((x0, 0.022, 0.085, 0.125), (x1, 0.014, 0.072, 0.092))]
    return stack(rings).turned("z", angle)


def office_chair(obj, cloth, height=0.46, arms=True):
    """Swivel chair on five castors; height is that of the top of the seat."""
    seat_bottom = height - 0.075
    hub = lathe([(0.0426, 0.08), (0.0426, 0.13)], 10, start=18)
    obj.add("DarkSteel", hub, *[_star_leg(72 * k + 36) for k in range(LEGS)])
    for k in range(LEGS):
        steel, black = _castor(72 * k + 36)
        obj.add("DarkSteel", *steel)
        obj.add("BlackPlastic", *black)
    obj.add("Steel", cylinder(0.026, 0.13, 0.26, 10), cylinder(0.016, 0.26, seat_bottom - 0.04, 8))
    obj.add("BlackPlastic", block((0, -0.02, seat_bottom - 0.04), (0.16, 0.24, 0.04)))

    seat = slab(0.50, 0.48, 0.075, 0.09, 3, edge=0.02).moved(z=seat_bottom)
    obj.add(cloth, seat)

    def back(u, v):
        # Wraps around the sitter and is narrowest at the top; leans back by about 8 degrees.
        half = 0.235 - 0.035 * v * v
        a = (u - 0.5) * 1.15
        x = -half * math.sin(a) / math.sin(0.575)
        y = -0.235 + 0.10 * (1 - math.cos(a)) / (1 - math.cos(0.575)) * 0.55
        lumbar = 0.022 * math.sin(math.pi * min(1.0, v * 1.7))
        z = height + 0.13 + 0.46 * v - 0.035 * (2 * u - 1) ** 2 * v
        return (x, y + lumbar - 0.085 * v, z)
    obj.add(cloth, plate(back, 5, 4, 0.045))
    # The bar that carries the back: out of the mechanism, up behind the seat.
    obj.add("DarkSteel", tube([(0, -0.14, seat_bottom - 0.02), (0, -0.325, seat_bottom - 0.02),
                               (0, -0.345, height + 0.10), (0, -0.32, height + 0.36)],
                              0.014, 6))
    if arms:
        for side in (-1, 1):
            post = tube([(side * 0.2505, 0.02, seat_bottom + 0.035),
                         (side * 0.30, 0.02, seat_bottom + 0.035),
                         (side * 0.30, 0.02, height + 0.185)], 0.011, 6)
            obj.add("DarkSteel", post)
            obj.add("BlackPlastic", slab(0.065, 0.26, 0.026, 0.025, 1, edge=0.007)
                    .moved(side * 0.30, 0.03, height + 0.1855))
    return obj


def armchair(obj, cloth, legs):
    """Low reading chair: cushions in a shell, four turned legs."""
    for x in (-0.31, 0.31):
        for y in (-0.28, 0.30):
            obj.add(legs, lathe([(0.013, 0), (0.022, 0.15)], 8).moved(x, y))
    obj.add(cloth, cushion(0.74, 0.72, 0.13, 0.02).moved(0, 0.0, 0.15))
    obj.add(cloth, cushion(0.50, 0.58, 0.15, 0.04).moved(0, 0.13, 0.2805))
    for side in (-1, 1):
        arm = cushion(0.13, 0.78, 0.44, 0.03).moved(side * 0.4355, 0.0, 0.16)
        obj.add(cloth, arm)

    def back(u, v):
        x = (0.5 - u) * 0.70
        wrap = 0.06 * (2 * u - 1) ** 2
        return (x, -0.215 - 0.20 * v + wrap, 0.335 + 0.51 * v - 0.05 * (2 * u - 1) ** 2 * v)
    obj.add(cloth, plate(back, 5, 3, 0.13))
    return obj


def lounge_table(obj, top, legs, radius=0.32, height=0.42):
    obj.add(top, lathe([(radius - 0.012, height - 0.024), (radius, height - 0.012),
                        (radius, height)], 28))
    for k in range(3):
        a = math.radians(90 + 120 * k)
        foot = (0.26 * math.cos(a), 0.26 * math.sin(a), 0)
        head = (0.17 * math.cos(a), 0.17 * math.sin(a), height - 0.024)
        obj.add(legs, _peg(foot, head, 0.010, 0.016, 8))
    return obj


def _peg(foot, head, r0, r1, n):
    """Slanting round leg whose ends are cut level with floor and table."""
    def ring(c, r):
        return [(c[0] + r * math.cos(2 * math.pi * i / n),
                 c[1] + r * math.sin(2 * math.pi * i / n), c[2])
                for i in range(n)]
    return stack([ring(foot, r0), ring(head, r1)])
