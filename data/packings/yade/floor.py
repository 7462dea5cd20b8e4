# 500 spheres with friction that fall into a tray made of facets, without a lid:   yade -n -x floor.py
from yade import pack
exec(open("export.py").read())

material = O.materials.append(FrictMat(young=1e7, poisson=0.4, frictionAngle=0.4, density=2600))
O.bodies.append(geom.facetBox((0.08, 0.08, 0.2), (0.08, 0.08, 0.2), wallMask=31, material=material))
cloud = pack.SpherePack()
cloud.makeCloud((0, 0, 0), (0.16, 0.16, 0.4), rMean=0.009, rRelFuzz=0.3, num=500, seed=7)
cloud.toSimulation(material=material)
O.engines = [
    ForceResetter(),
    InsertionSortCollider([Bo1_Sphere_Aabb(), Bo1_Facet_Aabb()]),
    InteractionLoop([Ig2_Sphere_Sphere_ScGeom(), Ig2_Facet_Sphere_ScGeom()], [Ip2_FrictMat_FrictMat_FrictPhys()],
                    [Law2_ScGeom_FrictPhys_CundallStrack()]),
    NewtonIntegrator(damping=0.3, gravity=(0, 0, -9.81)),
]
O.dt = 0.5 * PWaveTimeStep()
O.run(80000, True)
# Forces of the positions that are written, without motion: the integrator, which moves the grains after them, rests.
# The integrator adds the weights, which are written apart.
O.engines[-1].dead = True
for b in O.bodies:
    b.state.vel = b.state.angVel = Vector3.Zero
O.step()
print("steps", O.iter, "unbalanced", unbalancedForce())
export_packing("floor")
