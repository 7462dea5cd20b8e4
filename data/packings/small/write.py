#!/usr/bin/env python3
"""Writes small packings in formats of other programs: python3 write.py

Eight spheres of diameter 1 on a cubic grid, pressed between six walls: each overlaps its neighbours and the walls by 0.002, so that
springs of stiffness 1000 carry a force of 2.

    box.restart      MercuryDPM, with contacts and gravity 0
    box.dump         LIGGGHTS or LAMMPS, dump custom in a box that is not periodic
    walls.liggghts   commands of an input script of LIGGGHTS that make the walls: planes and a plate as a mesh
    plate.stl        this plate, whose upper face is the floor

Twenty-seven spheres on a cubic grid as a tomograph sees them, with errors of up to 0.01 of a diameter:

    tomography.csv
"""
import itertools
import random

OVERLAP, STIFFNESS, RADIUS = 0.002, 1000.0, 0.5
FIRST = RADIUS - OVERLAP
PLACES = [FIRST, FIRST + 2 * RADIUS - OVERLAP]
SIDE = PLACES[1] + FIRST
CENTRES = list(itertools.product(PLACES, repeat=3))
# The orientation of a wall turns the x axis to its outward normal.
WALLS = [(axis, side) for axis in range(3) for side in (-1, 1)]
HALF = "0.707106781186548"
TURNS = {(0, -1): "0 0 1 0", (0, 1): "1 0 0 0", (1, -1): f"{HALF} 0 0 -{HALF}", (1, 1): f"{HALF} 0 0 {HALF}",
         (2, -1): f"{HALF} 0 {HALF} 0", (2, 1): f"{HALF} 0 -{HALF} 0"}


def along(axis, value):
    return " ".join(f"{value:.6g}" if a == axis else "0" for a in range(3))


def restart():
    lines = ["MercuryDPM 1.0 name box", f"xMin 0 xMax {SIDE} yMin 0 yMax {SIDE} zMin 0 zMax {SIDE}",
             "systemDimensions 3 particleDimensions 3 gravity 0 0 0", "Species 1",
             f"LinearViscoelasticSpecies id 0 density 1 stiffness {STIFFNESS} dissipation 0", f"Walls {len(WALLS)}"]
    for k, wall in enumerate(WALLS):
        lines.append(f"InfiniteWall id {k} indSpecies 0 position {along(wall[0], SIDE if wall[1] > 0 else 0.0)} orientation {TURNS[wall]}")
    lines += ["Boundaries 0", f"Particles {len(CENTRES)}"]
    for k, (x, y, z) in enumerate(CENTRES):
        lines.append(f"BaseParticle id {k} indSpecies 0 position {x:.6g} {y:.6g} {z:.6g} orientation 1 0 0 0 radius {RADIUS} invMass 1")
    contacts = []
    force = STIFFNESS * OVERLAP
    for (i, a), (j, b) in itertools.combinations(enumerate(CENTRES), 2):
        apart = [q - p for p, q in zip(a, b)]
        if sum(abs(d) > 1e-9 for d in apart) == 1:
            axis = max(range(3), key=lambda c: apart[c])
            contacts.append(f"particleIds {i} {j} timeStamp 0 contactPoint 0 0 0 force {along(axis, -force)} torque 0 0 0")
    for i, a in enumerate(CENTRES):
        for k, (axis, side) in enumerate(WALLS):
            if (a[axis] == PLACES[1]) == (side > 0):
                contacts.append(f"particleWallIds {i} {k} timeStamp 0 contactPoint 0 0 0 force {along(axis, -side * force)} torque 0 0 0")
    lines.append(f"Interactions {len(contacts)}")
    lines += ["LinearViscoelasticInteraction " + contact for contact in contacts]
    return lines


def dump():
    lines = ["ITEM: TIMESTEP", "0", "ITEM: NUMBER OF ATOMS", str(len(CENTRES)), "ITEM: BOX BOUNDS ff ff ff"]
    lines += 3 * [f"0 {SIDE:.6g}"] + ["ITEM: ATOMS id type x y z radius"]
    return lines + [f"{k + 1} 1 {x:.6g} {y:.6g} {z:.6g} {RADIUS}" for k, (x, y, z) in enumerate(CENTRES)]


def script():
    lines = ["# Walls of the box: five planes, and the upper face of a plate.", f"variable side equal {SIDE:.6g}",
             "fix plate all mesh/surface file plate.stl type 1",
             "fix floor all wall/gran model hooke tangential history mesh n_meshes 1 meshes plate"]
    for name, plane, place in (("left", "xplane", "0"), ("right", "xplane", "${side}"), ("front", "yplane", "0"),
                               ("back", "yplane", "${side}"), ("lid", "zplane", "${side}")):
        lines.append(f"fix {name} all wall/gran model hooke tangential history primitive type 1 {plane} {place}")
    return lines


def plate():
    """A block from (-1, -1, -0.2) to (3, 3, 0)."""
    low, high = (-1, -1, -0.2), (3, 3, 0)
    lines = ["solid plate"]
    for axis in range(3):
        b, c = (axis + 1) % 3, (axis + 2) % 3
        for end in (low, high):
            corners = []
            for along_b, along_c in ((low[b], low[c]), (high[b], low[c]), (high[b], high[c]), (low[b], high[c])):
                corner = [0, 0, 0]
                corner[axis], corner[b], corner[c] = end[axis], along_b, along_c
                corners.append(corner)
            for triangle in ((0, 1, 2), (0, 2, 3)):
                lines += ["facet normal " + along(axis, 1 if end is high else -1), "outer loop"]
                lines += ["vertex " + " ".join(f"{x:g}" for x in corners[k]) for k in triangle]
                lines += ["endloop", "endfacet"]
    return lines + ["endsolid plate"]


def tomography():
    draw = random.Random(1)
    lines = ["X,Y,Z,D"]
    for centre in itertools.product(range(3), repeat=3):
        lines.append(",".join(f"{c + draw.uniform(-0.01, 0.01):.4f}" for c in centre) + ",0.9950")
    return lines


for name, lines in {"box.restart": restart(), "box.dump": dump(), "walls.liggghts": script(),
                    "plate.stl": plate(), "tomography.csv": tomography()}.items():
    with open(name, "w", encoding="utf-8") as out:
        out.write("\n".join(lines) + "\n")
