"""office.usda: a small studio office at night. One long view from the south-west corner shows a
pair of desks under a window, bookcases, a reading corner; a warm desk lamp against cool panels."""

import random

from . import desks, fixtures, seating, storage
from .desks import DESK_TOP
from .part import box, sheet, slab
from .usda import Scene

W, D, H = 7.2, 5.4, 2.8                     # room, metres: x east, y north, z up
WINDOW = (1.7, 4.7, 0.95, 2.35)             # x0, x1, z0, z1 of the opening in the north wall
RECESS = 0.14


def shell(scene):
    room = scene.object("Room", movable=False)
    room.add("Carpet", sheet([(0, 0, 0), (W, 0, 0), (W, D, 0), (0, D, 0)]))
    room.add("Ceiling", sheet([(0, 0, H), (0, D, H), (W, D, H), (W, 0, H)]))
    room.add("WhiteWall", sheet([(0, 0, 0), (0, 0, H), (W, 0, H), (W, 0, 0)]),
             sheet([(0, 0, 0), (0, D, 0), (0, D, H), (0, 0, H)]))
    room.add("AccentWall", sheet([(W, 0, 0), (W, 0, H), (W, D, H), (W, D, 0)]))
    for x0, x1, z0, z1 in fixtures.wall_with_hole(0, W, 0, H, WINDOW):
        room.add("WhiteWall", sheet([(x0, D, z0), (x1, D, z0), (x1, D, z1), (x0, D, z1)]))
    x0, x1, z0, z1 = WINDOW
    y = D + RECESS
    room.add("WhiteWall", sheet([(x0, D, z0), (x0, y, z0), (x1, y, z0), (x1, D, z0)][::-1]),
             sheet([(x0, D, z1), (x0, y, z1), (x1, y, z1), (x1, D, z1)]),
             sheet([(x0, D, z0), (x0, y, z0), (x0, y, z1), (x0, D, z1)]),
             sheet([(x1, D, z0), (x1, D, z1), (x1, y, z1), (x1, y, z0)]))
    room.add("NightGlass", sheet([(x0, y, z0), (x1, y, z0), (x1, y, z1), (x0, y, z1)]))
    t, h = 0.014, 0.08
    room.add("Skirting", box((0, D - t, 0), (W, D, h)), box((0, 0, 0), (W, t, h)),
             box((0, t, 0), (t, D - t, h)),
             box((W - t, t, 0), (W, DOOR_Y - 0.52, h)),
             box((W - t, DOOR_Y + 0.52, 0), (W, D - t, h)))
    scene.air = [((0, 0, 0), (W, D, H)), ((x0, D, z0), (x1, y, z1))]


DOOR_Y = 0.85
BOOK_SEED = 1   # found by trial: with these books the office has 7,155 polygons


def fittings(scene):
    x0, x1, z0, z1 = WINDOW
    mid = (x0 + x1) / 2
    fixtures.window(scene.object("Window", (mid, D, z0), movable=False), x1 - x0, z1 - z0, RECESS)
    third = (x1 - x0) / 3
    for k, drop in enumerate((0.34, 0.34, 0.62)):
        fixtures.blind(scene.object(f"Blind{k + 1}", (x0 + third * (k + 0.5), D + 0.045, z1)),
                       third - 0.03, drop,
                       slats=7 if k < 2 else 13)
    fixtures.door(scene.object("Door", (W, DOOR_Y, 0), turn=-90, movable=False))
    fixtures.radiator(scene.object("Radiator", (5.3, D - 0.014, 0), movable=False), w=0.9, fins=11)
    for k, x in enumerate((1.3, 3.6, 5.9)):
        lamp = scene.object(f"CeilingLamp{k + 1}", (x, 2.75, H), turn=90)
        fixtures.ceiling_panel(lamp, 1.2, 0.22, 2400, 6000, drop=0.32, depth=0.03)


