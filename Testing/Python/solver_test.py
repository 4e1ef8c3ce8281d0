# SPDX-License-Identifier: BSD-3-Clause
"""Solutions and solvers against SciPy's direct solve."""

import inspect
import os
import tempfile
import unittest

from testing import bits, cube, need, np, smg, sphere, stiffness_and_mass

need("scipy")
from scipy.sparse import diags  # noqa: E402
from scipy.sparse.linalg import cg, spsolve  # noqa: E402

POINTS, TRIANGLES = sphere(5)
STIFFNESS, MASS = stiffness_and_mass(POINTS, TRIANGLES)
HELD = POINTS[:, 2] > 0.9


def with_dirichlet(matrix, held):
    """The matrix with the rows of held vertices replaced by those of the identity."""
    return (diags((~held).astype(float)) @ matrix + diags(held.astype(float))).tocsc()


class SolveTest(unittest.TestCase):
    """On 40,962 vertices. The weights of edges are in single precision, whose errors cancel."""

    points, triangles = sphere(6)

    def close(self, found, expected):
        self.assertLess(np.abs(found - expected).max(), 1e-9 * np.ptp(expected))

    def test_poisson(self):
        stiffness, mass = stiffness_and_mass(self.points, self.triangles)
        x, y, z = self.points.T
        found = smg.solve(self.points, self.triangles, source=x * y, dirichlet=smg.above(z=0.9) >> y,
                          tolerance=1e-10)
        matrix = with_dirichlet(stiffness, z >= 0.9)
        self.close(found, spsolve(matrix, np.where(z >= 0.9, y, mass * x * y)))

    def test_screened(self):
        stiffness, mass = stiffness_and_mass(self.points, self.triangles)
        source = np.sin(5 * self.points[:, 0])
        screening = 1 + self.points[:, 2] ** 2
        found = smg.solve(self.points, self.triangles, source=source, screening=screening,
                          tolerance=1e-10)
        self.close(found, spsolve((stiffness + diags(mass * screening)).tocsc(), mass * source))


