# SPDX-License-Identifier: BSD-3-Clause
"""Points that were merged with others (``weld=``): arrays have their rows, and jobs the vertex that stayed."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from ._arrays import counted
from ._errors import ReportWarning, warn


class Merged(NamedTuple):
    """The rows of the points that were merged, ascending, and for each the row of the vertex that stayed."""

    rows: np.ndarray
    kept: np.ndarray

    def vertices(self, rows: np.ndarray) -> np.ndarray:
        """The rows of the vertices that points in these rows have become."""
        if not len(self.rows):
            return rows
        place = np.minimum(np.searchsorted(self.rows, rows), len(self.rows) - 1)
        return np.where(self.rows[place] == rows, self.kept[place], rows)

    def mask(self, mask: np.ndarray) -> np.ndarray:
        """A mask of the points, with all that are at the place of one of it."""
        if len(self.rows):
            mask = mask.copy()
            selected = mask[self.rows] != 0
            mask[self.kept[selected]] = mask[self.rows][selected]
            mask[self.rows] = mask[self.kept]
        return mask

    def warn_of(self, values: np.ndarray, what: str) -> None:
        """Warns if values at merged points, a row for each point, are not those of the vertices."""
        if not len(self.rows):
            return
        own, used = values[self.rows], values[self.kept]
        differ = ((own != used) & ((own == own) | (used == used))).reshape(len(own), -1).any(axis=1)
        if differ.any():
            count = np.count_nonzero(differ)
            warn(
                "%s: %s merged with another one, and the array has another value there: that of the point that "
                "stayed is used." % (what, counted(count, "point was", "points were")),
                ReportWarning,
            )
