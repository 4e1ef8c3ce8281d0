# SPDX-License-Identifier: BSD-3-Clause
"""Tests the models of paper_rules.py: what table 1 lets coarse levels do, and times against nodes that really wait."""
import random
import sys

import numpy as np

import paper_rules
import paper_windows


def check_registration():
    """The target as printed stops every coarse level; with all corrections every node of every level is done."""
    neighbours = paper_rules.grid(*paper_rules.GRID)
    starts, printed, told, targeted, counted = (paper_rules.construct(neighbours, rules)
                                                for _, rules in paper_rules.READINGS)
    assert starts[1][0] == (960, 960, 960, 0), starts   # no node completes lifting
    # Completion runs backwards from the last vertex, the only one without a succeeding neighbour.
    assert printed[0][0][3] == 0 and printed[1][0] == (960, 960, 960, 960), printed
    for _, end in (printed, told, targeted):
        assert end[0] == (960, 960, 960, 960) and end[1][0] == 240 and end[1][3] == 0, end
    # Only the first coarse node has no preceding neighbour.
    assert printed[1][1][1] == told[1][1][1] == 1 < targeted[1][1][1] < 240, (printed, told, targeted)
    assert len(counted[1]) == 4 and all(level == 4 * level[:1] and level[0] > 0 for level in counted[1]), counted


class WaitingNode:
    """A node that knows its neighbours from the beginning, and asks all others again and again what they have done."""

    def __init__(self, index, child=None):
        self.index, self.child = index, child
        self.before, self.parent = None, None   # the node before it on its level, if it has to wait for that
        self.neighbours = set()
        self.lifted = False
        self.times = []    # of each stage it has done

    def ring(self):
        """N2."""
        return self.neighbours.union(*(node.neighbours for node in self.neighbours)) - {self}


CREATED, REGISTERED, DECIDED, COMPLETED, BUILT = range(5)


def may(node, stage, relaxations):
    """Whether the node may do a stage: creation, registration, ..., building, n relaxations, the end."""
    def done(others, which):
        return all(len(other.times) > which for other in others)

    preceding = [other for other in node.neighbours if other.index < node.index]
    succeeding = [other for other in node.neighbours if other.index > node.index]
    if node.before and len(node.before.times) <= stage:
        return False
    if stage == CREATED:
        return node.child and node.child.lifted and len(node.child.times) > DECIDED
    if stage == REGISTERED:
        return done(succeeding, CREATED) and (not node.child or done(node.child.ring(), COMPLETED))
    if stage == DECIDED:
        return done(preceding, DECIDED)
    if stage == COMPLETED:
        return done(node.neighbours, DECIDED)
    if stage == BUILT:
        return not node.child or done({node.child} | node.child.ring(), BUILT + relaxations)
    if stage <= BUILT + relaxations:
        return done(preceding, stage) and done(succeeding, stage - 1)
    parents = [other.parent for other in node.ring() | {node} if other.lifted]
    return done(node.neighbours, BUILT + relaxations) and done(parents, BUILT)


def waiting_levels(adjacency, levels, in_order):
    """Nodes whose coarse neighbours and lifted nodes are those of the definition."""
    result, nodes = [], [WaitingNode(i) for i in range(len(adjacency))]
    for node, others in zip(nodes, adjacency):
        node.neighbours = {nodes[i] for i in others}
    for _ in range(levels):
        result.append(nodes)
        for node, last in zip(nodes[1:], nodes):
            node.before = last if in_order else None
        for node in nodes:
            node.lifted = not any(other.lifted for other in node.neighbours if other.index < node.index)
        children = [node for node in nodes if node.lifted]
        nodes = [WaitingNode(i, child) for i, child in enumerate(children)]
        for node in nodes:
            node.child.parent = node
        for node in nodes:
            node.neighbours = {other.parent for other in node.child.ring() if other.lifted}
    for node in result[-1]:
        node.lifted = False   # the coarsest nodes have no parents
    return result


def wait(levels, relaxations):
    """Reads the vertices one by one, and after each tries all stages of all nodes until none may go on."""
    for time, vertex in enumerate(levels[0]):
        vertex.times.append(time)
        advanced = True
        while advanced:
            advanced = False
            for node in (node for level in levels for node in level):
                stage = len(node.times)
                if (stage or node.child) and stage <= BUILT + relaxations + 1 and may(node, stage, relaxations):
                    node.times.append(time)
                    advanced = True


def check_windows(adjacency, relaxations, perform):
    pairs = np.array([(i, j) for i, others in enumerate(adjacency) for j in others])
    levels = paper_windows.hierarchy(paper_windows.Level(len(adjacency), *pairs.T), 10)
    waiting = waiting_levels(adjacency, len(levels), perform is paper_windows.as_cursors)
    wait(waiting, relaxations)
    resident = np.zeros(len(adjacency) + 1, dtype=int)
    for (created, freed), level, nodes in zip(
            paper_windows.lifetimes(levels, relaxations, perform), levels, waiting):
        assert level.count == len(nodes)
        assert [node.index for node in nodes if node.lifted] == level.lifted.tolist() or nodes is waiting[-1]
        assert created.tolist() == [node.times[CREATED] for node in nodes]
        if nodes is not waiting[-1]:
            assert freed.tolist() == [node.times[-1] for node in nodes]
            assert all(len(node.times) == BUILT + relaxations + 2 for node in nodes)
        for node in nodes:   # in memory from its creation to the end of the step that frees it
            resident[node.times[CREATED]:node.times[-1] + 1 if nodes is not waiting[-1] else None] += 1
    assert len(levels) > 2
    peak = paper_windows.peak_nodes(levels, relaxations, perform)
    assert peak == resident.max(), (peak, resident.max())
    return peak


def shuffled(adjacency, distance, generator):
    """The graph in an order in which vertices move by about this distance."""
    order = sorted(range(len(adjacency)), key=lambda i: i + distance * generator.random())
    place = {old: new for new, old in enumerate(order)}
    return [{place[other] for other in adjacency[old]} for old in order]


def main():
    check_registration()
    generator = random.Random(1)
    for distance in (0, 10, 50):   # a long grid, so that the window moves
        graph = shuffled(paper_rules.grid(60, 4), distance, generator)
        for relaxations in (1, 3):
            tasks = check_windows(graph, relaxations, paper_windows.as_tasks)
            cursors = check_windows(graph, relaxations, paper_windows.as_cursors)
            assert tasks <= cursors, (tasks, cursors)


sys.exit(main())
