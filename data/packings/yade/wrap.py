# Brings every centre of spheres.txt into the cell, as many scripts write them: python3 wrap.py >wrapped.txt
# The images in spheres.interactions go with spheres.txt, and contradict these positions.
from math import floor

with open("spheres.txt") as f:
    lines = f.read().splitlines()
cell = [float(number) for number in lines[0].split()[2:]]
side = [cell[0], cell[4], cell[8]]
assert sum(map(abs, cell)) == sum(side), "a rectangular cell"
print("\n".join(lines[:2]))
for line in lines[2:]:
    id, *position, radius, mass = line.split()
    inside = [float(x) - floor(float(x) / L) * L for x, L in zip(position, side)]
    print(id, *("%.17g" % x for x in inside), radius, mass)
