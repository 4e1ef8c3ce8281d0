# SPDX-License-Identifier: BSD-3-Clause
"""The problems of the verification, on any mesh: every kind of datum, with the columns they need."""
from typing import NamedTuple

import numpy as np

from finite_elements import FiniteElements
from placed_data import duplicates

MARGIN = 0.02  # share of the length along z that is held at either end
TENSOR = [2.0, 1.0, 0.5, 0.3, 0.2, 0.1]  # xx, yy, zz, xy, yz, xz


class Case(NamedTuple):
    """A problem, and the scale of its error if that is not the range of its solution."""
    name: str
    problem: dict
    scale: float | None = None


def turned_tensors(angle):
    """(n, 6): conductivity 1 along a direction that turns with the angle (n,), 0.1 across it."""
    direction = np.stack([np.cos(angle), np.sin(angle), np.full_like(angle, 0.5)], axis=1)
    direction /= np.linalg.norm(direction, axis=1)[:, None]
    full = 0.1 * np.eye(3) + 0.9 * direction[:, :, None] * direction[:, None, :]
    return full[:, [0, 1, 2, 0, 1, 0], [0, 1, 2, 1, 2, 2]]


class Domain:
    """A mesh with columns, smooth functions of the place, and the cases on it.

    points, cells   (vertices, 3), (cells, 3 or 4)
    vertex_columns  {name: array}; the same cell_columns
    length          of the longest side of the bounds; coefficients are in units of it
    """

    def __init__(self, points, cells):
        elements = FiniteElements(points, cells, duplicates(cells))
        x = elements.points
        self.low, self.high = x.min(axis=0), x.max(axis=0)
        self.length = np.max(self.high - self.low)
        at = (x - self.low) / self.length
        middle = at[cells].mean(axis=1)
        wave = np.sin(3 * at[:, 0]) + at[:, 1] * at[:, 2]
        gradient = np.stack([elements.gradient(wave), elements.gradient(at[:, 2])], axis=1)
        lo, hi = self._held_heights()
        mass = elements.lumped()
        self.points, self.cells = points, cells
        self.vertex_columns = {
            "Ends": np.where(x[:, 2] >= hi, 2, np.where(x[:, 2] <= lo, 1, 0)).astype("i4"),
            "Wave": wave,
            "Density": np.cos(4 * at[:, 0]) / self.length**2,
            "Balanced": (wave - mass @ wave / mass.sum()) / self.length**2,
            "Absorption": (1 + 100 * at[:, 1]) / self.length**2}
        self.cell_columns = {
            "Material": np.where(np.sin(9 * middle[:, 2]) > 0, 1, 2).astype("i4"),
            "Tensor": turned_tensors(4 * middle[:, 0]),
            "CellDensity": np.exp(middle[:, 1]) / self.length**2,
            "CellAbsorption": (100 * middle[:, 2]**2) / self.length**2,
            "Swirl": np.stack([-middle[:, 1], middle[:, 0], 0.3 + middle[:, 2]], axis=1) / self.length,
            "WaveGradient": gradient[:, 0]}
        facets, _ = elements.boundary(~duplicates(cells))
        self.isClosed = len(facets) == 0
        if not self.isClosed:
            # Half of the boundary, along z unless all of it is cut by a plane across z.
            least = x[facets].min(axis=1)
            axis = 2 if np.ptp(least[:, 2]) > MARGIN * self.length else np.argmax(np.ptp(least, axis=0))
            self.halfBoundary = {"halfspace": [*(np.arange(3) == axis).astype(int).tolist(),
                                               np.median(least[:, axis])]}
            self.boundaryIsBelow = np.median(least[:, 2]) <= lo

    def _held_heights(self):
        margin = MARGIN * (self.high[2] - self.low[2])
        return self.low[2] + margin, self.high[2] - margin

    def cases(self):
        lo, hi = self._held_heights()
        top, bottom = {"halfspace": [0, 0, 1, hi]}, {"halfspace": [0, 0, -1, -lo]}
        ends = [{**top, "value": [1]}, {**bottom, "value": [0]}]
        cold = [{**top, "value": [0]}, {**bottom, "value": [0]}]
        unit = 1 / self.length**2
        yield Case("harmonic", {"dirichlet": ends})
        outputs = {"outputs": ["gradient", "flux"]}
        yield Case("positions", {**outputs, "columns": 3, "dirichlet": [
            {**top, "value": "position"}, {**bottom, "value": "position"}]})
        yield Case("source", {"dirichlet": cold, "source": [unit]})
        yield Case("screening", {"dirichlet": cold, "source": [unit], "screening": 50 * unit})
        yield Case("screening by region", {"dirichlet": ends, "screening": [
            {"halfspace": [0, 0, 1, (lo + hi) / 2], "value": 200 * unit},
            {"sphere": [*self.low, self.length / 2], "value": "Absorption"}]})
        yield Case("screening by tag", {"dirichlet": ends, "screening": [
            {"value": 1 * unit}, {"tag": ["Material", 1], "value": "Absorption"}]})
        yield Case("screening, vertex column", {"screening": "Absorption", "source": "Density"})
        yield Case("screening, cell column", {"dirichlet": ends, "screening": "CellAbsorption",
                                              "source": "CellDensity"})
        yield Case("two materials", {"dirichlet": ends, "conductivity": [
            {"value": 1}, {"tag": ["Material", 2], "value": 10}]})
        yield Case("tensor", {"dirichlet": ends, "conductivity": TENSOR})
        yield Case("tensor column", {**outputs, "dirichlet": cold, "conductivity": "Tensor",
                                     "source": [unit]})
        if not self.isClosed:
            yield from self._boundary_cases(top if self.boundaryIsBelow else bottom)
        yield Case("field", {"dirichlet": cold, "field": "Swirl"})
        yield Case("field of a gradient", {"field": "WaveGradient", "initial": "Wave"})
        yield Case("soft", {"soft": [{"tag": ["Ends", 2], "weight": 1e3 * unit, "value": [1]},
                                     {"tag": ["Ends", 1], "weight": 1e3 * unit, "value": [-1]}]})
        yield Case("Neumann", {"source": "Balanced", "initial": [3]})
        yield Case("Neumann, source with a mean", {"source": "Density"})
        yield Case("Neumann, constant source", {"source": [unit], "initial": [2]}, scale=1.0)

    def _boundary_cases(self, held):
        half = self.halfBoundary
        everywhere = {"box": [*(self.low - self.length), *(self.high + self.length)]}
        yield Case("flux", {"dirichlet": [{**held, "value": [0]}],
                            "flux": [{**half, "value": [1 / self.length]}]})
        yield Case("Robin", {"robin": [
            {**everywhere, "coefficient": 1 / self.length, "ambient": [0]},
            {**half, "coefficient": 5 / self.length, "ambient": [1]}]})
