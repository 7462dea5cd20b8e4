# Advances a packing with YADE:  yade -n -x yade_steps.py packing.xyz friction. The law is that of friction.toml or of
# cohesion.toml. Disks are spheres whose centres stay in a plane, in a cell of height HEIGHT.
import os
import re
import sys
import time

from yade import O, utils

HEIGHT = 4.0
lines = open(sys.argv[1]).read().splitlines()
lattice = [float(value) for value in re.search('Lattice="(.*?)"', lines[1]).group(1).split()]
O.periodic = True
O.cell.setBox(lattice[0], lattice[4], HEIGHT)
# Young's modulus E gives k_n = 2 E r1 r2/(r1 + r2), so grains of radius 1/4 to 1/2 have K_N of about 1.
elastic = dict(young=2.7, poisson=1.0, frictionAngle=0.4636, density=1.9)
if sys.argv[2] == "friction":
    O.materials.append(FrictMat(**elastic))
    loop = InteractionLoop(
        [Ig2_Sphere_Sphere_ScGeom()], [Ip2_FrictMat_FrictMat_FrictPhys()], [Law2_ScGeom_FrictPhys_CundallStrack()]
    )
else:
    # A cohesion times the square of the smaller radius is a force: the pull-off force F0, and mu F0. The product
    # alphaKr r1 r2 k_s is the rolling stiffness K_R, and etaRoll times the smaller radius is the rolling friction
    # mu_R.
    O.materials.append(CohFrictMat(
        normalCohesion=9e-5, shearCohesion=4.5e-5, fragile=False, momentRotationLaw=True, alphaKr=7e-4, etaRoll=0.015,
        alphaKtw=0, **elastic
    ))
    loop = InteractionLoop(
        [Ig2_Sphere_Sphere_ScGeom6D()],
        [Ip2_CohFrictMat_CohFrictMat_CohFrictPhys(setCohesionNow=True, setCohesionOnNewContacts=True)],
        # Rolling contacts can yield only with the incremental form.
        [Law2_ScGeom6D_CohFrictPhys_CohesionMoment(useIncrementalForm=True, always_use_moment_law=True)],
    )
for line in lines[2:]:
    x, y, _, radius = [float(value) for value in line.split()[1:5]]
    O.bodies.append(utils.sphere((x, y, HEIGHT / 2), radius))
    O.bodies[-1].state.blockedDOFs = "zXY"
O.dt = 0.05
barostat = PeriTriaxController(
    goal=(-1e-4 / HEIGHT, -1e-4 / HEIGHT, 0), stressMask=3, dynCell=True, globUpdate=5, maxStrainRate=(0.01, 0.01, 0.0),
    doneHook="pass"
)
# The dashpots of the scene are nearly critical. YADE has no dashpots in this law, so its own damping replaces them.
O.engines = [ForceResetter(), InsertionSortCollider([Bo1_Sphere_Aabb()]), loop, barostat, NewtonIntegrator(damping=0.8)]
steps = 4000
O.run(200, True)
started = time.process_time()
O.run(steps, True)
seconds = time.process_time() - started
contacts = sum(1 for i in O.interactions if i.isReal)
print("contacts %d steps %d seconds %.4f" % (contacts, steps, seconds))
sys.stdout.flush()
os._exit(0)
