"""Writing USD text the way OpenUSD's own tools lay it out, and the scene model behind it."""

import math
from dataclasses import dataclass

from . import looks, vec
from .part import Part


def number(value):
    """Shortest form with four decimals: lengths to 0.1 mm."""
    text = f"{value:.4f}".rstrip("0").rstrip(".")
    return "0" if text in ("-0", "") else text


def tuple_text(values):
    return "(" + ", ".join(number(v) for v in values) + ")"


def array_text(items):
    return "[" + ", ".join(items) + "]"


class Prim:
    """One prim: metadata, properties and children; of kind None, an `over`. Properties are written
    sorted by name, as OpenUSD does, so they may be added in any order."""

    def __init__(self, kind, name, meta=()):
        self.kind, self.name, self.meta = kind, name, list(meta)
        self.properties, self.children = {}, []

    def set(self, name, declaration, value):
        self.properties[name] = f"{declaration} {name}" + (f" = {value}" if value != "" else "")

    def animate(self, name, declaration, samples):
        """samples: frame -> text of the value."""
        lines = [f"{declaration} {name}.timeSamples = {{"]
        lines += [f"    {frame}: {value}," for frame, value in sorted(samples.items())]
        self.properties[name] = "\n".join(lines + ["}"])

    def add(self, prim):
        assert all(c.name != prim.name for c in self.children), f"second {prim.name} in {self.name}"
        self.children.append(prim)
        return prim

    def place(self, at=(0, 0, 0), turn=0.0, tilt=None):
        """Translation, then a turn about z, or three angles (x innermost) when tilted."""
        order = []
        if any(abs(c) > 5e-5 for c in at):
            self.set("xformOp:translate", "double3", tuple_text(at))
            order.append("xformOp:translate")
        if tilt is not None:
            self.set("xformOp:rotateXYZ", "float3", tuple_text(tilt))
            order.append("xformOp:rotateXYZ")
        elif turn:
            self.set("xformOp:rotateZ", "float", number(turn))
            order.append("xformOp:rotateZ")
        if order:
            names = array_text(f'"{o}"' for o in order)
            self.set("xformOpOrder", "uniform token[]", names)

    def write(self, out, depth=0):
        pad = "    " * depth
        head = pad + (f'def {self.kind}' if self.kind else "over") + f' "{self.name}"'
        if self.meta:
            out.append(head + " (")
            out.extend(f"{pad}    {m}" for m in self.meta)
            out.append(pad + ")")
        else:
            out.append(head)
        out.append(pad + "{")
        for name in sorted(self.properties, key=str.lower):
            out.extend(f"{pad}    {line}" for line in self.properties[name].splitlines())
        for k, child in enumerate(self.children):
            if k or self.properties:
                out.append("")
            child.write(out, depth + 1)
        out.append(pad + "}")


@dataclass
class Light:
    """A UsdLux area light in its object's frame; it emits along its own -z."""
    kind: str
    name: str
    at: tuple
    nits: float
    size: dict
    kelvin: float
    tilt: tuple | None

    def prim(self):
        prim = Prim(self.kind, self.name)
        for key, value in self.size.items():
            prim.set(f"inputs:{key}", "float", number(value))
        prim.set("inputs:intensity", "float", number(self.nits))
        prim.set("inputs:enableColorTemperature", "bool", "1")
        prim.set("inputs:colorTemperature", "float", number(self.kelvin))
        prim.place(self.at, tilt=self.tilt)
        return prim

    def area(self):
        if self.kind == "RectLight":
            return self.size["width"] * self.size["height"]
        return math.pi * self.size["radius"] ** 2 * (4 if self.kind == "SphereLight" else 1)

    def outline(self, n=24):
        """Polygon of a flat light in its object's frame, counter-clockwise from its bright side."""
        if self.kind == "RectLight":
            x, y = self.size["width"] / 2, self.size["height"] / 2
            ring = [(-x, y, 0), (x, y, 0), (x, -y, 0), (-x, -y, 0)]
        else:
            ring = [vec.rotate((self.size["radius"], 0, 0), "z", -360 * i / n) for i in range(n)]
        for axis, angle in zip("xyz", self.tilt or (0, 0, 0)):
            ring = [vec.rotate(p, axis, angle) for p in ring]
        return [vec.add(p, self.at) for p in ring]


class Object:
    """One Xform of the scene: parts by material, lights, and where it stands."""

    def __init__(self, name, at, turn, movable):
        self.name, self.at, self.turn, self.movable = name, at, turn, movable
        self.parts = {}    # (material, double_sided) -> finished parts
        self.cages = []    # (material, Part, creases)
        self.lights = []

    def add(self, material, *parts, double_sided=False):
        assert material in looks.REFLECTANCE or material in looks.LUMINANCE, material
        for part in parts:
            items = part if isinstance(part, list) else [part]
            self.parts.setdefault((material, double_sided), []).extend(p.finished() for p in items)
        return self

    def add_subdivision(self, material, part, creases=()):
        """Catmull-Clark cage. creases: (vertex path, sharpness); 10 is infinitely sharp."""
        self.cages.append((material, part, list(creases)))
        return self

    def light(self, kind, name, at, nits, size, kelvin=6500, tilt=None):
        """RectLight (width, height), DiskLight or SphereLight (radius), coloured by kelvin."""
        self.lights.append(Light(kind, name, at, nits, size, kelvin, tilt))
        return self

    def all_parts(self):
        return [p for parts in self.parts.values() for p in parts]

    def world(self, p):
        return vec.add(vec.rotate(p, "z", self.turn), self.at)

    def prim(self):
        xform = Prim("Xform", self.name, ['kind = "component"'])
        if self.movable:
            xform.set("penumbra:movable", "custom uniform bool", "1")
        xform.place(self.at, self.turn)
        names = {}
        for (material, double_sided), parts in self.parts.items():
            count = names[material] = names.get(material, 0) + 1
            name = material if count == 1 else f"{material}{count}"
            xform.add(mesh_prim(name, material, merged(parts), double_sided))
        for material, part, creases in self.cages:
            xform.add(mesh_prim(material, material, part, False, creases))
        for light in self.lights:
            xform.add(light.prim())
        return xform


