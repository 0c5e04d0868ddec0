"""Catmull-Clark subdivision with semi-sharp creases, as OpenSubdiv's default options define it.

The scene files hold cages only. The generator subdivides them itself to learn where the smooth
surface really ends: a sculpture has to stand on its plinth with its surface, not with its cage.

Catmull & Clark 1978; semi-sharp creases: DeRose, Kass & Truong, SIGGRAPH 1998.
"""

from . import vec
from .part import Part


def subdivide(part, creases=(), levels=2):
    """part: closed mesh. creases: (vertex path, sharpness). Returns the refined Part."""
    points, faces = part.points, part.faces
    sharp = {}
    for path, sharpness in creases:
        for a, b in zip(path, path[1:]):
            sharp[_key(a, b)] = sharpness
    for _ in range(levels):
        points, faces, sharp = _refine(points, faces, sharp)
    return Part(points, faces, part.solid)


def _key(a, b):
    return (a, b) if a < b else (b, a)


def _refine(points, faces, sharp):
    face_points = [vec.mean([points[i] for i in f]) for f in faces]
    edge_faces, vertex_faces, vertex_edges = {}, {}, {}
    for k, face in enumerate(faces):
        for i, v in enumerate(face):
            edge = _key(v, face[(i + 1) % len(face)])
            edge_faces.setdefault(edge, []).append(k)
            vertex_faces.setdefault(v, []).append(k)
    for edge in edge_faces:
        for v in edge:
            vertex_edges.setdefault(v, []).append(edge)

    edge_points = {}
    for edge, sides in edge_faces.items():
        a, b = points[edge[0]], points[edge[1]]
        middle = vec.lerp(a, b, 0.5)
        smooth = vec.mean([a, b] + [face_points[k] for k in sides])
        edge_points[edge] = vec.lerp(smooth, middle, min(1.0, sharp.get(edge, 0.0)))

    moved = []
    for v, p in enumerate(points):
        edges = vertex_edges[v]
        n = len(edges)
        q = vec.mean([face_points[k] for k in vertex_faces[v]])
        r = vec.mean([vec.lerp(points[a], points[b], 0.5) for a, b in edges])
        smooth = vec.mul(vec.add(vec.add(q, vec.mul(r, 2)), vec.mul(p, n - 3)), 1 / n)
        creased = [e for e in edges if sharp.get(e, 0) > 0]
        if len(creased) < 2:
            moved.append(smooth)
            continue
        if len(creased) == 2:
            ends = [points[a if b == v else b] for a, b in creased]
            rule = vec.add(vec.mul(p, 0.75), vec.mul(vec.add(ends[0], ends[1]), 0.125))
        else:
            rule = p   # three creases make a corner
        weight = min(1.0, sum(sharp[e] for e in creased) / len(creased))
        moved.append(vec.lerp(smooth, rule, weight))

    edge_index, first_face = {}, len(points)
    new_points = moved + face_points
    for edge, p in edge_points.items():
        edge_index[edge] = len(new_points)
        new_points.append(p)
    new_faces = []
    for k, face in enumerate(faces):
        for i, v in enumerate(face):
            after = edge_index[_key(v, face[(i + 1) % len(face)])]
            before = edge_index[_key(face[i - 1], v)]
            new_faces.append((v, after, first_face + k, before))
    new_sharp = {}
    for edge, s in sharp.items():
        left = s if s >= 10 else s - 1   # 10 means infinitely sharp and stays so
        if left > 0:
            for v in edge:
                new_sharp[_key(v, edge_index[edge])] = left
    return new_points, new_faces, new_sharp
