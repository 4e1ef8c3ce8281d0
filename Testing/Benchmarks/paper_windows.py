# SPDX-License-Identifier: BSD-3-Clause
"""The window of the paper's first pass over a mesh, with tasks and with cursors.

The vertices come in the order of the stream. A time is the number of the last vertex read: operations take none, so
that what is possible after a vertex happens before the next one. With N2(i), the neighbours of i and theirs, and n
relaxations, what a node i has to wait for is, by table 1 of the paper:

  created     being read; coarse: its child has decided and is lifted
  registered  the succeeding neighbours are created; coarse: N2(child) has completed lifting
  decided     registered, and the preceding neighbours have decided
  completed   i and its neighbours have decided
  built       completed; coarse: child and N2(child) have been relaxed n times
  relaxed k   i and its succeeding neighbours k - 1 times (0: built), the preceding ones k times
  freed       i and its neighbours relaxed n times, since they read it; the parents in i and N2(i) built

Tasks (as_tasks) happen at the earliest such time, as by the paper's queue; cursors (as_cursors) at the earliest one
at which all nodes before i have done the same, so that times are monotone. All levels but the coarsest, which stays,
are streamed. Coarse nodes are numbered in the order of their children; nothing is constrained.

A maximum over N2 is one over neighbours, twice; that leaves three loops over nodes: lifting, decisions and relaxations.
Cost, for both and 2 and 10 relaxations: 0.9 KB and about 30 us a vertex of a surface.
"""
import sys
from array import array
from typing import NamedTuple

import numpy as np

COARSEST_NODES, STALLED_SHARE = 1000, 0.8   # which level is the last one, as in Solver/Multigrid/Engine


class Rows:
    """The neighbours of each node on one side of it: entries[first[i]:first[i + 1]]."""

    def __init__(self, count, nodes, neighbours):
        self.first = np.concatenate(([0], np.cumsum(np.bincount(nodes, minlength=count))))
        self.entries = neighbours

    def latest(self, times):
        """The latest time of each node and these neighbours."""
        result = times.copy()
        used = self.first[1:] > self.first[:-1]
        if used.any():
            of_neighbours = np.maximum.reduceat(times[self.entries], self.first[:-1][used])
            result[used] = np.maximum(times[used], of_neighbours)
        return result


class Level:
    """A graph, its nodes in stream order. `lifted` are its lifted nodes, the children of the next level's."""

    def __init__(self, count, nodes, neighbours):
        """From the pairs of neighbours, in both directions; they may repeat."""
        self.count = count
        self.nodes, self.neighbours = np.divmod(np.unique(nodes * count + neighbours), count)
        below = self.neighbours < self.nodes
        self.preceding = Rows(count, self.nodes[below], self.neighbours[below])
        self.succeeding = Rows(count, self.nodes[~below], self.neighbours[~below])
        self.lifted = self.lift()

    def span(self):
        return int(np.abs(self.nodes - self.neighbours).max(initial=0))

    def around(self, times):
        """The latest time of each node and its neighbours."""
        return np.maximum(self.preceding.latest(times), self.succeeding.latest(times))

    def around_twice(self, times):
        """The latest time of each node i and N2(i)."""
        return self.around(self.around(times))

    def lift(self):
        """Nodes without a lifted preceding neighbour."""
        first, entries = self.succeeding.first.tolist(), self.succeeding.entries.tolist()
        retained, lifted = bytearray(self.count), []
        for node in range(self.count):
            if not retained[node]:
                lifted.append(node)
                for neighbour in entries[first[node]:first[node + 1]]:
                    retained[neighbour] = 1
        return np.array(lifted)

    def coarser(self):
        """The graph of lifted nodes, in the order of their children: edges join those with a neighbour in common."""
        parent = np.full(self.count, -1)
        parent[self.lifted] = np.arange(len(self.lifted))
        chosen = parent[self.neighbours] >= 0
        nodes, parents = self.nodes[chosen], parent[self.neighbours[chosen]]   # sorted by node
        many = np.bincount(nodes, minlength=self.count)
        partners = many[nodes]   # each parent beside a node with all parents beside it
        first = np.cumsum(many)[nodes] - partners
        within = np.arange(partners.sum()) - np.repeat(np.cumsum(partners) - partners, partners)
        one, other = np.repeat(parents, partners), parents[np.repeat(first, partners) + within]
        return Level(len(self.lifted), one[one != other], other[one != other])