class SolverTest(unittest.TestCase):
    def setUp(self):
        self.matrix = with_dirichlet(STIFFNESS + 2 * diags(MASS), HELD)
        self.solver = smg.solver(POINTS, TRIANGLES, screening=2, dirichlet=smg.mask(HELD) >> 0)
        self.b = np.random.default_rng(0).standard_normal((len(POINTS), 3)) * MASS[:, None]

    def test_multiply(self):
        for x in (self.b[:, 0], self.b, self.b.astype(np.float32), np.asfortranarray(self.b)):
            error = np.abs(self.solver @ x - self.matrix @ x)
            self.assertTrue((error <= 2e-7 * (abs(self.matrix) @ np.abs(x))).all())  # of single precision
            self.assertEqual((self.solver @ x).shape, x.shape)

    def test_solve(self):
        expected = spsolve(self.matrix, self.b)
        x = self.solver.solve(self.b, tol=1e-11)
        self.assertLess(np.abs(x - expected).max(), 3e-9 * np.ptp(expected))
        one = self.solver.solve(self.b[:, 1], tol=1e-11)
        self.assertEqual(one.shape, (len(POINTS),))
        self.assertLess(np.abs(one - expected[:, 1]).max(), 3e-9 * np.ptp(expected))
        self.assertTrue(self.solver.report.converged)
        np.testing.assert_array_equal(x[HELD], self.b[HELD])
        # From the solution it has nothing to do.
        again = self.solver.solve(self.b, x0=expected, tol=0.5)
        self.assertLess(np.abs(again - expected).max(), 3e-9 * np.ptp(expected))

    def test_on_disk(self):
        with tempfile.TemporaryDirectory() as folder:
            mesh = smg.mesh(POINTS, TRIANGLES)
            solver = mesh.solver(
                screening=2, dirichlet=smg.mask(HELD) >> 0, on_disk=True, memory="32MB", threads=1)
            expected = self.solver.solve(self.b, tol=1e-11)
            for _ in range(2):
                self.assertEqual(bits(solver.solve(self.b, tol=1e-11)), bits(expected))
            # Vectors in files, and a warm start from what the file has.
            path = os.path.join(folder, "x.bin")
            x = np.memmap(path, np.float64, mode="w+", shape=(len(POINTS),))
            b = np.ascontiguousarray(self.b[:, 0])
            self.assertIs(solver.solve(b, out=x, tol=1e-11), x)
            x.flush()
            found = np.fromfile(path)
            np.testing.assert_array_equal(found, self.solver.solve(b, tol=1e-11))
            cycles = solver.report["cycles"]
            solver.solve(b, x0=x, out=x, tol=1e-1)
            self.assertLess(solver.report["cycles"], cycles)
            for call in (
                lambda: solver.multiply(b), lambda: solver.precondition(b),
                lambda: solver.solve(b, out=b), lambda: solver.solve(b, out=np.zeros(3)),
                lambda: solver.solve(b, out=[0.0]), lambda: solver.solve(np.where(HELD, np.nan, b)),
            ):
                self.assertRaises(smg.InputError, call)
            np.testing.assert_array_equal(solver.solve(b, tol=1e-11), found)
            del x

    def test_preconditioner(self):
        iterations = []
        b = np.where(HELD, 3.0, self.b[:, 0])
        tolerance = "rtol" if "rtol" in inspect.signature(cg).parameters else "tol"
        x, info = cg(self.solver.A, b, x0=self.solver.precondition(b),
                     M=self.solver.aspreconditioner(), atol=0, callback=iterations.append, **{tolerance: 1e-10})
        self.assertEqual(info, 0)
        self.assertLess(len(iterations), 25)
        expected = spsolve(self.matrix, b)
        self.assertLess(np.abs(x - expected).max(), 1e-8 * np.ptp(expected))

    def test_preconditioner_is_symmetric_and_positive(self):
        r = self.b * ~HELD[:, None]
        z = self.solver.precondition(r)
        gram = r.T @ z
        np.testing.assert_allclose(gram, gram.T, rtol=0, atol=1e-7 * np.abs(gram).max())
        self.assertGreater(np.linalg.eigvalsh(gram).min(), 0)
        np.testing.assert_array_equal(self.solver.precondition(self.b)[HELD], self.b[HELD])
        self.assertEqual(bits(z[:, 1]), bits(self.solver.precondition(r[:, 1])))

    def test_what_belongs_to_the_right_hand_side_is_refused(self):
        for name in ("source", "flux", "field", "initial"):
            with self.assertRaisesRegex(smg.InputError, name):
                smg.solver(POINTS, TRIANGLES, **{name: 1.0})

    def test_values_that_are_not_used_are_said(self):
        north = smg.above(z=0.9)
        for given in ({"dirichlet": north >> 3.0}, {"dirichlet": {0: 1.0}}, {"soft": north >> (1, 7)}):
            with self.assertWarnsRegex(smg.ReportWarning, next(iter(given))):
                smg.solver(POINTS, TRIANGLES, **given)

    def test_tetrahedra(self):
        points, cells = cube(8)
        solver = smg.mesh(points, cells).solver(dirichlet=smg.boundary >> 0)
        b = solver @ points
        np.testing.assert_allclose(solver.solve(b, tol=1e-11), points, atol=1e-9)

    def test_errors(self):
        for call in (
            lambda: self.solver.solve(np.ones(3)),
            lambda: self.solver.solve(np.full(len(POINTS), np.nan)),
            lambda: self.solver.solve(self.b, x0=self.b[:, 0]),
            lambda: self.solver.solve(self.b * 1j),
            lambda: self.solver.precondition(np.ones((3, 1))),
            lambda: smg.solver(POINTS, TRIANGLES, screening=2, tolerance=1e-3),
        ):
            self.assertRaises(smg.InputError, call)
        self.assertRaises(smg.Error, lambda: smg.solver(POINTS, TRIANGLES, screening=2, memory=1000))
        with self.assertWarns(smg.NotConvergedWarning):
            self.solver.solve(self.b, tol=1e-13, max_cycles=1)
        self.assertRaises(smg.NotConverged, self.solver.solve, self.b, tol=1e-13, max_cycles=1,
                          strict=True)  # fmt: skip


unittest.main(verbosity=2)
