"""Scenes and states of grains with corners, as docs/scenes.md and docs/states.md describe them."""
import collections
import hashlib
import re

import h5py
import numpy as np

# A kind of shape in the table of the page: for each key (default, smallest, largest), with None if the table gives
# none.
Kind = collections.namedtuple("Kind", "flat keys meaning")
NUMBER = r"[\d.]+"
OCTAHEDRON = [(1, 0, 0), (-1, 0, 0), (0, 1, 0), (0, -1, 0), (0, 0, 1), (0, 0, -1)]
FACES = [(x, y, z) if (x + y + z) % 2 == 0 else (x, z, y) for x in (0, 1) for y in (2, 3) for z in (4, 5)]
FORMATS = ("off", "obj", "stl", "csv", "shp")


def number(text):
    return float(text) if "." in text else int(text)


def kinds_in_table(rows):
    out = {}
    for kind, keys, meaning in rows:
        found = {}
        for key, note in re.findall(r"`(\w+)`(?: \(((?:`[^`]*`|[^)`])*)\))?", keys):
            default = re.match(rf"`\[(\d+), (\d+)\]`|({NUMBER}),", note)
            ends = re.search(rf"({NUMBER}) to ({NUMBER})", note)
            most = re.search(rf"up to ({NUMBER})", note)
            value = None
            if default:
                value = number(default[3]) if default[3] else [int(default[1]), int(default[2])]
            found[key] = (value, number(ends[1]) if ends else None, number((ends and ends[2] or most[1])) if ends or most
                          else None)
        out[re.match(r"`\"(\w+)\"`", kind)[1]] = Kind("(2D)" in kind, found, meaning)
    return out


def toml(value):
    if isinstance(value, str):
        return f'"{value}"'
    return repr(value)


def scene(shape, dimension):
    keys = ", ".join(f"{key} = {toml(value)}" for key, value in shape.items())
    return f"""[scene]
dimension = {dimension}
units = "reduced"
[grains]
count = {12 if dimension == 2 else 16}
diameter = {{distribution = "uniform", min = 0.5, max = 1.0}}
shape = {{{keys}}}
[contact]
normal = {{law = "rigid"}}
friction = {{coefficient = 0.5}}
[cell]
solid_fraction = 0.005
[assembly]
protocol = "direct"
pressure = 1.0
"""


def valid(kind, points):
    """Returns a shape of this kind that is made quickly, with values for the keys without default."""
    return {"kind": kind, **{"polygon": {"sides": 5}, "box": {"sides": [1, 2]}, "hull": {"count": 4}, "cut": {"count": 4},
                             "voronoi": {"cells": 130, "count": 4}, "capsule": {"aspect": 2.0},
                             "file": {"file": points}}[kind]}


def further(kind, checksum):
    """Returns values for the other keys of this kind."""
    return {"polygon": {"rounding": 0.1}, "box": {"rounding": 0.1},
            "hull": {"vertices": [5, 9], "aspect": 2.0, "rounding": 0.1}, "cut": {"faces": 6, "spread": 0.2, "rounding": 0.1},
            "voronoi": {"relaxed": 3, "rounding": 0.1}, "capsule": {},
            "file": {"vertices": 4, "rounding": 0.1, "sha256": checksum}}[kind]


def cheap(shape, key):
    """Returns a cheaper shape if the largest value of a key takes long: Voronoi cells without relaxation."""
    return dict(shape, relaxed=0) if shape["kind"] == "voronoi" and key == "cells" else shape


def another(default):
    if isinstance(default, list):
        return [default[0] - 2, default[1] - 2]
    return default * 2 if isinstance(default, int) else 0.7 * default + 0.3


def write_files(points):
    """Writes files of points, and octahedra in every 3D format. @return checksum of the first file"""
    content = "x,y\n0,0\n1,0\n1,1\n0.5,1.5\n0,1\n"
    with open(points + ".csv", "w") as file:
        file.write(content)
    lines = [" ".join(map(str, v)) for v in OCTAHEDRON]
    text = {"csv": "x,y,z\n" + "".join(line.replace(" ", ",") + "\n" for line in lines),
            "off": "OFF\n6 8 0\n" + "".join(line + "\n" for line in lines) + "".join(
                "3 " + " ".join(map(str, face)) + "\n" for face in FACES),
            "obj": "".join(f"v {line}\n" for line in lines) + "".join(
                "f " + " ".join(str(v + 1) for v in face) + "\n" for face in FACES),
            "stl": "solid stone\n" + "".join("facet normal 0 0 0\nouter loop\n" + "".join(
                f"vertex {lines[v]}\n" for v in face) + "endloop\nendfacet\n" for face in FACES) + "endsolid stone\n",
            "shp": "<\nname Stone\nradius 0.05\npreCompDone n\nnv 6\n" + "".join(line + "\n" for line in lines)
                   + "ne 0\nnf 8\n" + "".join("3 " + " ".join(map(str, face)) + "\n" for face in FACES) + ">\n"}
    for extension in FORMATS:
        with open(f"{points}3.{extension}", "w") as file:
            file.write(text[extension])
    return hashlib.sha256(content.encode()).hexdigest()


