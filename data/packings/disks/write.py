#!/usr/bin/env python3
"""Writes a state of frictionless disks of unit stiffness in the format of jamBashbulk, in a skewed cell of the same lattice.

    floc run disks16.toml -o disks16
    python3 write.py disks16/state-0000.h5 disks16.txt
"""
import sys

import h5py
import numpy

with h5py.File(sys.argv[1]) as state:
    cell = state["cell/matrix"][:]
    positions = state["grains/position"][:]
    radii = state["grains/radius"][:]
    pressure = state["equilibrium/target"][:].mean()
cell[1] += cell[0]  # another pair of vectors of the same lattice
positions -= numpy.floor(positions @ numpy.linalg.inv(cell)) @ cell
side = abs(cell[0, 0] * cell[1, 1] - cell[0, 1] * cell[1, 0]) ** 0.5
vectors = " ,".join(f"L{a + 1}= {{ {cell[a, 0]!r} , {cell[a, 1]!r} }}" for a in range(2))
with open(sys.argv[2], "w", encoding="utf-8") as out:
    out.write("# Frictionless disks of unit stiffness\n# made by floc\n")
    out.write(f"N = {len(radii)} ,L = {side!r} ,{vectors} ,P = {pressure!r} ,P0= {pressure!r} ,\n{{\n")
    for (x, y), radius in zip(positions, radii):
        out.write(f"{x!r} ,\t{y!r} ,\t{radius!r} ,\n")
    out.write("}\n")
