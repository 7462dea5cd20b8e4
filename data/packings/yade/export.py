# Writes a packing of spheres as text that floc reads: NAME.txt with cell, walls, gravity and spheres, and NAME.interactions.
# To be run in a script of YADE:   exec(open("export.py").read()); export_packing("NAME")
# Boxes, facets and walls across an axis become planes, in which the facets of one plane are one wall.


def planes_of(shape, position, orientation):
    """Planes of a body that is no sphere, as pairs of an axis and a coordinate: both faces of a box, one of a facet or wall."""
    if isinstance(shape, Wall):
        return [(shape.axis, position[shape.axis])]
    if isinstance(shape, Facet):
        corners = [position + orientation * vertex for vertex in shape.vertices]
        size = max((corner - corners[0]).norm() for corner in corners)
        flat = [a for a in range(3) if max(abs(corner[a] - corners[0][a]) for corner in corners) < 1e-9 * size]
        if len(flat) == 1:
            return [(flat[0], corners[0][flat[0]])]
    if isinstance(shape, Box) and abs(abs(orientation[3]) - 1) < 1e-12:
        thin = min(range(3), key=lambda a: shape.extents[a])
        return [(thin, position[thin] + side * shape.extents[thin]) for side in (-1, 1)]
    raise RuntimeError("a body is no plane across x, y or z, but " + str(shape))


def wall_of(body, centre):
    """Name and place of the wall that a body is: the face that looks to the centre of the spheres."""
    axis, place = min(planes_of(body.shape, body.state.pos, body.state.ori), key=lambda p: abs(p[1] - centre[p[0]]))
    return "xyz"[axis] + ("-" if place < centre[axis] else "+"), place


def walls_of(spheres):
    """For each wall its place, and for each body the wall that it is. Both facets of a rectangle are one wall."""
    centre = sum((b.state.pos for b in spheres), Vector3.Zero) / len(spheres)
    places, names = {}, {}
    for b in O.bodies:
        if b is None or isinstance(b.shape, Sphere):
            continue
        name, place = wall_of(b, centre)
        if abs(places.setdefault(name, place) - place) > 1e-9 * abs(spheres[0].shape.radius):
            raise RuntimeError("two walls %s, at %.17g and %.17g" % (name, places[name], place))
        names[b.id] = name
    return places, names


def export_packing(name):
    numbers = lambda *values: " ".join("%.17g" % v for v in values)
    spheres = [b for b in O.bodies if b is not None and isinstance(b.shape, Sphere)]
    places, names = walls_of(spheres)
    with open(name + ".txt", "w") as f:
        if O.periodic:
            print("# cell", numbers(*[O.cell.hSize[row, vector] for vector in range(3) for row in range(3)]), file=f)
        for wall in sorted(places):
            print("# wall", wall, numbers(places[wall]), file=f)
        for engine in O.engines:
            if isinstance(engine, NewtonIntegrator) and engine.gravity.norm() > 0:
                print("# gravity", numbers(*engine.gravity), file=f)
        print("# id x y z r mass", file=f)
        for b in spheres:
            print(b.id, numbers(*b.state.pos, b.shape.radius, b.state.mass), file=f)
    rows = {}
    for i in O.interactions:
        if not i.isReal:
            continue
        # A sphere may touch both facets of a rectangle: these contacts are one.
        bodies = tuple(names.get(k, k) for k in (i.id1, i.id2))
        row = rows.setdefault(bodies + tuple(i.cellDist), [Vector3.Zero, Vector3.Zero, 0, 0, 0])
        of_one = (i.phys.normalForce, i.phys.shearForce, i.phys.kn, i.phys.ks, 0)
        row[:] = [a + b for a, b in zip(row, of_one)]
        row[4] = i.phys.tangensOfFrictionAngle
    with open(name + ".interactions", "w") as f:
        print("# id1 id2 cellx celly cellz fnx fny fnz fsx fsy fsz kn ks tan_phi", file=f)
        for key, (normal, shear, kn, ks, tan_phi) in rows.items():
            print(*key, numbers(*normal, *shear, kn, ks, tan_phi), file=f)
