#!/usr/bin/env python3
"""Compares the ranges of `floc forces` with linear programs of scipy, for a frictional packing of disks.

    second_opinion_test.py --floc PROGRAM --source DIR [--contacts N]

In 2D Coulomb's cone has plane sides, so a linear program gives the range of a normal force. Its constraints are set
up in disks.py from the positions and radii in the state file. Exit code 77: scipy is missing.
"""
import argparse
import sys
import tempfile

import numpy as np

from disks import Balance, Program

try:
    from scipy.optimize import linprog
    from scipy.sparse import csr_matrix, lil_matrix
except ImportError:
    sys.exit(77)

FRICTION = 0.5


def extreme(balance, contact, sign):
    """Returns the smallest (sign = 1) or largest (sign = -1) normal force of a contact."""
    objective = np.zeros(2 * balance.n)
    objective[2 * contact] = sign
    cone = lil_matrix((2 * balance.n, 2 * balance.n))
    for k in range(balance.n):
        for row, side in ((2 * k, 1.0), (2 * k + 1, -1.0)):
            cone[row, 2 * k], cone[row, 2 * k + 1] = -FRICTION, side
    bounds = [(0.0, None) if column % 2 == 0 else (None, None) for column in range(2 * balance.n)]
    found = linprog(objective, A_ub=cone.tocsr(), b_ub=np.zeros(2 * balance.n), A_eq=csr_matrix(balance.matrix),
                    b_eq=balance.load, bounds=bounds, method="highs")
    if found.status != 0:
        raise SystemExit(f"scipy finds no extreme of contact {contact}: {found.message}")
    return sign * found.fun * balance.unit


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--floc", required=True)
    parser.add_argument("--source", required=True)
    parser.add_argument("--contacts", type=int, default=8)
    arguments = parser.parse_args()
    with tempfile.TemporaryDirectory() as directory:
        program = Program(arguments.floc, arguments.source, directory)
        state = program.state("run", {"grains.count": 100, "contact.friction.coefficient": FRICTION})
        balance = Balance(state)
        chosen = np.linspace(0, balance.n - 1, arguments.contacts).astype(int)
        _, rows = program.forces(state, "--range-of", ",".join(map(str, chosen)))
    worst = 0.0
    for contact in chosen:
        for sign, name in ((1.0, "smallest_normal_force"), (-1.0, "largest_normal_force")):
            worst = max(worst, abs(float(rows[contact][name]) - extreme(balance, contact, sign)) / balance.unit)
    print(f"{len(chosen)} ranges of {balance.n} contacts: largest difference {worst:.1e} of the mean force")
    if worst > 1e-8:
        raise SystemExit("the ranges of floc and of scipy differ by more than 1e-8 of the mean force")


if __name__ == "__main__":
    main()
