# 40 spheres with friction in a periodic cell, compressed isotropically and brought to rest:   yade -n -x spheres.py
# Writes the packing as text, and what YADE itself makes of it: stress and the net force on every sphere.
from yade import pack

O.materials.append(FrictMat(young=1e7, poisson=0.4, frictionAngle=0.4, density=2600, label="grains"))
O.periodic = True
O.cell.setBox(0.11, 0.11, 0.11)
cloud = pack.SpherePack()
cloud.makeCloud((0, 0, 0), (0.11, 0.11, 0.11), rMean=0.01, rRelFuzz=0.3, num=40, periodic=True, seed=7)
cloud.toSimulation()

O.engines = [
    ForceResetter(),
    InsertionSortCollider([Bo1_Sphere_Aabb()]),
    InteractionLoop([Ig2_Sphere_Sphere_ScGeom()], [Ip2_FrictMat_FrictMat_FrictPhys()], [Law2_ScGeom_FrictPhys_CundallStrack()]),
    NewtonIntegrator(damping=0.3),
]
O.dt = 0.5 * PWaveTimeStep()
# Squeezed by 0.2 % and let come to rest, again and again until what is left of the stress at rest is 1000.
while -getStress().trace() / 3 < 1e3:
    O.cell.velGrad = -Matrix3.Identity
    O.run(int(0.002 / O.dt), True)
    O.cell.velGrad = Matrix3.Zero
    O.run(4000, True)
O.run(200000, True)
# Forces of the positions that are written, without motion: the integrator, which moves the grains after them, rests.
O.engines[-1].dead = True
for b in O.bodies:
    b.state.vel = b.state.angVel = Vector3.Zero
O.step()
print("steps", O.iter, "dt", O.dt, "unbalanced", unbalancedForce(), "kinetic", kineticEnergy())

numbers = lambda *values: " ".join("%.17g" % v for v in values)
cell = O.cell.hSize
with open("spheres.txt", "w") as f:
    print("# cell", numbers(*[cell[row, vector] for vector in range(3) for row in range(3)]), file=f)
    print("# id x y z r mass", file=f)
    for b in O.bodies:
        print(b.id, numbers(*b.state.pos, b.shape.radius, b.state.mass), file=f)
with open("spheres.interactions", "w") as f:
    print("# id1 id2 cellx celly cellz fnx fny fnz fsx fsy fsz kn ks tan_phi", file=f)
    for i in O.interactions:
        if i.isReal:
            print(i.id1, i.id2, *i.cellDist, numbers(*i.phys.normalForce, *i.phys.shearForce, i.phys.kn, i.phys.ks,
                  i.phys.tangensOfFrictionAngle), file=f)
with open("spheres.forces", "w") as f:
    stress = getStress()
    print("# stress of YADE, compression negative:", numbers(*[stress[row, column] for row in range(3) for column in range(3)]), file=f)
    print("# id fx fy fz", file=f)
    for b in O.bodies:
        print(b.id, numbers(*O.forces.f(b.id)), file=f)
