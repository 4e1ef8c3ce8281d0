#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""paper_rules.py registration | windows MESH... : what follows from table 1 of the paper; for docs/paper.md.

registration: the tasks of the hierarchy construction as events, with the counters, targets and notifications of
table 1, on a triangulated grid. Prints how many nodes of each level are created, complete registration, decide whether
they are lifted, and complete lifting, also before the last vertex is read: with the rules as printed, which can be read
in two ways, and with one more of them corrected at a time. A few seconds.

windows: the most nodes that the paper's first pass has in memory at once, with tasks and with cursors
(paper_windows.py); needs NumPy. A MESH has its vertices in the order of the stream: a .sma or .sva file as
`smg convert MESH.vsm MESH.sma --order keep` writes it, or .obj, of triangles or of tetrahedra.
"""

import argparse
import pathlib
from collections import deque
from typing import NamedTuple

import paper_windows

GRID = (40, 24)
LEVELS = 4
REGISTRATION, LIFTING, BUILDING = range(3)


class Rules(NamedTuple):
    """How table 1 is read."""
    told: str                     # whose completion a decision counts for: "none", "succeeding" or "all" neighbours
    succeeding: bool = False      # the target has |succeeding neighbours|, not |child's lifted 2-ring neighbours|
    count_earlier: bool = False   # a new node counts what was completed before there was a parent to notify


READINGS = (("as printed, decisions count for starts only", Rules("none")),
            ("as printed, decisions count for completion too", Rules("succeeding")),
            ("decisions told to all neighbours", Rules("all")),
            ("and the target of succeeding neighbours", Rules("all", succeeding=True)),
            ("and earlier completions counted", Rules("all", succeeding=True, count_earlier=True)))


class Node:
    def __init__(self, level, order, child=None, degree=None):
        self.level, self.order, self.child, self.degree = level, order, child, degree
        self.parent = None
        self.neighbours = []   # those known so far
        self.task = REGISTRATION
        self.queued = self.performed = False   # of this task
        self.lifted = None     # until it has decided
        self.scc = [0, 0]      # by task, as a neighbour may be a task ahead
        self.ccc = [0, 0]

    def preceding(self):
        return [node for node in self.neighbours if node.order < self.order]

    def succeeding(self):
        return [node for node in self.neighbours if node.order > self.order]

    def knows_neighbours(self):
        """The number comes with a vertex of the stream; on coarse levels it is what registration finds out."""
        return self.task > REGISTRATION if self.child else len(self.neighbours) == self.degree

    def two_ring(self):
        """The known neighbours and theirs."""
        ring = dict.fromkeys(self.neighbours)
        for node in self.neighbours:
            ring.update(dict.fromkeys(node.neighbours))
        ring.pop(self, None)
        return list(ring)


class Construction:
    """Figure 4 for the tasks of the hierarchy construction."""

    def __init__(self, rules):
        self.rules = rules
        self.levels = [[] for _ in range(LEVELS)]
        self.ready = deque()      # the queue
        self.notified = deque()   # nodes to check

    def read(self, degree, preceding):
        """The next vertex of the stream, of which its preceding neighbours are known."""
        node = self.create(0, degree=degree)
        node.neighbours = [self.levels[0][index] for index in preceding]
        for neighbour in node.neighbours:
            neighbour.neighbours.append(node)
        self.flush()

    def create(self, level, child=None, degree=None):
        node = Node(level, len(self.levels[level]), child, degree)
        self.levels[level].append(node)
        self.notified.append(node)
        return node

    def flush(self):
        while self.ready or self.notified:
            while self.notified:
                self.check(self.notified.popleft())
            if self.ready:
                node = self.ready.popleft()
                node.performed = True
                (self.register if node.task == REGISTRATION else self.decide)(node)
                self.recheck(node)

    def recheck(self, node):
        """A node that had to know the ring of its child may know it now."""
        ring = [node, *node.two_ring()]
        self.notified.extend(ring + [other.parent for other in ring if other.parent])

    def check(self, node):
        if node.performed and node.ccc[node.task] == self.complete_target(node):
            node.task += 1
            node.queued = node.performed = False
            if node.task == BUILDING:
                self.complete_lifting(node)
        # SCT: registration 0; lifting |preceding neighbours|.
        target = len(node.preceding()) if node.task == LIFTING else 0
        if node.task != BUILDING and not node.queued and node.scc[node.task] == target:
            node.queued = True
            self.ready.append(node)

    def complete_target(self, node):
        """CCT; None as long as the node cannot know it."""
        if node.task == LIFTING:
            return len(node.neighbours)            # "|neighbors|"
        if not node.child:
            return node.degree - len(node.preceding())   # "in finest level: |succeeding neighbors|"
        ring = node.child.two_ring()
        if not all(other.knows_neighbours() for other in [node.child, *node.child.neighbours]):
            return None
        if any(other.lifted is None for other in ring):
            return None
        # "in other levels: |child's 2-ring neighbors| + |child's lifted 2-ring neighbors|"
        lifted = [other.parent for other in ring if other.lifted]
        if self.rules.succeeding:
            lifted = [parent for parent in lifted if parent.order > node.order]
        return len(ring) + len(lifted)

    def register(self, node):
        if node.child:
            node.neighbours = [other.parent for other in node.child.two_ring()
                               if other.parent and other.parent.order < node.order]
            for neighbour in node.neighbours:
                neighbour.neighbours.append(node)
        for neighbour in node.preceding():   # post-operation notification: "preceding neighbors"
            neighbour.ccc[REGISTRATION] += 1

    def decide(self, node):
        # "if and only if it is unconstrained and it does not have a lifted preceding neighbor"
        node.lifted = not any(other.lifted for other in node.preceding())
        if node.lifted and node.level + 1 < LEVELS:
            node.parent = self.create(node.level + 1, node)
            if self.rules.count_earlier:
                node.parent.ccc[REGISTRATION] = sum(other.task == BUILDING for other in node.two_ring())
        for neighbour in node.succeeding():   # post-operation notification: "succeeding neighbors"
            neighbour.scc[LIFTING] += 1
        for neighbour in self.told(node):
            neighbour.ccc[LIFTING] += 1

    def told(self, node):
        """Neighbours that count its decision when it is made, not when it has completed lifting."""
        return {"none": [], "succeeding": node.succeeding(), "all": node.neighbours}[self.rules.told]

    def complete_lifting(self, node):
        # On-complete notification: "neighbors + parents of 2-ring neighbors"; a decision counts once.
        for neighbour in set(node.neighbours) - set(self.told(node)):
            neighbour.ccc[LIFTING] += 1
        for other in node.two_ring():
            if other.parent:
                other.parent.ccc[REGISTRATION] += 1
        self.recheck(node)

    def progress(self, level):
        """Nodes that are created, have completed registration, have decided, have completed lifting."""
        nodes = self.levels[level]
        return (len(nodes), sum(node.task > REGISTRATION for node in nodes),
                sum(node.lifted is not None for node in nodes), sum(node.task == BUILDING for node in nodes))


def grid(rows, columns):
    """Neighbours of each vertex of a triangulated grid, row by row."""
    neighbours = [set() for _ in range(rows * columns)]
    for row in range(rows):
        for column in range(columns):
            for down, right in ((0, 1), (1, 0), (1, 1)):
                if row + down < rows and column + right < columns:
                    one, other = row * columns + column, (row + down) * columns + column + right
                    neighbours[one].add(other)
                    neighbours[other].add(one)
    return neighbours


def construct(neighbours, rules):
    """The progress of each level when all vertices but the last one have been read, and at the end."""
    construction, early = Construction(rules), None
    for vertex, around_it in enumerate(neighbours):
        early = [construction.progress(level) for level in range(LEVELS)]
        construction.read(len(around_it), [other for other in around_it if other < vertex])
    return early, [construction.progress(level) for level in range(LEVELS)]


def registration(_):
    print("| rules | level | created | completed registration | decided | completed lifting | before the last vertex |")
    print("|---|---|---|---|---|---|---|")
    for name, rules in READINGS:
        for level, (early, end) in enumerate(zip(*construct(grid(*GRID), rules))):
            print("|", " | ".join(map(str, (name, level, *end, early[-1]))), "|")


def windows(options):
    print("| mesh | vertices | span | levels | relaxations | nodes of tasks | of cursors | ratio |")
    print("|---|---|---|---|---|---|---|---|")
    for mesh in options.meshes:
        levels = paper_windows.hierarchy(paper_windows.read_mesh(mesh))
        for relaxations in options.relaxations:
            tasks = paper_windows.peak_nodes(levels, relaxations, paper_windows.as_tasks)
            cursors = paper_windows.peak_nodes(levels, relaxations, paper_windows.as_cursors)
            print(f"| {mesh.stem} | {levels[0].count:,} | {levels[0].span():,} | {len(levels)} | {relaxations} "
                  f"| {tasks:,} | {cursors:,} | {cursors / tasks:.2f} |", flush=True)


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n", 1)[0])
    commands = parser.add_subparsers(required=True)
    commands.add_parser("registration").set_defaults(run=registration)
    command = commands.add_parser("windows")
    command.set_defaults(run=windows)
    command.add_argument("meshes", nargs="+", type=pathlib.Path, metavar="MESH")
    command.add_argument("--relaxations", type=lambda text: [int(word) for word in text.split(",")], default=[2, 10],
                         help="numbers of relaxations n, as 2,10")
    options = parser.parse_args()
    options.run(options)


if __name__ == "__main__":
    main()
