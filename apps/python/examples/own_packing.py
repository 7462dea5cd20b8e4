#!/usr/bin/env python3
"""Computes moduli of a packing given as arrays, a triangular lattice of disks, and compares them with closed forms."""
import numpy as np

import floc

K_N, K_T, overlap, n = 1e5, 8e4, 1e-3, 4
side = 1.0 - overlap
a, b = np.meshgrid(np.arange(n), np.arange(n), indexing="ij")
cell = n * side * np.array([[1.0, 0.0], [0.5, np.sqrt(0.75)]])
position = np.stack([a.ravel(), b.ravel()], axis=1) @ cell / n
law = {"normal": {"stiffness": K_N}, "friction": {"coefficient": 0.5, "stiffness": K_T}}

packing = floc.Packing.from_arrays(position, np.full(n * n, 0.5), cell, law)
moduli = floc.moduli(packing, strains="full")
print(f"{packing.n_contacts} contacts, B = {moduli.B:.6g}, closed form {np.sqrt(3) / 2 * K_N:.6g}")
print(f"G = {moduli.G:.6g}, closed form {np.sqrt(3) / 4 * (K_N + K_T):.6g}")

# A list of contacts, as another program may give it: the two grains of each contact and its normal force.
contacts = packing.contacts
columns = {name: contacts[name] for name in ("id1", "id2", "image", "normal_force")}
again = floc.Packing.from_arrays(position, np.full(n * n, 0.5), cell, law, contacts=columns)
print(f"with contacts listed: B = {floc.moduli(again).B:.6g}")
