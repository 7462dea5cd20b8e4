# Steps the packing of friction.toml in YADE:  yade -n -x friction_yade.py packing.xyz
# Disks are spheres that keep to a plane.
import os
import re
import sys
import time

from yade import O, utils

lines = open(sys.argv[1]).read().splitlines()
lattice = [float(value) for value in re.search('Lattice="(.*?)"', lines[1]).group(1).split()]
O.periodic = True
O.cell.setBox(lattice[0], lattice[4], 4.0)
# Young's modulus E gives k_n = 2 E r1 r2/(r1 + r2), so grains of radius 1/4 to 1/2 have K_N of about 1.
O.materials.append(FrictMat(young=2.7, poisson=1.0, frictionAngle=0.4636, density=1.9))
for line in lines[2:]:
    x, y, _, radius = [float(value) for value in line.split()[1:5]]
    O.bodies.append(utils.sphere((x, y, 2.0), radius))
    O.bodies[-1].state.blockedDOFs = "zXY"
O.dt = 0.05
barostat = PeriTriaxController(
    goal=(-1e-4, -1e-4, 0), stressMask=3, dynCell=True, globUpdate=5, maxStrainRate=(0.01, 0.01, 0.0), doneHook="pass"
)
O.engines = [
    ForceResetter(),
    InsertionSortCollider([Bo1_Sphere_Aabb()]),
    InteractionLoop([Ig2_Sphere_Sphere_ScGeom()], [Ip2_FrictMat_FrictMat_FrictPhys()], [Law2_ScGeom_FrictPhys_CundallStrack()]),
    barostat,
    NewtonIntegrator(damping=0.2),
]
steps = 4000
O.run(200, True)
started = time.process_time()
O.run(steps, True)
seconds = time.process_time() - started
contacts = sum(1 for i in O.interactions if i.isReal)
print("contacts %d steps %d seconds %.4f" % (contacts, steps, seconds))
sys.stdout.flush()
os._exit(0)
