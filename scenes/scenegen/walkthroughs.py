"""The animated layers: what a person would do in each scene within a few seconds."""

from .layer import Layer
from .motion import Curve, between, blend, stroll


def chamber_move(chamber):
    """The tall box is pushed along the wall; its shadow sweeps wall and floor."""
    layer = Layer("chamber-move", chamber, 49, 16,
                  "Penumbra chamber: the tall box is pushed along the wall.")
    box = chamber.find("TallBox")
    way = Curve(box.at, (1.95, 3.42, 0), (2.65, 3.32, 0), (3.2, 3.4, 0))
    for frame in layer.frames:
        done = between(frame, 1, 49)
        layer.pose("TallBox", frame, way.at(done), blend(box.turn, 75, done))
    return layer


def office_seat(office):
    """The seat is pushed back from the desk and rolled around its corner, to stand by the bin."""
    layer = Layer("office-seat", office, 48, 16,
                  "Penumbra office: the seat is rolled around the desk.")
    seat = office.find("Seat")
    way = Curve(seat.at, (2.62, 1.90, 0), (1.90, 1.72, 0), (1.18, 2.55, 0), (1.46, 3.68, 0))
    for frame in layer.frames:
        layer.pose("Seat", frame, way.at(between(frame, 1, 48)),
                   blend(seat.turn, -125, between(frame, 6, 46)))
    return layer


def office_lamp(office):
    """The desk lamp is slid along the desk and turned; then dimmed; then it shines white; at last
    it is turned back, still white, and bright again."""
    layer = Layer("office-lamp", office, 48, 24,
                  "Penumbra office: the desk lamp is moved, dimmed and recoloured.")
    lamp = office.find("DeskLamp")
    bulb = lamp.lights[0]
    x, y, z = lamp.at
    way = Curve(lamp.at, (x + 0.12, y + 0.05, z), (x + 0.25, y + 0.03, z))
    for frame in layer.frames:
        turn = blend(lamp.turn, -84, between(frame, 1, 20))
        layer.pose("DeskLamp", frame, way.at(between(frame, 1, 18)),
                   blend(turn, -50, between(frame, 37, 48)))
        dimmed = blend(bulb.nits, 12000, between(frame, 21, 27))
        layer.light("DeskLamp", "Bulb", frame,
                    intensity=blend(dimmed, 36000, between(frame, 40, 46)),
                    colorTemperature=blend(bulb.kelvin, 5600, between(frame, 29, 35)))
    return layer


def office_ceiling(office):
    """The middle ceiling lamp is moved over the desks, switched off, on at half, and turned up."""
    layer = Layer("office-ceiling", office, 48, 24,
                  "Penumbra office: a ceiling lamp is moved, switched and turned up.")
    lamp = office.find("CeilingLamp2")
    panel = lamp.lights[0]
    x, y, z = lamp.at
    for frame in layer.frames:
        done = between(frame, 1, 24)
        layer.pose("CeilingLamp2", frame, (blend(x, 2.75, done), blend(y, 3.15, done), z))
        share = 1.0 if frame < 28 else 0.0 if frame < 36 else blend(0.5, 1, between(frame, 38, 46))
        layer.light("CeilingLamp2", "Panel", frame, intensity=panel.nits * share)
    return layer


def gallery_walk(gallery):
    """A visitor walks from the first hall into the great one. On the way the bronze head is turned
    towards them, the pierced cube is pushed aside on its plinth, and a spot
    follows it along the ceiling."""
    layer = Layer("gallery-walk", gallery, 49, 6,
                  "Penumbra gallery: a walk into the great hall; two sculptures and a spot move.")
    steps = Curve((6.3, 0.9, 1.65), (8.2, 3.4, 1.65), (9.9, 6.2, 1.65), (10.2, 8.6, 1.65),
                  (10.9, 10.2, 1.65))
    gaze = Curve((9.95, 7.6, 1.5), (10.6, 9.4, 1.45), (11.3, 12.0, 1.4), (11.6, 14.2, 1.35))
    head, cube, plinth = (gallery.find(n) for n in ("Head", "PiercedCube", "Plinth6"))
    spot = gallery.find("Spot2")
    for frame in layer.frames:
        walked = stroll((frame - 1) / 48)
        layer.look("Camera", frame, steps.at(walked), gaze.at(walked))
        layer.pose("Head", frame, head.at, blend(head.turn, -130, between(frame, 4, 24)))
        aside = blend(0, 1.4, between(frame, 22, 44))
        for obj in (plinth, cube):
            layer.pose(obj.name, frame, (obj.at[0] + aside, obj.at[1] - 0.3 * aside, obj.at[2]))
        drawn = between(frame, 20, 46)
        layer.pose("Spot2", frame, (spot.at[0] + 0.2 * drawn, spot.at[1] + 1.2 * drawn, spot.at[2]),
                   blend(spot.turn, 55, drawn))
    return layer


def build(scenes):
    """\\param scenes by name"""
    return [chamber_move(scenes["chamber"]), office_seat(scenes["office"]),
            office_lamp(scenes["office"]), office_ceiling(scenes["office"]),
            gallery_walk(scenes["gallery"])]
