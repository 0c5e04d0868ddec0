"""gallery.usda: five rooms joined by doorways in thick walls, subdivision-surface sculptures."""

import random

from . import fixtures, sculptures, storage, voxels
from .part import block, cylinder, sheet, slab
from .sculptures import standing
from .usda import Scene

DOOR_H = 2.8
ROOMS = {   # x0, y0, x1, y1, height, floor, and walls other than white by side
    "HallA": (0.0, 0.0, 12.0, 7.6, 4.2, "Parquet", {}),
    "HallB": (12.4, 0.0, 25.0, 7.6, 4.2, "Parquet", {"east": "OchreWall"}),
    "HallC": (0.0, 8.0, 7.6, 18.0, 4.2, "Parquet", {"west": "RedWall", "north": "RedWall"}),
    "HallD": (8.0, 8.0, 17.0, 18.0, 5.4, "StoneFloor", {}),
    "HallE": (17.4, 8.0, 25.0, 18.0, 4.2, "Parquet", {"east": "BlueWall", "north": "BlueWall"}),
}
DOORS = (   # boxes of air through the walls: low and high corner in plan
    (12.0, 2.6, 12.4, 5.0), (2.8, 7.6, 4.8, 8.0), (9.0, 7.6, 11.6, 8.0),
    (19.8, 7.6, 21.8, 8.0), (7.6, 12.0, 8.0, 14.4), (17.0, 12.0, 17.4, 14.4),
)


def wall_pieces(low, high, height, openings):
    """Rectangles (from, to, z0, z1) of a wall along one axis, doors left out. Every wall is cut at
    door height, so that neighbours meet corner to corner and no pinhole opens between them."""
    pieces, start = [], low
    for a, b in sorted(openings) + [(high, high)]:
        pieces += [(start, a, 0, DOOR_H), (start, a, DOOR_H, height)]
        if b > a:
            pieces.append((a, b, DOOR_H, height))
        start = b
    return pieces


def shell(scene):
    for name, (x0, y0, x1, y1, h, floor, colours) in ROOMS.items():
        room = scene.object(name, movable=False)
        room.add(floor, sheet([(x0, y0, 0), (x1, y0, 0), (x1, y1, 0), (x0, y1, 0)]))
        room.add("Ceiling", sheet([(x0, y0, h), (x0, y1, h), (x1, y1, h), (x1, y0, h)]))
        for side, y, along in (("south", y0, 1), ("north", y1, -1)):
            doors = [(d[0], d[2]) for d in DOORS
                     if abs((d[1] if side == "north" else d[3]) - y) < 1e-6
                     and x0 < d[0] < x1]
            for a, b, z0, z1 in wall_pieces(x0, x1, h, doors):
                quad = [(a, y, z0), (a, y, z1), (b, y, z1), (b, y, z0)][::along]
                room.add(colours.get(side, "WhiteWall"), sheet(quad))
        for side, x, along in (("west", x0, -1), ("east", x1, 1)):
            doors = [(d[1], d[3]) for d in DOORS
                     if abs((d[0] if side == "east" else d[2]) - x) < 1e-6
                     and y0 < d[1] < y1]
            for a, b, z0, z1 in wall_pieces(y0, y1, h, doors):
                quad = [(x, a, z0), (x, a, z1), (x, b, z1), (x, b, z0)][::along]
                room.add(colours.get(side, "WhiteWall"), sheet(quad))
        scene.air.append(((x0, y0, 0), (x1, y1, h)))
    for k, (x0, y0, x1, y1) in enumerate(DOORS):
        reveal = scene.object(f"Doorway{k + 1}", movable=False)
        reveal.add("StoneFloor", sheet([(x0, y0, 0), (x1, y0, 0), (x1, y1, 0), (x0, y1, 0)]))
        z = DOOR_H
        reveal.add("FrameWhite", sheet([(x0, y0, z), (x0, y1, z), (x1, y1, z), (x1, y0, z)]))
        if x1 - x0 < y1 - y0:   # through a wall that runs along y
            jambs = ([(x0, y0, 0), (x0, y0, z), (x1, y0, z), (x1, y0, 0)],
                     [(x0, y1, 0), (x1, y1, 0), (x1, y1, z), (x0, y1, z)])
        else:
            jambs = ([(x0, y0, 0), (x0, y1, 0), (x0, y1, z), (x0, y0, z)],
                     [(x1, y0, 0), (x1, y0, z), (x1, y1, z), (x1, y1, 0)])
        reveal.add("FrameWhite", *[sheet(j) for j in jambs])
        scene.air.append(((x0, y0, 0), (x1, y1, z)))


