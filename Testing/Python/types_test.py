# SPDX-License-Identifier: BSD-3-Clause
"""Type checkers and editors see what the package takes, by the stub that the build makes: what documents and
examples show has no errors, and wrong calls have."""

import glob
import os
import subprocess
import sys
import unittest

from testing import SOURCE, need, smg

need("mypy")

from documents import blocks  # noqa: E402

WRONG = """
import streamingmultigrid as smg

mesh = smg.open("a.ply", memory="1GB")
mesh.solve(dirichlets=0)
mesh.solve(weights="clampd")
mesh.solve(threads="all")
mesh.smooth(boundary="open")
mesh.deform()
mesh.estimate("smoth")
smg.open(7)
smg.solve([[0, 0, 0]], [[0, 1, 2]], tolerance="fast")
smg.distance([[0, 0, 0]], [[0, 1, 2]], [0], sources=3)
mesh.simplify("many")
mesh.points.shapes
mesh.solve().reports
mesh.solve().report.residual
mesh.estimate("smooth").memory
smg.dirichlet(smg.boundary)
smg.robin(smg.boundary, 1)
mesh.save("a.ply", text="yes")
mesh.save(path=None)
smg.mesh([[0, 0, 0]], [[0, 1, 2]], order="zig")
mesh.solver(tolerance=1e-8)
smg.handle(smg.boundary, fixd=True)
"""
RIGHT = """
from typing import Any

import numpy as np
import numpy.typing as npt
import streamingmultigrid as smg
from pathlib import Path

mesh: smg.Mesh = smg.open(Path("a.ply"), memory=2e9, cache=True)
part: smg.Region = (smg.boundary & smg.above(z=0)) | ~smg.mask(np.ones(3))
u: smg.Field = mesh.solve(
    dirichlet=[part >> 0, smg.tag("a", 3) >> "column", {0: 1.0}],
    source=[1, part >> np.ones(3)],
    robin=[part >> (100, 20)],
    conductivity=[25, part >> 200],
    outputs=["gradient", "flux"],
    tolerance="auto",
    progress=lambda done: None,
)
values: npt.NDArray[Any] = u.to_numpy() + np.sqrt(u)
small: smg.Mesh = mesh.smooth(size="8edges", hold=[part, [1, 2]]).simplify(1000)
name: str = small.name
report: smg.Report = u.report
last: float = report.residuals[-1]
notes: list[str] = report.notes
plain: dict[str, Any] = report.to_dict()
mesh.solve(dirichlet=smg.dirichlet([0, 1], 0), flux=[smg.neumann(part, 1.0)], robin=[smg.robin(values > 0, 1, 20)])
mesh.save("a.stl", text=True)
blended: smg.Field = mesh.blend({"a": values}, patch=values > 0)
moved: npt.NDArray[Any] = smg.deform(values, values, [smg.handle(part, rotate=([0, 1, 0], 30))])
mesh["a"] = [1, 2, 3]
x: npt.NDArray[Any] = mesh.solver(dirichlet=part >> 0).solve(values)
"""


def errors(name, *texts, package=None):
    """What mypy says of files, or of the sources of a package, without the sentence that sums it up."""
    files = []
    for number, text in enumerate(texts):
        files.append("%s_%d.py" % (name, number))
        with open(files[-1], "w", encoding="utf-8") as file:
            file.write(text)
    files += ["-p", package] if package else []
    command = [sys.executable, "-m", "mypy", "--no-error-summary", "--cache-dir=.mypy-" + name, *files]
    place = os.path.join(SOURCE, "Python") if package else os.environ["PYTHONPATH"].split(os.pathsep)[0]
    environment = {**os.environ, "MYPYPATH": place}
    done = subprocess.run(
        command + ["--ignore-missing-imports", "--check-untyped-defs"],
        capture_output=True,
        text=True,
        env=environment,
        timeout=600,
    )
    return [line for line in (done.stdout + done.stderr).splitlines() if ": note:" not in line]


class TypesTest(unittest.TestCase):
    maxDiff = None

    def test_wrong_calls_are_errors(self):
        lines = WRONG.splitlines()
        wrong = [n + 1 for n, line in enumerate(lines) if n > 3 and line]
        found = {int(line.split(":")[1]) for line in errors("wrong", WRONG)}
        self.assertEqual([lines[n - 1] for n in wrong if n not in found], [])
        self.assertEqual([lines[n - 1] for n in found if n not in wrong], [])

    def test_right_calls_are_not(self):
        self.assertEqual(errors("right", RIGHT), [])

    def test_the_package_itself(self):
        self.assertEqual(errors("package", package="streamingmultigrid"), [])

    def test_documents_and_examples(self):
        texts = [blocks("docs/python.md", ""), blocks("README.md", "streamingmultigrid as smg")]
        for path in sorted(glob.glob(os.path.join(SOURCE, "Examples", "*", "python", "*.py"))):
            with open(path, encoding="utf-8") as file:
                texts.append(file.read())
        self.assertGreater(len(texts), 5)
        texts.append(
            "import streamingmultigrid as smg\n"
            + "".join("smg.%s\n" % name for name in [*smg.__all__, "open", "__version__"])
        )
        self.assertEqual(errors("example", *texts), [])


if __name__ == "__main__":
    unittest.main(verbosity=2)
