"""Checks of a layer, frame by frame: every complaint is one line."""

from . import vec
from .check_model import Body, meeting

STEP = 0.15       # farthest that a thing goes in a frame [m]
TURN = 12.0       # and turns [degrees]
WALK = 0.30       # farthest that a camera goes in a frame [m]
LOOK = 6.0        # and turns [degrees]


def complaints(layer):
    found = [f"{layer.name}: {name} moves but is not movable in {layer.base.name}"
             for name in layer.poses if not layer.base.find(name).movable]
    for name, track in layer.poses.items():
        obj = layer.base.find(name)
        place, turn = track[min(track)]
        if vec.length(vec.sub(place, obj.at)) > 1e-4 or turn != obj.turn:
            found.append(f"{layer.name}: {name} does not begin where it stands in the scene")
    tracks = [(layer.poses, STEP, TURN), (layer.eyes, WALK, LOOK)]
    for named, step, turn in tracks:
        for name, track in named.items():
            found += [f"{layer.name}: {name}: {c}" for c in jumps(layer, track, step, turn)]
    return found + contact_complaints(layer)


def jumps(layer, track, step, turn):
    if sorted(track) != list(layer.frames):
        return ["has frames without a place"]
    found = []
    for before, after in zip(layer.frames, layer.frames[1:]):
        (p, a), (q, b) = track[before], track[after]
        if vec.length(vec.sub(q, p)) > step:
            found.append(f"goes {vec.length(vec.sub(q, p)):.2f} m from frame {before} to {after}")
        swing = max(abs(x - y) for x, y in zip(angles(a), angles(b)))
        if swing > turn:
            found.append(f"turns {swing:.1f} degrees from frame {before} to {after}")
    return found


def angles(turn):
    return turn if isinstance(turn, tuple) else (turn,)


def contact_complaints(layer):
    """At every frame what moves pierces nothing and touches something."""
    if any(sorted(track) != list(layer.frames) for track in layer.poses.values()):
        return []   # said already
    bodies = {o.name: Body(o) for o in layer.base.objects if o.parts or o.cages}
    found = []
    for frame in layer.frames:
        bodies.update((o.name, Body(o)) for o in layer.posed(frame) if o.name in layer.poses)
        for name in layer.poses:
            touching = False
            for other in bodies.values():
                if other.name == name:
                    continue
                problems, contact = meeting(bodies[name], other)
                touching |= contact
                found += [f"{layer.name}, frame {frame}: {text}" for text in problems]
            if not touching:
                found.append(f"{layer.name}, frame {frame}: {name} touches nothing")
    return found
