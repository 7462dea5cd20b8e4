#!/usr/bin/env python3
"""Makes tables of three tests that were never done, as laboratories of three countries write them. Their constants are known.

    make.py DIRECTORY

oedometer.csv: German, in Latin-1, with semicolons, decimal commas, titles and a row of units; void ratios
edometr.csv:   Polish, in UTF-8 with a byte order mark and line ends of Windows; heights, each load after a minute and a day
tablet.txt:    of a tablet press, separated by tabs; pressure in MPa, relative density in percent
"""
import math
import pathlib
import random
import sys

# Slopes of recompression and of the virgin line, preconsolidation pressure (kPa) and void ratio at it.
GERMAN = {"kappa": 0.018, "lambda": 0.092, "yield": 85.0, "e_yield": 0.742}
POLISH = {"kappa": 0.025, "lambda": 0.150, "yield": 60.0, "e_yield": 0.905}
POLISH_HEIGHT = 20.0  # height of the Polish sample before the test (mm)
POLISH_E_0 = 0.960    # void ratio of the Polish sample before the test
# Law of floc fit consolidation, --law full: 1/Phi = 1/Phi_0 at P_0 (MPa).
TABLET = {"lambda": 0.30, "alpha": 1.2, "Phi_max": 0.97, "Phi_0": 0.52, "P_0": 8.0}
NOISE = 4e-4          # standard deviation of a void ratio, and of 1/Phi of a tablet


def void_ratio(clay, stress, largest):
    """Void ratio at a stress when the clay has felt the stress `largest`."""
    virgin = clay["e_yield"] - clay["lambda"] * math.log(max(largest, clay["yield"]) / clay["yield"])
    return virgin + clay["kappa"] * math.log(max(largest, clay["yield"]) / stress)


def with_comma(number, decimals):
    return f"{number:.{decimals}f}".replace(".", ",")


def german(noise):
    lines = ["Ödometerversuch nach DIN EN ISO 17892-5;;;", "Probe B3/7;Tiefe 8,4 m;Prüfer Müller;", ";;;",
             "Laststufe;Vertikalspannung;Porenzahl;Bemerkung", ";[kPa];[-];"]
    stresses = [12.5, 25, 50, 100, 200, 400, 800, 400, 200, 100, 200, 400, 800, 1600]
    largest = 0.0
    for step, stress in enumerate(stresses, start=1):
        largest = max(largest, stress)
        e = void_ratio(GERMAN, stress, largest) + noise.gauss(0.0, NOISE)
        lines.append(f"{step};{with_comma(stress, 1)};{with_comma(e, 4)};{'Entlastung' if stress < largest and step < 11 else ''}")
    return "\n".join(lines) + "\n"


def polish(noise):
    lines = ["Badanie edometryczne, próbka nr 4", "", "Naprężenie [kPa];Czas [h];Wysokość [mm]"]
    before = POLISH_E_0
    for stress in [12.5, 25, 50, 100, 200, 400, 800, 1600]:
        e = void_ratio(POLISH, stress, stress)
        for hours, part in ((0.02, 0.25), (24, 0.0)):  # a quarter of the compression takes longer than a minute
            measured = e + part * (before - e) + noise.gauss(0.0, NOISE)
            height = POLISH_HEIGHT * (1.0 + measured) / (1.0 + POLISH_E_0)
            lines.append(f"{with_comma(stress, 1)};{with_comma(hours, 2)};{with_comma(height, 3)}")
        before = e
    return "\r\n".join(lines) + "\r\n"


def tablet(noise):
    law = TABLET
    P_1 = law["P_0"] * math.exp((1 / law["Phi_0"] - 1 / law["Phi_max"]) / law["lambda"])
    lines = ["# Compaction simulator, flat punches of 10 mm", "Punch pressure (MPa)\tRelative density (%)\tEjection force (N)"]
    for k in range(25):
        P = 8.0 * 60.0 ** (k / 24)
        bend = (1.0 - math.exp(-((P_1 / P) ** law["alpha"]))) ** (1.0 / law["alpha"])
        inverse = 1 / law["Phi_0"] - law["lambda"] * math.log(P / law["P_0"] * bend) + noise.gauss(0.0, NOISE)
        lines.append(f"{P:.1f}\t{100 / inverse:.2f}\t{60 + 3.1 * P:.0f}")
    return "\n".join(lines) + "\n"


def main():
    directory = pathlib.Path(sys.argv[1])
    directory.joinpath("oedometer.csv").write_bytes(german(random.Random(1)).encode("latin-1"))
    directory.joinpath("edometr.csv").write_bytes(polish(random.Random(2)).encode("utf-8-sig"))
    directory.joinpath("tablet.txt").write_bytes(tablet(random.Random(3)).encode())


if __name__ == "__main__":
    main()
