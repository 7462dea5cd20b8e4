"""Pores of disks: the faces of the contact graph without the disks, with the moments of their areas."""
import math

import numpy as np

from state import parts_of


NODES = np.polynomial.legendre.leggauss(24)


def moments_of_triangle(p, q):
    """Returns the integrals of 1, x and |x|^2 over the triangle with the corners 0, p and q."""
    area = (p[0] * q[1] - p[1] * q[0]) / 2
    return np.array([area, *(area / 3 * (p + q)), area / 6 * (p @ p + p @ q + q @ q)])


def moments_of_sector(c, R, start, angle):
    x, weights = NODES
    t = start + angle * (x + 1) / 2
    direction = np.array([np.cos(t), np.sin(t)]) @ weights / 2
    area = R**2 * angle / 2
    first = area * (c + 2 / 3 * R * direction)
    second = area * (c @ c + 4 / 3 * R * (c @ direction) + R**2 / 2)
    return np.array([area, *first, second])


def find_pores(s):
    """Returns the pores, and whether one of them percolates. All parts of the graph must be joined."""
    edges = {}
    for i, j, image, r in zip(s.i, s.j, s.image, s.branch):
        edges[i, j, tuple(image)] = r
    assert len(parts_of(s.n, list(edges))) == 1 or bridge(s, edges), s.path
    half = []  # (from, to, image, branch)
    for (i, j, image), r in edges.items():
        half += [(i, j, np.array(image), r), (j, i, -np.array(image), -r)]
    out = {}
    for h, (i, _, _, r) in enumerate(half):
        out.setdefault(i, []).append((math.atan2(r[1], r[0]), h))
    for around in out.values():
        around.sort()
    place = {h: (i, k) for i, around in out.items() for k, (_, h) in enumerate(around)}
    seen, pores, unbounded = set(), [], False
    for start in range(len(half)):
        if start in seen:
            continue
        h, at, total, winding, grains = start, np.zeros(2), np.zeros(4), np.zeros(2, int), set()
        while True:
            seen.add(h)
            i, j, image, r = half[h]
            total += moments_of_triangle(at, at + r)
            at, winding = at + r, winding + image
            grains.add(i)
            grain, k = place[h ^ 1]
            angle, after = out[grain][k - 1]
            turn = out[grain][k][0] - angle
            total -= moments_of_sector(at, s.radius[j], angle, turn if turn > 0 else turn + 2 * math.pi)
            h = after
            if h == start:
                break
        if winding.any():
            unbounded = True
        elif total[0] > 0:
            centre = total[1:3] / total[0]
            pores.append({"area": total[0], "centre": centre + s.x[half[start][0]], "n_grains": len(grains),
                          "gyration_radius": math.sqrt(max(0.0, total[3] / total[0] - centre @ centre))})
    return pores, unbounded


def bridge(s, edges):
    """Joins the parts of the graph across the smallest gaps between them."""
    i, j, r = s.neighbours(3 * s.a)
    gap = np.linalg.norm(r, axis=1) - s.radius[i] - s.radius[j]
    part = {}
    for number, (grains, _, _) in enumerate(parts_of(s.n, list(edges))):
        part |= {grain: number for grain in grains}
    for k in np.argsort(gap, kind="stable"):
        if part[i[k]] != part[j[k]]:
            image = np.round(np.linalg.solve(s.cell.T, r[k] - s.x[j[k]] + s.x[i[k]])).astype(int)
            edges[i[k], j[k], tuple(image)] = r[k]
            old, new = part[j[k]], part[i[k]]
            part = {grain: new if number == old else number for grain, number in part.items()}
    return len(set(part.values())) == 1