def hierarchy(level, coarsest=COARSEST_NODES):
    levels = [level]
    while levels[-1].count > coarsest and len(levels[-1].lifted) <= STALLED_SHARE * levels[-1].count:
        levels.append(levels[-1].coarser())
    return levels


def as_tasks(times, preceding=None):
    """When nodes perform what they may at `times`, and not before these preceding neighbours."""
    if preceding is None:
        return times
    times, first, entries = times.tolist(), preceding.first.tolist(), preceding.entries.tolist()
    for node, time in enumerate(times):
        for neighbour in entries[first[node]:first[node + 1]]:
            if times[neighbour] > time:
                time = times[neighbour]
        times[node] = time
    return np.array(times)


def as_cursors(times, preceding=None):
    """The same, and not before any preceding node."""
    return np.maximum.accumulate(times)


class Times(NamedTuple):
    """When the nodes of a level have done what."""
    created: np.ndarray
    decided: np.ndarray
    completed: np.ndarray
    built: np.ndarray
    relaxed: np.ndarray


def times_of(level, relaxations, perform, finer=None, before=None):
    """Of a level, and for a coarse one the finer level and its Times."""
    def of_children(times):
        return times[finer.lifted]

    # Registration, CCT: "in finest level: |succeeding neighbors|"; in others "|child's 2-ring neighbors|" and the
    # succeeding ones, which are parents in N2(child) and exist once N2(child) has completed lifting.
    if finer:
        created = of_children(before.decided)
        registered = perform(of_children(finer.around_twice(before.completed)))
    else:
        created = np.arange(level.count)
        registered = perform(level.around(created))
    decided = perform(registered, level.preceding)         # lifting, SCT: "|preceding neighbors|"
    built = completed = perform(level.around(decided))     # lifting, CCT: "|neighbors|"
    if finer:   # building equation, SCT: "|child's 2-ring neighbors| + 1"
        built = perform(np.maximum(completed, of_children(finer.around_twice(before.relaxed))))
    relaxed = built
    for _ in range(relaxations):   # pre-solve relaxation, SCT: "|neighbors|", the preceding ones once more
        relaxed = perform(level.succeeding.latest(relaxed), level.preceding)
    return Times(created, decided, completed, built, relaxed)


def freed_times(level, relaxed, parent_built, perform):
    built = np.zeros(level.count, dtype=parent_built.dtype)
    built[level.lifted] = parent_built
    return perform(np.maximum(level.around(relaxed), level.around_twice(built)))


def lifetimes(levels, relaxations, perform):
    """When the nodes of each level are created and freed, those of the last one never."""
    times = times_of(levels[0], relaxations, perform)
    for finer, level in zip(levels, levels[1:]):
        before, times = times, times_of(level, relaxations, perform, finer, times)
        yield before.created, freed_times(finer, before.relaxed, times.built, perform)
    yield times.created, times.created[:0]


def peak_nodes(levels, relaxations, perform):
    """The most nodes of all levels in memory at once."""
    change = np.zeros(levels[0].count + 1, dtype=np.int64)
    for created, freed in lifetimes(levels, relaxations, perform):
        change += np.bincount(created, minlength=len(change))
        change -= np.bincount(freed + 1, minlength=len(change))
    return int(np.cumsum(change).max())


def read_mesh(path):
    """The graph of a mesh file. Negative corners count back from the last vertex, as in SMA, SVA and OBJ files."""
    vertices, corners, size = 0, array("q"), 0
    with open(path, encoding="latin-1") as file:
        for line in file:
            if line.startswith("v "):
                vertices += 1
            elif line.startswith(("f ", "c ")):
                cell = [int(word.split("/")[0]) for word in line.split()[1:]]
                if len(cell) != (size or len(cell)):
                    sys.exit(f"{path}: only triangles, or only tetrahedra")
                size = len(cell)
                corners.extend(vertices + corner if corner < 0 else corner - 1 for corner in cell)
    cells = np.array(corners, dtype=np.int64).reshape(-1, size)
    pairs = [(one, other) for one in range(size) for other in range(size) if one != other]
    return Level(vertices, np.concatenate([cells[:, one] for one, _ in pairs]),
                 np.concatenate([cells[:, other] for _, other in pairs]))