def workplaces(scene, rng):
    cx, south, north = 2.75, 2.95, 3.75
    desks.desk(scene.object("Desk1", (cx, south, 0)), drawers=1)
    desks.desk(scene.object("Desk2", (cx, north + 0.005, 0), turn=180), drawers=1)
    seating.office_chair(scene.object("Seat", (cx + 0.04, south - 0.74, 0), turn=-24), "RustCloth")
    seating.office_chair(scene.object("Seat2", (cx - 0.15, north + 0.72, 0), turn=170),
                         "TealCloth", arms=False)
    top = DESK_TOP

    desks.monitor(scene.object("Monitor1", (cx + 0.10, south + 0.17, top), turn=-6), "ScreenGlow")
    desks.keyboard(scene.object("Keyboard1", (cx + 0.08, south - 0.16, top), turn=-3))
    desks.mouse(scene.object("Mouse1", (cx + 0.36, south - 0.17, top), turn=8))
    desks.desk_lamp(scene.object("DeskLamp", (cx - 0.62, south + 0.20, top), turn=-32))
    desks.mug(scene.object("Mug1", (cx - 0.20, south - 0.10, top), turn=-60), "ChinaBlue")
    desks.pencil_cup(scene.object("PencilCup", (cx + 0.62, south + 0.22, top)), rng)
    papers = scene.object("Papers1", (cx - 0.46, south - 0.17, top), turn=12)
    z = desks.paper_stack(papers, rng, 3)
    papers.add("BookOchre", desks.pen().turned("z", 35).moved(-0.03, -0.02, z))
    desks.paper_stack(scene.object("Papers2", (cx + 0.60, south - 0.10, top), turn=-7), rng, 5)

    desks.monitor(scene.object("Monitor2", (cx - 0.05, north - 0.17, top), turn=184), None)
    desks.laptop(scene.object("Laptop", (cx - 0.02, north + 0.17, top), turn=188))
    desks.mouse(scene.object("Mouse2", (cx - 0.33, north + 0.17, top), turn=180), "WhitePlastic")
    storage.blade_plant(scene.object("DeskPlant", (cx + 0.64, north + 0.05, top)), rng)
    tray = scene.object("LetterTray", (cx - 0.58, north - 0.02, top), turn=4)
    for k in range(3):
        z = 0.065 * k
        tray.add("DarkSteel", box((-0.12, -0.16, z), (0.12, 0.16, z + 0.004)),
                 box((-0.12, -0.16, z + 0.004), (-0.115, 0.16, z + 0.065)),
                 box((0.115, -0.16, z + 0.004), (0.12, 0.16, z + 0.065)))
        tray.add("Paper", box((-0.105, -0.15, z + 0.004),
                              (0.105, 0.147, z + 0.004 + rng.uniform(0.004, 0.03))))

    desks.desk(scene.object("Desk3", (W - 0.42, 4.45, 0), turn=-90), drawers=-1)
    seating.office_chair(scene.object("Seat3", (W - 1.14, 4.42, 0), turn=-62), "TealCloth",
                         arms=False)
    desks.monitor(scene.object("Monitor3", (W - 0.24, 4.40, top), turn=-86), "ScreenGlowDim")
    desks.keyboard(scene.object("Keyboard3", (W - 0.58, 4.42, top), turn=-90), compact=True)
    desks.mouse(scene.object("Mouse3", (W - 0.60, 4.16, top), turn=-95))
    pile = scene.object("BookPile", (W - 0.36, 3.88, top), turn=-80)
    z = 0.0
    for w, d, h, c in ((0.24, 0.17, 0.03, "BookBlue"), (0.22, 0.16, 0.024, "BookCream"),
                       (0.21, 0.15, 0.036, "BookRed"), (0.19, 0.13, 0.02, "BookGrey")):
        book = box((-w / 2, -d / 2, 0), (w / 2, d / 2, h))
        pile.add(c, book.turned("z", rng.uniform(-14, 14)).moved(z=z))
        z += h


