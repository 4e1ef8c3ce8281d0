# SPDX-License-Identifier: BSD-3-Clause
"""A mesh that smg has converted once, and its solutions of problems on it."""
import json
import os
import subprocess
from typing import NamedTuple

import numpy as np

from mesh_arrays import read_arrays, write_legacy_vtk


class Solution(NamedTuple):
    """The results of smg, in the order of the converted mesh."""
    u: np.ndarray       # (vertices, columns); NaN at vertices of no cell
    gradient: np.ndarray | None  # (cells, 3 * columns), if the problem's outputs name it
    flux: np.ndarray | None      # the same of -K grad u
    report: dict


class StreamedMesh:
    """A mesh in a folder: mesh.vtk with its columns, and mesh.vsm, which smg makes of it.

    program         the program smg
    folder          its own existing folder
    points, cells   (vertices, 3), (cells, 3 or 4)
    vertex_columns  {name: array}, see write_legacy_vtk; the same cell_columns
    """

    def __init__(self, program, folder, points, cells, vertex_columns=None, cell_columns=None):
        self.program, self.folder = program, folder
        self.points, self.cells = points, cells
        self.vertex_columns, self.cell_columns = vertex_columns or {}, cell_columns or {}
        write_legacy_vtk(self._path("mesh.vtk"), points, cells, vertex_columns, cell_columns)
        self._run("convert", self._path("mesh.vtk"), self._path("mesh.vsm"))

    def _path(self, name):
        return os.path.join(self.folder, name)

    def _run(self, *arguments):
        done = subprocess.run([self.program, *map(str, arguments), "--quiet"],
                              capture_output=True, text=True, check=False)
        if done.returncode != 0:
            raise RuntimeError(done.stderr.strip())

    def solve(self, problem, tolerance=1e-10, *options):
        """Solves a problem, given as the content of its JSON file, to a relative residual."""
        with open(self._path("problem.json"), "w", encoding="utf-8") as file:
            json.dump(problem, file)
        out = self._path("out.vtp" if self.cells.shape[1] == 3 else "out.vtu")
        self._run("solve", self._path("mesh.vsm"), out, "--problem", self._path("problem.json"),
                  "--tolerance", tolerance, "--max-cycles", 200,
                  "--report", self._path("report.json"), *options)
        arrays = read_arrays(out)
        with open(self._path("report.json"), encoding="utf-8") as file:
            report = json.load(file)
        return Solution(self._restored(arrays, "Solution", "OriginalId", len(self.points)),
                        self._restored(arrays, "Gradient", "OriginalCellId", len(self.cells)),
                        self._restored(arrays, "Flux", "OriginalCellId", len(self.cells)), report)

    @staticmethod
    def _restored(arrays, name, numbers, count):
        """The rows of an array at the positions given by its numbers; None if there is no such array."""
        if name not in arrays:
            return None
        values = arrays[name].astype(float).reshape(len(arrays[numbers]), -1)
        result = np.full((count, values.shape[1]), np.nan)
        result[arrays[numbers]] = values
        return result


def read_with_smg(program, folder, name):
    """The points (in the file's own precision) and the triangles or tetrahedra of a mesh file of any
    format; tetrahedra if it has both. Isolated vertices are left out."""
    stream, plain = os.path.join(folder, "read.vsm"), os.path.join(folder, "read")
    for cells in ((), ("--cells", "tets")):
        done = subprocess.run([program, "convert", name, stream, "--quiet", *cells],
                              capture_output=True, text=True, check=False)
        if done.returncode == 0:
            break
    else:
        raise RuntimeError(done.stderr.strip())
    info = os.path.join(folder, "read.json")
    subprocess.run([program, "info", stream, "--quiet", "--report", info], check=True)
    with open(info, encoding="utf-8") as file:
        corners = 4 if json.load(file)["cell_type"].startswith("tet") else 3
    plain += ".vtp" if corners == 3 else ".vtu"
    subprocess.run([program, "convert", stream, plain, "--order", "keep", "--quiet"], check=True)
    arrays = read_arrays(plain)
    return arrays["Points"], arrays["connectivity"].reshape(-1, corners)