def merged(parts):
    points, faces = [], []
    for part in parts:
        faces.extend(tuple(i + len(points) for i in f) for f in part.faces)
        points.extend(part.points)
    return Part(points, faces)


def mesh_prim(name, material, part, double_sided, creases=None):
    mesh = Prim("Mesh", name, ['prepend apiSchemas = ["MaterialBindingAPI"]'])
    if double_sided:
        mesh.set("doubleSided", "uniform bool", "1")
    low = [min(p[k] for p in part.points) for k in range(3)]
    high = [max(p[k] for p in part.points) for k in range(3)]
    mesh.set("extent", "float3[]", array_text([tuple_text(low), tuple_text(high)]))
    mesh.set("faceVertexCounts", "int[]", array_text(str(len(f)) for f in part.faces))
    mesh.set("faceVertexIndices", "int[]", array_text(str(i) for f in part.faces for i in f))
    mesh.set("material:binding", "rel", f"</World/Looks/{material}>")
    mesh.set("points", "point3f[]", array_text(tuple_text(p) for p in part.points))
    scheme = "none" if creases is None else "catmullClark"
    mesh.set("subdivisionScheme", "uniform token", f'"{scheme}"')
    if creases:
        mesh.set("creaseIndices", "int[]", array_text(str(i) for path, _ in creases for i in path))
        mesh.set("creaseLengths", "int[]", array_text(str(len(path)) for path, _ in creases))
        mesh.set("creaseSharpnesses", "float[]", array_text(number(s) for _, s in creases))
    return mesh


def aim(eye, target):
    """Angles about x, y, z [degrees, x innermost] of a camera, which looks along its own -z with +y
    up: pitch about x first, then heading about z."""
    d = vec.sub(target, eye)
    pitch = math.degrees(math.atan2(d[2], math.hypot(d[0], d[1])))
    heading = math.degrees(math.atan2(d[1], d[0])) - 90
    return (round(90 + pitch, 2), 0, round(heading, 2))


class Scene:
    def __init__(self, name, doc):
        self.name, self.doc = name, doc
        self.objects, self.cameras = [], []
        self.patch_size = None   # longest edge of a patch that the file asks for [m]
        self.air = []   # boxes (low, high) whose union is the room's air: walls look into it

    def object(self, name, at=(0, 0, 0), turn=0.0, movable=True):
        assert all(o.name != name for o in self.objects), name
        self.objects.append(Object(name, at, turn, movable))
        return self.objects[-1]

    def find(self, name):
        return next(o for o in self.objects if o.name == name)

    def camera(self, name, eye, target, focal, aperture=(36, 20.25)):
        prim = Prim("Camera", name)
        prim.set("clippingRange", "float2", "(0.02, 200)")
        prim.set("focalLength", "float", number(focal))
        prim.set("horizontalAperture", "float", number(aperture[0]))
        prim.set("verticalAperture", "float", number(aperture[1]))
        prim.place(eye, tilt=aim(eye, target))
        self.cameras.append((prim, eye, target, focal, aperture))

    def polygons(self):
        return (sum(len(p.faces) for o in self.objects for p in o.all_parts())
                + sum(len(c[1].faces) for o in self.objects for c in o.cages))

    def text(self):
        world = Prim("Xform", "World", ['kind = "group"'])
        if self.patch_size:
            world.set("penumbra:patchSize", "custom uniform double", number(self.patch_size))
        used = []
        for o in self.objects:
            used += [m for m, _ in o.parts] + [c[0] for c in o.cages]
        scope = world.add(Prim("Scope", "Looks"))
        for name in sorted(set(used)):
            scope.add(material_prim(name))
        for prim, *_ in self.cameras:
            world.add(prim)
        for o in self.objects:
            world.add(o.prim())
        out = ["#usda 1.0", "(", '    defaultPrim = "World"', f'    doc = """{self.doc}"""',
               "    metersPerUnit = 1", '    upAxis = "Z"', ")", ""]
        world.write(out)
        return "\n".join(out) + "\n"


def material_prim(name):
    material = Prim("Material", name)
    path = f"/World/Looks/{name}/Surface.outputs:surface"
    material.properties["outputs:surface"] = f"token outputs:surface.connect = <{path}>"
    shader = material.add(Prim("Shader", "Surface"))
    shader.set("info:id", "uniform token", '"UsdPreviewSurface"')
    shader.set("inputs:diffuseColor", "color3f", tuple_text(looks.REFLECTANCE.get(name, (0, 0, 0))))
    if name in looks.LUMINANCE:
        shader.set("inputs:emissiveColor", "color3f", tuple_text(looks.LUMINANCE[name]))
    shader.set("inputs:metallic", "float", "0")
    shader.set("inputs:roughness", "float", "1")
    shader.set("outputs:surface", "token", "")
    return material
