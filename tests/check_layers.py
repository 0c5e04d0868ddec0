#!/usr/bin/env python3
"""Checks the layer order: which room may include which. Usage: check_layers.py [PROJECT_ROOT]"""
import pathlib
import re
import sys

# Every room, and those whose headers it may include besides its own. What those may include, it may include as well.
# tests/ and bench/ may see everything.
USES = {
    "base": [],
    "scenegraph": ["base"],
    "importance": ["scenegraph"],
    "radiosity/rays": ["scenegraph"],
    "radiosity/surface": ["radiosity/rays"],
    "radiosity/clusters": ["radiosity/surface"],
    "radiosity/mesh": ["radiosity/clusters"],
    "radiosity/rows": ["radiosity/mesh"],
    "radiosity/schedule": ["radiosity/rows", "importance"],
    "radiosity/transport": ["radiosity/schedule"],
    "radiosity/query": ["radiosity/transport"],
    "radiosity/process/memory": ["base"],
    "radiosity/process/snapshot": ["radiosity/process/memory", "scenegraph"],
    "radiosity/process/store": ["radiosity/process/snapshot", "radiosity/transport"],
    "radiosity/process": ["radiosity/process/store", "radiosity/query"],
    "io/image": ["scenegraph"],
    "io/usd/layer": ["scenegraph"],
    "io/usd/text": ["io/usd/layer"],
    "io/usd/crate": ["io/usd/text"],
    "io/usd/compose": ["io/usd/layer"],
    "io/usd/stage": ["io/usd/compose"],
    "io/model": ["io/usd/layer"],
    "io/usd/shade": ["io/usd/stage", "io/image"],
    "io/usd/scene": ["io/usd/shade", "io/usd/crate", "io/model"],
    "io/usd/recording": ["io/usd/scene"],
    "comparison": ["radiosity/process", "io/usd/scene"],
    "viewer/preview": ["radiosity/process"],
    "viewer/input": ["viewer/preview", "io/usd/scene"],
    "viewer/gl": ["viewer/preview", "io/image"],
    "viewer/shadowmaps": ["viewer/gl"],
    "viewer/overlay": ["viewer/gl"],
    "viewer/panels": ["viewer/overlay", "viewer/input"],
    "viewer/app": ["viewer/panels", "viewer/shadowmaps", "io/usd/recording"],
    "tools": ["viewer/app", "comparison"],
}
# Third-party headers (by how their path begins) that a room, or some, keep to themselves, in their .cpp files.
HOME = {
    "tbb/": "base", "oneapi/": "base", "boost/": "radiosity/process", "embree": "radiosity/rays",
    "opensubdiv/": "radiosity/surface",
    "OpenEXR/": "io/image", "OpenImageIO/": "io/image", "Imf": "io/image", "Imath": "io/image", "png.h": "io/image", "jpeglib.h": "io/image",
    "epoxy/": "viewer", "EGL/": "viewer", "GL/": "viewer", "GLFW/": "viewer",
    "imgui": "viewer/panels", "backends/imgui": "viewer/panels",
    "lz4": "io/usd/crate", "assimp/": "io/model", "CLI/": "tools", "nlohmann/": ("io/model", "tools"),
}
MOST_FILES = 35  # in a room
INCLUDE = re.compile(r'^\s*#\s*include\s*(["<])([^">]+)[">]', re.MULTILINE)


def seen(room):
    """All that a room may include. A circle in USES would not end: the order itself is checked by that."""
    return {room}.union(*(seen(other) for other in USES[room]))


def faults(root):
    for room in USES:
        may_see = seen(room)
        sources = [p for p in sorted((root / room).glob("*")) if p.suffix in {".h", ".cpp"}]
        if len(sources) > MOST_FILES:
            yield f"{room}/: {len(sources)} files are more than {MOST_FILES}: is there a second idea in it?"
        for path in sources:
            name = path.relative_to(root).as_posix()
            for quote, header in INCLUDE.findall(path.read_text(encoding="utf-8")):
                other = header.rpartition("/")[0]
                home = next((HOME[start] for start in HOME if header.startswith(start)), ())
                home = (home,) if isinstance(home, str) else home
                if header.split("/")[0] in {"tests", "bench"} or (other in USES and other not in may_see):
                    yield f"{name}: {room}/ may not include {other}/"
                elif quote == '"' and other not in USES:
                    yield f'{name}: "{header}" does not begin with a room of the project'
                elif home and not any(f"{room}/".startswith(f"{one}/") for one in home):
                    yield f"{name}: only {' and '.join(f'{one}/' for one in home)} may include <{header}>"
                elif home and path.suffix != ".cpp":
                    yield f"{name}: <{header}> belongs in a .cpp file"
    for top in sorted({room.split("/")[0] for room in USES}):
        for path in sorted((root / top).rglob("*.*")):
            room = path.parent.relative_to(root).as_posix()
            if path.suffix in {".h", ".cpp"} and room not in USES:
                yield f"{path.relative_to(root).as_posix()}: {room}/ is no room: see USES"


if __name__ == "__main__":
    found = list(faults(pathlib.Path(sys.argv[1] if len(sys.argv) > 1 else ".")))
    print("\n".join(found) or "layers: all includes follow the order")
    sys.exit(1 if found else 0)
