"""A layer that animates a scene: it sublayers the scene's file and holds time samples only."""

import copy

from .usda import Prim, aim, array_text, number, tuple_text


class Layer:
    """Frames are time codes, from 1. What isn't given at a frame is not written: USD draws a line
    between the samples beside it."""

    def __init__(self, name, base, frames, per_second, doc):
        self.name, self.base, self.doc = name, base, doc
        self.frames = range(1, frames + 1)
        self.per_second = per_second   # frames played in a second
        self.poses = {}     # object name -> frame -> (place, turn about z [degrees])
        self.eyes = {}      # camera name -> frame -> (place, angles about x, y, z [degrees])
        self.lights = {}    # (object name, light name) -> input -> frame -> value

    def pose(self, name, frame, at, turn=None):
        """Puts an object somewhere; without a turn it keeps that of the scene."""
        base = self.base.find(name)
        place = tuple(round(c, 4) + 0.0 for c in at)
        turn = base.turn if turn is None else round(turn, 4)
        self.poses.setdefault(name, {})[frame] = (place, turn)

    def look(self, name, frame, eye, target):
        place = tuple(round(c, 4) + 0.0 for c in eye)
        self.eyes.setdefault(name, {})[frame] = (place, aim(eye, target))

    def light(self, obj, name, frame, **inputs):
        """intensity [nit], colorTemperature [K]"""
        for key, value in inputs.items():
            track = self.lights.setdefault((obj, name), {}).setdefault(key, {})
            track[frame] = round(value, 1)

    def posed(self, frame):
        """The scene's objects as they stand at a frame; what doesn't move is the scene's own."""
        found = []
        for obj in self.base.objects:
            if obj.name in self.poses:
                obj = copy.copy(obj)
                obj.at, obj.turn = self.poses[obj.name][frame]
            found.append(obj)
        return found

    def text(self):
        world = Prim(None, "World")
        for name, track in self.eyes.items():
            camera = world.add(Prim(None, name))
            camera.animate("xformOp:translate", "double3", thinned(places(track), tuple_text))
            camera.animate("xformOp:rotateXYZ", "float3", thinned(turns(track), tuple_text))
        for obj in self.base.objects:
            prim = Prim(None, obj.name)
            if obj.name in self.poses:
                self.write_pose(prim, obj)
            for light in obj.lights:
                if (obj.name, light.name) in self.lights:
                    below = prim.add(Prim(None, light.name))
                    for key, track in self.lights[obj.name, light.name].items():
                        below.animate(f"inputs:{key}", "float", thinned(track, number))
            if prim.properties or prim.children:
                world.add(prim)
        out = ["#usda 1.0", "(", '    defaultPrim = "World"', f'    doc = """{self.doc}"""',
               f"    endTimeCode = {self.frames[-1]}", "    metersPerUnit = 1",
               f"    startTimeCode = {self.frames[0]}", "    subLayers = [",
               f"        @./{self.base.name}.usda@", "    ]",
               f"    timeCodesPerSecond = {self.per_second}", '    upAxis = "Z"', ")", ""]
        world.write(out)
        return "\n".join(out) + "\n"

    def write_pose(self, prim, obj):
        track = self.poses[obj.name]
        prim.animate("xformOp:translate", "double3", thinned(places(track), tuple_text))
        if len(set(turns(track).values())) == 1:
            return
        prim.animate("xformOp:rotateZ", "float", thinned(turns(track), number))
        if not obj.turn:   # the scene's file lists no turn
            order = array_text(('"xformOp:translate"', '"xformOp:rotateZ"'))
            prim.set("xformOpOrder", "uniform token[]", order)


def places(track):
    return {frame: place for frame, (place, _) in track.items()}


def turns(track):
    return {frame: turn for frame, (_, turn) in track.items()}


def thinned(track, text):
    """Samples as text, without those that lie in a stretch of equal ones."""
    frames = sorted(track)
    kept = {}
    for k, frame in enumerate(frames):
        beside = [track[f] for f in frames[max(k - 1, 0):k + 2] if f != frame]
        if k in (0, len(frames) - 1) or any(v != track[frame] for v in beside):
            kept[frame] = text(track[frame])
    return kept