def plinth(scene, name, x, y, w, h, d=None, turn=0):
    """White pedestal with a shadow gap at its foot."""
    d = d or w
    obj = scene.object(name, (x, y, 0), turn)
    obj.add("Basalt", block((0, 0, 0), (w - 0.06, d - 0.06, 0.03)))
    obj.add("Plinth", block((0, 0, 0.03), (w, d, h - 0.03)))
    return h


def lamps(scene):
    panels = (("HallA", 3.4, 3.8), ("HallA", 8.8, 3.8), ("HallB", 15.6, 3.8), ("HallB", 21.6, 3.8),
              ("HallC", 3.8, 10.6), ("HallC", 3.8, 15.4), ("HallD", 12.5, 10.8),
              ("HallD", 12.5, 15.2),
              ("HallE", 21.2, 10.6), ("HallE", 21.2, 15.4))
    for k, (room, x, y) in enumerate(panels):
        h = ROOMS[room][4]
        great = room == "HallD"
        lamp = scene.object(f"CeilingLamp{k + 1}", (x, y, h), movable=k in (0, 6))
        fixtures.ceiling_panel(lamp, 3.0 if great else 2.4, 1.2 if great else 0.9,
                               1500 if great else 1200, 6500 if great else 5600, depth=0.06,
                               rim=0.02)
    fixtures.spot(scene.object("Spot1", (5.6, 3.3, 4.2)), 37, 52, 55000, 3000)
    fixtures.spot(scene.object("Spot2", (10.9, 11.4, 5.4)), 22, 62, 60000, 3200)
    fixtures.spot(scene.object("Spot3", (3.6, 11.6, 4.2)), 78, 42, 45000, 3000)


def works(scene):
    def place(name, material, sculpture, x, y, base, turn=0.0, pins=()):
        obj = scene.object(name, (x, y, base), turn)
        part, creases = sculpture
        obj.add_subdivision(material, part, creases)
        for px, py, r, top in pins:
            obj.add("DarkSteel", cylinder(r, 0, top, 10).moved(px, py))
        return obj

    place("TwistedColumn", "Marble", standing(sculptures.twisted_column()), 7.2, 4.5,
          plinth(scene, "Plinth1", 7.2, 4.5, 0.9, 0.25))
    place("Head", "Bronze", standing(sculptures.head()), 10.7, 5.0,
          plinth(scene, "Plinth2", 10.7, 5.0, 0.46, 1.12), turn=-40)
    place("Knot", "Clay", standing(sculptures.torus_knot(), 0.02), 12.9, 12.2,
          plinth(scene, "Plinth3", 12.9, 12.2, 1.2, 0.55), turn=24, pins=((0, 0, 0.02, 0.06),))
    place("Reclining", "Granite", standing(voxels.reclining()),
          3.8, 13.4, plinth(scene, "Plinth4", 3.8, 13.4, 2.6, 0.35, 1.2), turn=12)
    place("Moebius", "Jade", standing(sculptures.moebius(), 0.03), 18.6, 3.8,
          plinth(scene, "Plinth5", 18.6, 3.8, 0.8, 0.70), turn=70, pins=((0, 0, 0.02, 0.06),))
    place("PiercedCube", "Basalt", standing(voxels.pierced_cube()), 10.2, 15.2,
          plinth(scene, "Plinth6", 10.2, 15.2, 0.9, 0.60), turn=30)
    place("Bloom", "Terracotta", standing(sculptures.bloom()), 20.8, 11.0,
          plinth(scene, "Plinth7", 20.8, 11.0, 0.6, 0.95))
    place("Gate", "Marble", standing(voxels.gate()), 21.2, 14.8,
          plinth(scene, "Plinth8", 21.2, 14.8, 2.0, 0.20, 0.9), turn=-20)
    stones = scene.object("Cairn", (22.3, 4.9, plinth(scene, "Plinth9", 22.3, 4.9, 1.1, 0.3)), 15)
    for material, part in zip(("Granite", "Marble", "Basalt", "Jade"), voxels.cairn(
            ((0.46, 0.40, 0.24), (0.33, 0.36, 0.20), (0.27, 0.23, 0.22), (0.16, 0.19, 0.13)))):
        stones.add_subdivision(material, part)


