"""Checks of a written file, read back as text: indices, counts, extents, binding targets."""

import re

NUMBER = r"-?[0-9.]+"


def complaints(name, text):
    found = []
    defined = set(re.findall(r'def Material "(\w+)"', text))
    for target in set(re.findall(r"material:binding = <([^>]*)>", text)):
        prefix, _, material = target.rpartition("/")
        if prefix != "/World/Looks" or material not in defined:
            found.append(f"{name}: nothing at binding target {target}")
    for path in set(re.findall(r"connect = <([^>]*)>", text)):
        if path.split("/")[3] not in defined:
            found.append(f"{name}: nothing at {path}")
    for block in re.split(r"def Mesh ", text)[1:]:
        found += [f"{name}: {block.split()[0]}: {c}" for c in mesh_complaints(block)]
    if text.count("{") != text.count("}") or "\t" in text or not text.isascii():
        found.append(f"{name}: braces, tabs or characters out of order")
    return found


def mesh_complaints(block):
    def integers(key):
        match = re.search(rf"int\[\] {key} = \[([^\]]*)\]", block)
        return [int(v) for v in match.group(1).split(",")] if match else []

    def triples(key):
        match = re.search(rf"{key} = \[([^\]]*)\]", block)
        values = [float(v) for v in re.findall(NUMBER, match.group(1))]
        return list(zip(values[::3], values[1::3], values[2::3]))
    counts, indices = integers("faceVertexCounts"), integers("faceVertexIndices")
    points, extent = triples("points"), triples("extent")
    found = []
    if sum(counts) != len(indices) or min(counts) < 3:
        found.append("faceVertexCounts do not fit faceVertexIndices")
    if min(indices) < 0 or max(indices) >= len(points) or len(set(indices)) != len(points):
        found.append("indices do not fit the points")
    if extent != [tuple(min(p[k] for p in points) for k in range(3)),
                  tuple(max(p[k] for p in points) for k in range(3))]:
        found.append("extent does not fit the points")
    lengths = integers("creaseLengths")
    sharp = re.search(r"creaseSharpnesses = \[([^\]]*)\]", block)
    if lengths and (sum(lengths) != len(integers("creaseIndices")) or min(lengths) < 2
                    or len(sharp.group(1).split(",")) != len(lengths)):
        found.append("creases do not fit")
    return found
