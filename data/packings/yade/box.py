# 500 spheres with friction between six boxes as walls, squeezed and brought to rest:   yade -n -x box.py
from yade import pack
exec(open("export.py").read())

material = O.materials.append(FrictMat(young=1e7, poisson=0.4, frictionAngle=0.4, density=2600))
size = Vector3(0.24, 0.22, 0.2)
walls = O.bodies.append(aabbWalls([(0, 0, 0), size], thickness=0.01, material=material))
cloud = pack.SpherePack()
cloud.makeCloud((0, 0, 0), size, rMean=0.009, rRelFuzz=0.3, num=500, seed=7)
cloud.toSimulation(material=material)
O.engines = [
    ForceResetter(),
    InsertionSortCollider([Bo1_Sphere_Aabb(), Bo1_Box_Aabb()]),
    InteractionLoop([Ig2_Sphere_Sphere_ScGeom(), Ig2_Box_Sphere_ScGeom()], [Ip2_FrictMat_FrictMat_FrictPhys()],
                    [Law2_ScGeom_FrictPhys_CundallStrack()]),
    NewtonIntegrator(damping=0.3),
]
O.dt = 0.5 * PWaveTimeStep()


def move_upper_walls(rate):
    for axis in range(3):
        O.bodies[walls[2 * axis + 1]].state.vel = -rate * size[axis] * Vector3.Unit(axis)


# Squeezed by 0.5 % and let come to rest, again and again until what is left of the force on a wall at rest is 100.
while O.forces.f(walls[1])[0] < 100:
    move_upper_walls(1)
    O.run(int(0.005 / O.dt), True)
    move_upper_walls(0)
    O.run(1000, True)
O.run(200000, True)
# Forces of the positions that are written, without motion: the integrator, which moves the grains after them, rests.
O.engines[-1].dead = True
for b in O.bodies:
    b.state.vel = b.state.angVel = Vector3.Zero
O.step()
print("steps", O.iter, "unbalanced", unbalancedForce())
export_packing("box")
