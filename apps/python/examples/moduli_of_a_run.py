#!/usr/bin/env python3
"""Assembles a small cohesive powder, consolidates it, and prints the bulk modulus of each state and its bounds.

    moduli_of_a_run.py [DIRECTORY]

Run it in a directory that contains data/scenes/demo.toml of floc.
"""
import sys

import floc

directory = sys.argv[1] if len(sys.argv) > 1 else "powder"
run = floc.run("data/scenes/demo.toml", directory, changes={"grains.count": 100}, until=8, resume=True,
               on_progress=lambda p: p.equilibrium and print(f"step {p.step}: phi {p.solid_fraction:.4f}"))

print(f"{'P*':>10} {'phi':>8} {'B_reuss':>10} {'B':>10} {'B_voigt':>10}")
for state in run[1:]:
    m = floc.moduli(state)
    print(f"{m.P_star:10.4g} {m.phi:8.4f} {m.B_reuss:10.1f} {m.B:10.1f} {m.B_voigt:10.1f}")
