#!/usr/bin/env python3
"""Makes oedometer.csv: a test that was never done, of a clay whose constants are known.

    make.py > oedometer.csv

The void ratio e is a straight line in ln(stress) with the slope KAPPA as long as the stress stays below the largest one that
the clay has felt, and with the slope LAMBDA beyond it. Before the test this was YIELD. Each load is kept for a day: the
first row of a load is the end of primary consolidation, the second one, on the lines, the end of the creep that follows.
"""
import math
import random

KAPPA = 0.020    # slope of unloading and reloading
LAMBDA = 0.110   # slope of the virgin compression line
YIELD = 130.0    # preconsolidation pressure before the test (kPa)
E_YIELD = 0.800  # void ratio at YIELD
NOISE = 5e-4     # standard deviation of each void ratio
CREEP = 0.06     # part of the compression of a load that is creep
E_0 = 0.880      # void ratio before the first load, from which strains are counted
SEED = 3

LOADS = [6.25 * 2**k for k in range(9)]                # to 1600 kPa
UNLOADS = [800, 400, 200, 100, 50]
RELOADS = [100, 200, 400, 800, 1600, 3200, 6400]
LAST_UNLOADS = [3200, 1600, 800, 400, 200]


def void_ratios():
    """Rows (stress, void ratio) without noise."""
    largest, e_largest = YIELD, E_YIELD
    before = E_0
    for stress in LOADS + UNLOADS + RELOADS + LAST_UNLOADS:
        if stress > largest:
            e_largest -= LAMBDA * math.log(stress / largest)
            largest = stress
        e = e_largest + KAPPA * math.log(largest / stress)
        if e < before:
            yield stress, e + CREEP * (before - e)
        yield stress, e
        before = e


def main():
    noise = random.Random(SEED)
    print("effective_vertical_stress [kPa],axial_strain [%],void_ratio [-]")
    print(f"0,0,{E_0:.4f}")
    for stress, e in void_ratios():
        measured = e + noise.gauss(0.0, NOISE)
        print(f"{stress:g},{100 * (E_0 - measured) / (1 + E_0):.3f},{measured:.4f}")


if __name__ == "__main__":
    main()
