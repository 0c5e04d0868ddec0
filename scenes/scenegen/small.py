"""The two small scenes: cornell.usda, to be read by eye, and chamber.usda, simple solids."""

from . import fixtures
from .part import block, cylinder, lathe, sheet
from .usda import Scene


def cornell():
    """The Cornell box's usual dimensions, its walls made plane; the front is open."""
    scene = Scene("cornell", "Cornell box in metres. One lamp of 5000 nits, about 214 lm.")
    w, d, h = 0.556, 0.5592, 0.5488
    scene.camera("Camera", (0.278, -0.8, 0.273), (0.278, 0.2, 0.273), 35, aperture=(25, 25))
    room = scene.object("Room", movable=False)
    room.add("CornellWhite", sheet([(0, 0, 0), (w, 0, 0), (w, d, 0), (0, d, 0)]),
             sheet([(0, 0, h), (0, d, h), (w, d, h), (w, 0, h)]),
             sheet([(0, d, 0), (w, d, 0), (w, d, h), (0, d, h)]))
    room.add("CornellRed", sheet([(0, 0, 0), (0, d, 0), (0, d, h), (0, 0, h)]))
    room.add("CornellGreen", sheet([(w, 0, 0), (w, 0, h), (w, d, h), (w, d, 0)]))
    scene.air = [((0, 0, 0), (w, d, h))]
    lamp = scene.object("Lamp", (0.278, 0.2795, h - 0.002))
    lamp.light("RectLight", "Panel", (0, 0, 0), 5000, {"width": 0.13, "height": 0.105}, 5000)
    scene.object("TallBox", (0.185, 0.351, 0), turn=-17).add(
        "CornellWhite", block((0, 0, 0), (0.165, 0.165, 0.33)))
    scene.object("ShortBox", (0.37, 0.169, 0), turn=17).add(
        "CornellWhite", block((0, 0, 0), (0.165, 0.165, 0.165)))
    return scene


def chamber():
    """Table, pillar, boxes and one lamp in a closed room: few polygons, clear shadows."""
    scene = Scene("chamber",
                  "Penumbra chamber: a closed room with a table, a pillar, boxes and one lamp.")
    scene.patch_size = 0.334   # 1,222 patches; Schoeffel's simple scene (1998) has 1,250
    w, d, h = 5.0, 4.0, 2.7
    scene.camera("Camera", (0.45, 0.4, 1.6), (3.0, 2.5, 0.85), 19)
    room = scene.object("Room", movable=False)
    room.add("Parquet", sheet([(0, 0, 0), (w, 0, 0), (w, d, 0), (0, d, 0)]))
    room.add("Ceiling", sheet([(0, 0, h), (0, d, h), (w, d, h), (w, 0, h)]))
    room.add("WhiteWall", sheet([(0, 0, 0), (0, 0, h), (w, 0, h), (w, 0, 0)]),
             sheet([(0, d, 0), (w, d, 0), (w, d, h), (0, d, h)]))
    room.add("PaintSand", sheet([(0, 0, 0), (0, d, 0), (0, d, h), (0, 0, h)]))
    room.add("BlueWall", sheet([(w, 0, 0), (w, 0, h), (w, d, h), (w, d, 0)]))
    scene.air = [((0, 0, 0), (w, d, h))]

    fixtures.ceiling_panel(scene.object("Lamp", (2.6, 1.9, h)), 1.0, 0.5, 3500, 5600, drop=0.0,
                           depth=0.05)
    table = scene.object("Table", (2.75, 2.05, 0), turn=8)
    table.add("Oak", block((0, 0, 0.70), (1.4, 0.8, 0.04)))
    for x in (-0.64, 0.64):
        for y in (-0.34, 0.34):
            table.add("Walnut", block((x, y, 0), (0.06, 0.06, 0.70)))
    scene.object("RedBox", (2.45, 2.05, 0.74), turn=25).add(
        "PaintRed", block((0, 0, 0), (0.28, 0.28, 0.28)))
    scene.object("Gem", (3.1, 2.05, 0.74)).add(
        "PaintYellow", lathe([(0.05, 0), (0.12, 0.05), (0.12, 0.15), (0.05, 0.20)], 8))
    scene.object("Pillar", (4.05, 3.05, 0)).add(
        "Plaster", block((0, 0, 0), (0.5, 0.5, 0.12)), cylinder(0.18, 0.12, 1.9, 8, 22.5),
        block((0, 0, 1.9), (0.5, 0.5, 0.12)))
    scene.object("TallBox", (1.25, 3.35, 0), turn=20).add(
        "PaintTeal", block((0, 0, 0), (0.6, 0.6, 1.3)))
    scene.object("LowBox", (3.9, 1.15, 0), turn=-25).add(
        "PaintYellow", block((0, 0, 0), (0.7, 0.5, 0.45)))
    return scene