def furnishing(scene, rng):
    for k, (x, y, turn) in enumerate(((3.2, 3.4, 90), (13.6, 15.6, 0), (16.2, 5.4, 90),
                                      (5.6, 10.0, 90), (23.2, 12.2, 90))):
        bench = scene.object(f"Bench{k + 1}", (x, y, 0), turn)
        bench.add("BenchOak", slab(1.9, 0.42, 0.05, 0.02, 2, edge=0.006).moved(z=0.40))
        for s in (-1, 1):
            bench.add("DarkSteel", block((s * 0.72, 0, 0), (0.03, 0.36, 0.40)))
    pictures = (   # x, y, turn of the wall's outward side, width, height
        (1.6, 7.6, 0, 1.2, 0.9), (6.6, 7.6, 0, 1.5, 1.1), (0.0, 3.8, 90, 2.4, 1.6),
        (4.0, 0.0, 180, 1.4, 1.0),
        (8.4, 0.0, 180, 1.0, 1.3), (14.0, 7.6, 0, 1.1, 1.1), (17.6, 7.6, 0, 1.6, 1.1),
        (23.6, 7.6, 0, 1.0, 1.3),
        (25.0, 3.8, -90, 2.6, 1.7), (18.6, 0.0, 180, 2.2, 1.4), (7.6, 9.8, -90, 1.3, 1.0),
        (7.6, 16.4, -90, 1.2, 1.5),
        (17.4, 10.0, 90, 1.2, 1.2), (17.4, 16.2, 90, 1.5, 1.1), (10.2, 18.0, 0, 1.8, 2.2),
        (14.8, 18.0, 0, 1.8, 2.2))
    palettes = (("PaintRed", "PaintWhite", "PaintBlack", "PaintYellow", "PaintBlue"),
                ("PaintTeal", "PaintSand", "PaintWhite", "PaintPink"),
                ("PaintBlue", "PaintTeal", "PaintWhite", "PaintBlack"),
                ("PaintYellow", "PaintSand", "PaintRed", "PaintPink"))
    for k, (x, y, turn, w, h) in enumerate(pictures):
        z = 1.55 if h < 2 else 1.75
        frame = ("Oak", "Walnut", "DarkSteel")[k % 3]
        storage.picture(scene.object(f"Picture{k + 1}", (x, y, z), turn), rng, w, h, frame,
                        palettes[k % 4], 6 + k % 5 * 2)


def build():
    scene = Scene("gallery",
                  "Penumbra gallery: five rooms of sculpture. Luminances in nits, metres.")
    scene.camera("Camera", (6.3, 0.9, 1.65), (9.95, 7.6, 1.5), 22)
    scene.camera("GreatHallCamera", (16.4, 8.6, 1.7), (11.6, 13.4, 1.45), 21)
    scene.camera("RedRoomCamera", (6.9, 8.7, 1.65), (3.0, 14.6, 1.2), 20)
    scene.camera("BlueRoomCamera", (18.1, 8.8, 1.65), (22.0, 14.8, 1.3), 20)
    scene.camera("EastHallCamera", (24.4, 0.6, 1.65), (18.4, 4.9, 1.4), 20)
    shell(scene)
    lamps(scene)
    works(scene)
    furnishing(scene, random.Random(1993))
    return scene
