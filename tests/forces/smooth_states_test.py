#!/usr/bin/env python3
"""Checks `floc forces` on frictionless packings of 200 disks, for which theory tells which forces are unique.

    smooth_states_test.py --floc PROGRAM --source DIR

Without self-stresses (stiff disks) the geometry determines all forces, so the forces of least energy equal the forces
of the state. With self-stresses (softer disks) the closest forces equal the forces of the state. The forces of least
energy differ from them by a self-stress, which changes neither the balance of the grains nor the stress.
"""
import argparse
import tempfile

import numpy as np

from disks import Balance, Program

# Overlaps of 1e-6 and 1e-4 of a diameter. The packings have fewer and more contacts than degrees of freedom.
STIFF, SOFT = 1e-6, 1e-4


def expect(holds, words):
    if not holds:
        raise SystemExit(f"FAULT: {words}")


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--floc", required=True)
    parser.add_argument("--source", required=True)
    arguments = parser.parse_args()
    with tempfile.TemporaryDirectory() as directory:
        program = Program(arguments.floc, arguments.source, directory)
        for pressure in (STIFF, SOFT):
            for seed in (1, 2):
                settings = {"grains.count": 200, "contact.friction.coefficient": 0, "assembly.pressure": pressure,
                            "load.0.to": 2 * pressure, "load.1.to": pressure, "run.seed": seed}
                state = program.state(f"{pressure}-{seed}", settings)
                balance = Balance(state)
                closest, of_closest = program.forces(state)
                canonical, of_canonical = program.forces(state, "--selection", "canonical")
                where = f"pressure {pressure}, seed {seed}"
                expect(float(closest["moved"]) < 1e-8, f"{where}: closest moved by {closest['moved']}")
                difference = balance.listed(of_canonical) - balance.listed(of_closest)
                left = np.abs(balance.matrix @ difference).max() / balance.unit
                expect(left < 1e-9, f"{where}: the difference leaves a net force of {left:.1e}")
                moved = float(canonical["moved"])
                if pressure == STIFF:
                    expect(moved < 1e-8, f"{where}: canonical moved by {moved}")
                else:
                    expect(moved > 1e-2, f"{where}: canonical moved by {moved} only")
                print(f"{where}: closest moved {float(closest['moved']):.1e}, canonical {moved:.1e}, balance {left:.1e}")


if __name__ == "__main__":
    main()
