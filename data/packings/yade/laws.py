# 40 spheres of several sizes with friction in a periodic cell, squeezed and brought to rest, by the law that is named:
#   yade -n -x laws.py hertz       spheres of Hertz and Mindlin
#   yade -n -x laws.py cohesive    linear springs that also pull: bonds up to a tensile strength
# Writes the packing and its interactions as text.
import sys
from yade import pack

law = sys.argv[1]
elastic = dict(young=1e7, poisson=0.25 if law == "hertz" else 0.4, frictionAngle=0.4, density=2600)
if law == "hertz":
    O.materials.append(FrictMat(**elastic))
    geometry, physics = Ig2_Sphere_Sphere_ScGeom(), Ip2_FrictMat_FrictMat_MindlinPhys()
    forces = Law2_ScGeom_MindlinPhys_Mindlin()
else:
    O.materials.append(CohFrictMat(isCohesive=True, normalCohesion=5e4, shearCohesion=5e4, momentRotationLaw=False, **elastic))
    geometry = Ig2_Sphere_Sphere_ScGeom6D()
    physics = Ip2_CohFrictMat_CohFrictMat_CohFrictPhys(setCohesionOnNewContacts=True)
    forces = Law2_ScGeom6D_CohFrictPhys_CohesionMoment()

O.periodic = True
O.cell.setBox(0.11, 0.11, 0.11)
cloud = pack.SpherePack()
cloud.makeCloud((0, 0, 0), (0.11, 0.11, 0.11), rMean=0.01, rRelFuzz=0.3, num=40, periodic=True, seed=7)
cloud.toSimulation()
O.engines = [
    ForceResetter(),
    InsertionSortCollider([Bo1_Sphere_Aabb()]),
    InteractionLoop([geometry], [physics], [forces]),
    NewtonIntegrator(damping=0.3),
]
O.dt = 0.5 * PWaveTimeStep()
pressure = lambda: -getStress().trace() / 3


def strain(amount, rest):
    """Changes the lengths of the cell by a fraction and lets the grains come to rest."""
    O.cell.velGrad = Matrix3.Identity * (1 if amount > 0 else -1)
    O.run(int(abs(amount) / O.dt), True)
    O.cell.velGrad = Matrix3.Zero
    O.run(rest, True)


while pressure() < 1e3:
    strain(-0.002, 4000)
# Bonds that pull: the cell is let go until next to nothing is left of the stress.
while law == "cohesive" and pressure() > 50:
    strain(0.0001, 4000)
O.run(100000, True)
# Forces of the positions that are written, without motion: the integrator, which moves the grains after them, rests.
O.engines[-1].dead = True
for b in O.bodies:
    b.state.vel = b.state.angVel = Vector3.Zero
O.step()
print("steps", O.iter, "unbalanced", unbalancedForce(), "pressure", pressure())

numbers = lambda *values: " ".join("%.17g" % v for v in values)
cell = O.cell.hSize
with open(law + ".txt", "w") as f:
    print("# cell", numbers(*[cell[row, vector] for vector in range(3) for row in range(3)]), file=f)
    print("# id x y z r mass", file=f)
    for b in O.bodies:
        print(b.id, numbers(*b.state.pos, b.shape.radius, b.state.mass), file=f)
with open(law + ".interactions", "w") as f:
    print("# id1 id2 cellx celly cellz fnx fny fnz fsx fsy fsz kn ks tan_phi", file=f)
    for i in O.interactions:
        if i.isReal:
            print(i.id1, i.id2, *i.cellDist, numbers(*i.phys.normalForce, *i.phys.shearForce, i.phys.kn, i.phys.ks,
                  i.phys.tangensOfFrictionAngle), file=f)
