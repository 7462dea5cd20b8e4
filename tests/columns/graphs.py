"""Properties that follow from the connections of contacts alone, computed by brute force on small networks."""
import numpy as np

from state import parts_of


def graph(net):
    """Returns the graph of a network: number of nodes and edges (i, j, image). All walls are one node; upper walls
    are images of this node."""
    s = net.state
    edges = []
    for k in net.k:
        if s.on_wall[k]:
            wall = s.j[k] - s.n
            image = np.zeros(s.dim, int)
            image[s.walls["axis"][wall]] = int(s.walls["side"][wall] > 0)
            edges.append((s.i[k], s.n, image))
        else:
            edges.append((s.i[k], s.j[k], s.image[k]))
    return s.n + 1, edges


def scalar_backbone(net):
    """Returns the contacts that carry a current under a gradient across the cell, for almost all conductances."""
    n, edges = graph(net)
    random = np.random.default_rng(1)
    carries = np.zeros(len(edges), bool)
    for _ in range(2):
        g = random.uniform(0.5, 1.5, len(edges))
        gradient = random.normal(size=len(edges[0][2]))
        L, b = np.zeros((n, n)), np.zeros(n)
        drive = np.array([image @ gradient for _, _, image in edges])
        for (i, j, _), conductance, push in zip(edges, g, drive):
            L[i, i] += conductance
            L[j, j] += conductance
            L[i, j] -= conductance
            L[j, i] -= conductance
            b[i] += conductance * push
            b[j] -= conductance * push
        potential = np.linalg.lstsq(L, b, rcond=1e-12)[0]
        current = np.array([c * (potential[j] - potential[i] + push)
                            for (i, j, _), c, push in zip(edges, g, drive)])
        carries |= np.abs(current) > 1e-9 * max(np.abs(current).max(), 1e-300)
        if np.abs(current).max() < 1e-9 * np.abs(gradient).max():
            carries[:] = False
    return carries


def dead_end_contacts(net):
    """Returns the contacts of side branches: the part beyond some grain has no loop around the cell and at most one
    contact with walls."""
    n, edges = graph(net)
    out = np.zeros(len(edges), bool)
    ground = net.state.n
    for cut in [None, *range(n)]:
        whole = [(i, j, image) for i, j, image in edges if cut not in (i, j)]
        part_of = {}
        for number, (nodes, _, _) in enumerate(parts_of(n, whole)):
            part_of |= {node: number for node in nodes}
        at = [part_of[j] if i == cut else part_of[i] for i, j, _ in edges]
        for number in set(at):
            if cut is not None and number == part_of[cut]:
                members = [c for c, (i, j, _) in enumerate(edges) if i == j == cut]
            else:
                members = [c for c in range(len(edges)) if at[c] == number and not edges[c][0] == edges[c][1] == cut]
            mine = [edges[c] for c in members]
            winds = any(rank for _, rank, _ in parts_of(n, mine)) if mine else False
            walls = sum(ground in (i, j) for i, j, _ in mine)
            if not winds and walls < 2:
                out[members] = True
    return out


def structural_parts(net, dead, modes):
    """Returns the number of independent motions that are free because of the connections of the grains. `modes` has
    the motions that floc modes lists; their translations are checked here. Returns None if it lists none."""
    if modes is None:
        return None
    held = net.connected & ~dead
    core = [(i, j, image) for i, j, image in net.edges() if held[i] and held[j]]
    joined = set().union(*[{i, j} for i, j, _ in core]) if core else set()
    single = {int(g) for g in np.flatnonzero(held)} - joined
    parts = sum(1 for grains, _, _ in parts_of(net.state.n, core) if joined & set(grains)) + len(single)
    assert modes.get("translation", 0) == net.state.dim * parts, (modes, parts)
    assert modes.get("rattler", 0) == net.dofs * net.n_rattlers, modes
    return sum(modes.values())
