# Advances glass beads with YADE:  yade -n -x yade_spheres.py packing.xyz spheres
# The law is Hertz and Mindlin with friction 0.3 and nearly critical damping, under 1e5 Pa on all three axes.
import os
import re
import sys
import time

from yade import O, utils

lines = open(sys.argv[1]).read().splitlines()
lattice = [float(value) for value in re.search('Lattice="(.*?)"', lines[1]).group(1).split()]
O.periodic = True
O.cell.setBox(lattice[0], lattice[4], lattice[8])
O.materials.append(FrictMat(young=70e9, poisson=0.3, frictionAngle=0.2915, density=2500))
for line in lines[2:]:
    x, y, z, radius = [float(value) for value in line.split()[1:5]]
    O.bodies.append(utils.sphere((x, y, z), radius))
O.dt = 1e-7
barostat = PeriTriaxController(
    goal=(-1e5, -1e5, -1e5), stressMask=7, dynCell=True, globUpdate=5, maxStrainRate=(1.0, 1.0, 1.0), doneHook="pass"
)
O.engines = [
    ForceResetter(),
    InsertionSortCollider([Bo1_Sphere_Aabb()], verletDist=2e-5),
    InteractionLoop(
        [Ig2_Sphere_Sphere_ScGeom()],
        [Ip2_FrictMat_FrictMat_MindlinPhys(betan=0.9, betas=0.0)],
        [Law2_ScGeom_MindlinPhys_Mindlin()],
    ),
    barostat,
    NewtonIntegrator(damping=0.0),
]
steps = 1000
O.run(100, True)
started = time.process_time()
O.run(steps, True)
seconds = time.process_time() - started
contacts = sum(1 for i in O.interactions if i.isReal)
print("contacts %d steps %d seconds %.4f" % (contacts, steps, seconds))
sys.stdout.flush()
os._exit(0)