def samples(points):
    """Returns (dimension, shape) for every kind, with and without rounding."""
    return [(2, {"kind": "polygon", "sides": 5}), (2, {"kind": "box", "sides": [1, 2], "rounding": 0.1}),
            (2, {"kind": "capsule", "aspect": 2.0}), (2, {"kind": "file", "file": points + ".csv"}),
            (2, {"kind": "hull", "vertices": [5, 9], "count": 3}), (3, {"kind": "capsule", "aspect": 1.5}),
            (3, {"kind": "cut", "faces": [6, 10], "count": 3}),
            (3, {"kind": "voronoi", "cells": 30, "count": 3, "rounding": 0.05})]


def faults_of_state(path, rows, shape):
    """Returns the differences between the shapes in a state file and the table of the page."""
    with h5py.File(path) as f:
        s = {name: data[:] for name, data in f["shapes"].items()}
        dim, scale, of = int(f.attrs["dimension"]), f["grains/scale"][:], f["grains/shape"][:]
        if not np.allclose(f["grains/radius"][:], scale * s["outer_radius"][of], rtol=1e-14):
            yield "grains/radius is not the scale times the outer radius"
    if set(s) != set(rows):
        yield f"the datasets {sorted(s)}, but the page has {sorted(rows)}"
        return
    n = {"shapes": len(s["volume"]), "vertices": len(s["vertices"]), "faces": len(s["offsets"]), "corners": len(s["faces"])}
    for name, size in rows.items():
        what, _, more = size.partition(" + ")
        if len(s[name]) != n[what] + int(more or 0):
            yield f"{name} has {len(s[name])} rows, but the page says {size}, of {n}"
    for name, last in (("first_vertex", "vertices"), ("first_face", "faces"), ("first_corner", "corners")):
        if s[name][0] != 0 or s[name][-1] != n[last] or (np.diff(s[name].astype(int)) < 0).any():
            yield f"{name} is {s[name].tolist()}, of {n}"
    for k in range(n["shapes"]):
        v = s["vertices"][s["first_vertex"][k]:s["first_vertex"][k + 1]]
        faces = range(s["first_face"][k], s["first_face"][k + 1])
        if shape["kind"] == "capsule" and (len(v) != 2 or not s["rounding"][k] > 0):
            yield f"a capsule has {len(v)} vertices and the rounding {s['rounding'][k]}"
        if abs(s["rounding"][k] + np.linalg.norm(v, axis=1).max() - s["outer_radius"][k]) > 1e-12:
            yield "outer_radius is not that of the circumscribed sphere"
        if shape["kind"] == "capsule":
            continue
        volume = 0.0
        for face in faces:
            corners = v[s["faces"][s["first_corner"][face]:s["first_corner"][face + 1]]]
            normal, offset = s["normals"][face], s["offsets"][face]
            if abs(np.linalg.norm(normal) - 1) > 1e-12 or abs(corners @ normal - offset).max() > 1e-9 or (
                    v @ normal > offset + 1e-9).any():
                yield f"face {face} is none with an outward unit normal and its offset"
            if dim == 2:
                area = np.linalg.norm(corners[1] - corners[0])
                if len(corners) != 2 or np.cross(corners[1] - corners[0], normal) > 0:
                    yield f"side {face} does not run counter-clockwise between two ends"
            else:
                area = normal @ np.cross(corners, np.roll(corners, -1, 0)).sum(0) / 2
                if area <= 0:
                    yield f"face {face} does not run counter-clockwise seen from outside"
            volume += area * offset / dim
        if abs(s["inner_radius"][k] - s["offsets"][faces[0]:faces[-1] + 1].min() - s["rounding"][k]) > 1e-12:
            yield "inner_radius is not the distance of the nearest face of the core plus the rounding"
        if s["rounding"][k] == 0 and abs(volume - s["volume"][k]) > 1e-9 * volume:
            yield f"the volume is {s['volume'][k]}, of the faces {volume}"
