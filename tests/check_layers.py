#!/usr/bin/env python3
"""Checks the layer order: which folder may include what. Usage: check_layers.py [PROJECT_ROOT]"""
import pathlib
import re
import sys

# Folders whose headers a folder may include, besides its own. tests/ and bench/ may see everything.
MAY_SEE = {
    "scenegraph": set(),
    "importance": {"scenegraph"},
    "radiosity": {"importance", "scenegraph"},
    "io": {"scenegraph"},
    "viewer": {"io", "radiosity", "importance", "scenegraph"},
    "comparison": {"io", "radiosity", "importance", "scenegraph"},
    "tools": {"comparison", "viewer", "io", "radiosity", "importance", "scenegraph"},
}
# Third-party headers (by how their path begins) that one folder keeps to itself, in its .cpp files.
HOME = {
    "boost/": "radiosity", "embree": "radiosity", "opensubdiv/": "radiosity",
    "tbb/": "radiosity", "oneapi/": "radiosity",
    "OpenEXR/": "io", "Imf": "io", "Imath": "io", "png.h": "io",
    "epoxy/": "viewer", "EGL/": "viewer", "GL/": "viewer", "GLFW/": "viewer",
    "imgui": "viewer", "backends/imgui": "viewer",
    "CLI/": "tools", "nlohmann/": "tools",
}
INCLUDE = re.compile(r'^\s*#\s*include\s*(["<])([^">]+)[">]', re.MULTILINE)


def faults(root):
    for folder, seen in MAY_SEE.items():
        sources = [p for p in (root / folder).rglob("*") if p.suffix in {".h", ".cpp"}]
        for path in sorted(sources):
            name = path.relative_to(root).as_posix()
            for quote, header in INCLUDE.findall(path.read_text(encoding="utf-8")):
                other = header.split("/")[0]
                home = next((HOME[start] for start in HOME if header.startswith(start)), None)
                if other in {*MAY_SEE, "tests", "bench"} - seen - {folder}:
                    yield f"{name}: {folder}/ may not include {other}/"
                elif quote == '"' and other not in MAY_SEE:
                    yield f'{name}: "{header}" does not begin with a folder of the project'
                elif home and home != folder:
                    yield f"{name}: only {home}/ may include <{header}>"
                elif home and path.suffix != ".cpp":
                    yield f"{name}: <{header}> belongs in a .cpp file"


if __name__ == "__main__":
    found = list(faults(pathlib.Path(sys.argv[1] if len(sys.argv) > 1 else ".")))
    print("\n".join(found) or "layers: all includes follow the order")
    sys.exit(1 if found else 0)
