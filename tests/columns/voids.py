"""The radical Voronoi tessellation of spheres, from the intersections of all triples of planes, and the balls at its
vertices."""
import functools
import itertools

import numpy as np

PLANES = 34  # of a cell, the nearest ones: a tessellation of more faces would not fill the volume


@functools.lru_cache(maxsize=None)
def voronoi(s):
    """Returns the volume of each cell, and centre and radius of the balls at the vertices, which reach to the nearest
    surface."""
    i, j, r = s.neighbours(3.2 * s.a)
    offset = ((r**2).sum(1) + s.radius[i]**2 - s.radius[j]**2) / 2
    volume, corners = np.zeros(s.n), []
    triples = np.array(list(itertools.combinations(range(PLANES), 3)))
    for grain in range(s.n):
        mine = i == grain
        normal, level = r[mine], offset[mine]
        size = np.linalg.norm(normal, axis=1)
        order = np.argsort(level / size)
        normal, level = (normal / size[:, None])[order], (level / size)[order]
        A = normal[triples]
        good = np.abs(np.linalg.det(A)) > 1e-6
        points = np.linalg.solve(A[good], level[triples[good]][:, :, None])[:, :, 0]
        inside = (points @ normal.T <= level + 1e-9 * s.a).all(1)
        points = points[inside]
        for k in range(PLANES):
            face = points[np.abs(points @ normal[k] - level[k]) < 1e-8 * s.a]
            if len(face) >= 3:
                volume[grain] += area(face, normal[k]) * level[k] / 3
        corners += [s.x[grain] + x for x in points]
    assert abs(volume.sum() - s.volume) < 1e-6 * s.volume, (s.path, volume.sum() / s.volume)
    return volume, balls(s, np.array(corners))


def area(points, normal):
    """Returns the area of a convex polygon; its corners may be given in any order and more than once."""
    u = np.linalg.svd(normal[None])[2][1:]
    flat = (points - points.mean(0)) @ u.T
    flat = flat[np.argsort(np.arctan2(flat[:, 1], flat[:, 0]))]
    following = np.roll(flat, -1, 0)
    return abs((flat[:, 0] * following[:, 1] - flat[:, 1] * following[:, 0]).sum()) / 2


def balls(s, corners):
    reduced = np.linalg.solve(s.cell.T, corners.T).T
    reduced -= np.floor(reduced)
    kept = []
    while len(reduced):
        apart = reduced - reduced[0]
        near = np.linalg.norm((apart - np.round(apart)) @ s.cell, axis=1) < 1e-6 * s.a
        kept.append(reduced[0] @ s.cell)
        reduced = reduced[~near]
    out = []
    for x in kept:
        images = s.x[None] + (s.images(2 * s.a) @ s.cell)[:, None] - x
        radius = (np.linalg.norm(images, axis=2) - s.radius).min()
        if radius > 0:
            out.append((x, radius))
    return out