def storage_wall(scene, rng):
    shelved = random.Random(BOOK_SEED)
    for k, y in enumerate((3.12, 2.21)):
        case = scene.object(f"Bookcase{k + 1}", (W - 0.014, y, 0), turn=-90)
        storage.bookcase(case, shelved, fill=0.70)
    storage.globe(scene.object("Globe", (W - 0.18, 2.35, 2.0)))
    # Box files on top of the other bookcase.
    files = scene.object("BoxFiles", (W - 0.19, 3.12, 2.0), turn=-90)
    for k, c in enumerate(("Kraft", "BookGrey", "Kraft", "BookBlue")):
        files.add(c, box((-0.30 + 0.10 * k, -0.13, 0), (-0.215 + 0.10 * k, 0.13, 0.31)))
    storage.picture(scene.object("Picture1", (W, 4.05, 1.62), turn=-90), rng, 0.70, 0.52, "Oak",
                    ("PaintRed", "PaintSand", "PaintTeal", "PaintWhite", "PaintBlack"), 7)
    storage.picture(scene.object("Picture2", (W, 4.88, 1.68), turn=-90), rng, 0.46, 0.62, "Oak",
                    ("PaintYellow", "PaintBlue", "PaintWhite", "PaintPink"), 6)
    storage.picture(scene.object("Picture3", (0.78, D, 1.62)), rng, 0.56, 0.76, "Walnut",
                    ("PaintYellow", "PaintRed", "PaintWhite", "PaintBlack", "PaintSand"), 9)
    storage.wall_clock(scene.object("Clock", (6.1, D, 1.95)))
    pin_board(scene.object("PinBoard", (0, 3.1, 1.5), turn=90), rng)


def pin_board(obj, rng):
    """Cork board with notes, on the wall y = 0, seen from -y."""
    obj.add("Oak", box((-0.62, -0.018, -0.42), (0.62, 0, 0.42)))
    obj.add("Cork", sheet([(-0.59, -0.019, -0.39), (0.59, -0.019, -0.39), (0.59, -0.019, 0.39),
                           (-0.59, -0.019, 0.39)]))
    for i in range(5):
        for j in range(2):
            w, h = rng.uniform(0.07, 0.10), rng.uniform(0.07, 0.13)
            x = -0.46 + 0.23 * i + rng.uniform(-0.03, 0.03)
            z = -0.18 + 0.36 * j + rng.uniform(-0.04, 0.04)
            colour = rng.choice(("Paper", "Paper", "PaintYellow", "PaintPink"))
            note = box((-w, -0.0205, -h), (w, -0.0195, h)).turned("y", rng.uniform(-6, 6))
            obj.add(colour, note.moved(x=x, z=z))


def reading_corner(scene, rng):
    rug = scene.object("Rug", (4.95, 1.30, 0), turn=4)
    # Woven stripes: bands side by side, all of one height.
    edges = (-1.2, -1.06, -1.02, -0.96, -0.92, 0.92, 0.96, 1.02, 1.06, 1.2)
    for k, (a, b) in enumerate(zip(edges, edges[1:])):
        rug.add("RugRed" if k % 2 else "RugCream", box((a, -0.82, 0), (b, 0.82, 0.008)))
    seating.armchair(scene.object("Armchair", (5.45, 1.22, 0.008), turn=52), "MustardCloth",
                     "Walnut")
    seating.lounge_table(scene.object("SideTable", (4.62, 1.62, 0.008)), "Walnut", "DarkSteel")
    desks.mug(scene.object("Mug2", (4.72, 1.72, 0.428), turn=200), "ChinaWhite", filled=False)
    magazines = scene.object("Magazines", (4.52, 1.55, 0.428), turn=25)
    for k, c in enumerate(("BookRed", "Paper", "BookBlue")):
        issue = box((-0.105, -0.14, 0), (0.105, 0.14, 0.006))
        magazines.add(c, issue.turned("z", 11 * k - 8).moved(z=0.006 * k))
    fixtures.floor_lamp(scene.object("FloorLamp", (6.45, 0.55, 0)))
    storage.floor_plant(scene.object("Plant1", (1.15, 4.72, 0)), rng)
    storage.floor_plant(scene.object("Plant2", (6.70, 1.48, 0)), rng, height=1.15, leaves=24)
    storage.bin_basket(scene.object("Bin1", (1.68, 3.05, 0)))
    storage.bin_basket(scene.object("Bin2", (5.98, 5.13, 0)), "GreyPlastic")
    balls = scene.object("PaperBalls", (1.82, 2.28, 0))
    balls.add("Paper", storage.crumpled(rng, 0.035))


def build():
    rng = random.Random(7155)
    scene = Scene("office",
                  "Penumbra office: a studio at night. Luminances in nits, lengths in metres.")
    scene.camera("Camera", (0.55, 0.42, 1.62), (3.95, 3.35, 0.98), 21)
    scene.camera("DeskCamera", (1.62, 1.85, 1.38), (2.72, 3.05, 0.86), 24)
    shell(scene)
    fittings(scene)
    workplaces(scene, rng)
    storage_wall(scene, rng)
    reading_corner(scene, rng)
    return scene
