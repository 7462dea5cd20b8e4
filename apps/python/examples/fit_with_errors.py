#!/usr/bin/env python3
"""Fits the consolidation law to a measured curve, with intervals of its parameters, and draws it.

    fit_with_errors.py [PICTURE]
"""
import sys

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np

import floc

# A consolidation curve with a logarithmic regime, and random errors of 0.3 %.
pressure = np.geomspace(0.02, 2.0, 20)
noise = 1.0 + 0.003 * np.random.default_rng(1).standard_normal(pressure.size)
solid_fraction = noise / (2.6 - 0.2 * np.log(pressure / 0.02))

fit = floc.fit.consolidation(pressure, solid_fraction, law="log", window=(pressure[0], pressure[-1]))
slope = fit["lambda"]
print(f"lambda = {slope.value:.4f}, 95 % from {slope.low95:.4f} to {slope.high95:.4f}")

figure, ax = plt.subplots()
ax.semilogx(pressure, 1.0 / solid_fraction, "o")
middle = 1.0 / solid_fraction.mean() + slope.value * np.log(pressure).mean()
ax.semilogx(pressure, middle - slope.value * np.log(pressure), label=f"lambda = {slope.value:.3f}")
ax.set_xlabel("P*")
ax.set_ylabel("1/phi")
ax.legend()
figure.savefig(sys.argv[1] if len(sys.argv) > 1 else "fit.png")
