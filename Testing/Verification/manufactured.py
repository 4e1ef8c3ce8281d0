# SPDX-License-Identifier: BSD-3-Clause
"""Problems with known solutions, on families of meshes."""
import numpy as np

import meshes

TENSOR = [2.0, 1.0, 0.5, 0.3, 0.2, 0.1]  # xx, yy, zz, xy, yz, xz
MATRIX = np.array([[2.0, 0.3, 0.1], [0.3, 1.0, 0.2], [0.1, 0.2, 0.5]])  # the same


class Sphere:
    """-lap u = f on the unit sphere without any condition, u = xyz: a spherical harmonic."""
    name = "sphere, pure Neumann"
    refinements = (8, 16, 32, 64)

    def mesh(self, n):
        return meshes.sphere(n)

    def onto(self, x):
        return x / np.linalg.norm(x, axis=1)[:, None]

    def exact(self, x):
        return np.prod(x, axis=1)

    def gradient(self, x):
        inSpace = np.stack([x[:, 1] * x[:, 2], x[:, 2] * x[:, 0], x[:, 0] * x[:, 1]], axis=1)
        return inSpace - 3 * np.prod(x, axis=1)[:, None] * x

    def problem(self, x):
        """The problem, and its columns at the vertices (n, 3)."""
        return {"source": "Source"}, {"Source": 12 * self.exact(x)}


class ScreenedSphere(Sphere):
    """-lap u + u = f on the unit sphere, u = xyz."""
    name = "sphere, screened"

    def problem(self, x):
        return {"source": "Source", "screening": 1}, {"Source": 13 * self.exact(x)}


class GradedSurface:
    """-lap u = f on a half cylinder, cells up to n times as long as others: u = exp(z) cos 2t, held
    below, with a flux above, insulated at the two straight edges."""
    name = "graded half cylinder, flux"
    refinements = (8, 16, 32, 64)

    def mesh(self, n):
        return meshes.half_cylinder(n, grading=2.0)

    def onto(self, x):
        radius = np.hypot(x[:, 0], x[:, 1])
        return np.stack([x[:, 0] / radius, x[:, 1] / radius, x[:, 2]], axis=1)

    def exact(self, x):
        return np.exp(x[:, 2]) * (x[:, 0]**2 - x[:, 1]**2)

    def gradient(self, x):
        along = -4 * np.exp(x[:, 2]) * x[:, 0] * x[:, 1]  # d/dt
        return np.stack([-along * x[:, 1], along * x[:, 0], self.exact(x)], axis=1)

    def problem(self, x):
        return ({"source": "Source", "dirichlet": [{"box": [-2, -2, -1, 2, 2, 0], "value": "Exact"}],
                 "flux": [{"halfspace": [0, 0, 1, 1], "value": "Exact"}]},
                {"Source": 3 * self.exact(x), "Exact": self.exact(x)})


class TensorBox:
    """-div K grad u = f in a cube with a full tensor, u = exp(z) cos(x + 2 y), held all around."""
    name = "cube, full tensor"
    refinements = (4, 8, 16, 32)

    def mesh(self, n):
        return meshes.box(n)

    def onto(self, x):
        return x

    def exact(self, x):
        return np.exp(x[:, 2]) * np.cos(x[:, 0] + 2 * x[:, 1])

    def gradient(self, x):
        slope = -np.exp(x[:, 2]) * np.sin(x[:, 0] + 2 * x[:, 1])
        return np.stack([slope, 2 * slope, self.exact(x)], axis=1)

    def problem(self, x):
        a = np.array([1.0, 2.0, 0.0])
        u, slope = self.exact(x), self.gradient(x)[:, 0]
        curvature = (MATRIX[2, 2] - a @ MATRIX @ a) * u + 2 * (MATRIX[2] @ a) * slope
        isOutside = np.any((x == 0) | (x == 1), axis=1).astype("i4")
        return ({"conductivity": TENSOR, "source": "Source",
                 "dirichlet": [{"mask": "Outside", "value": "Exact"}]},
                {"Source": -curvature, "Exact": u, "Outside": isOutside})


class RobinBall:
    """-lap u = f in the unit ball, u = sin(x + 2 y) + z^2, which exchanges heat with its surroundings."""
    name = "ball, Robin"
    refinements = (4, 8, 16, 32)
    coefficient = 2.0

    def mesh(self, n):
        return meshes.ball(n)

    def onto(self, x):
        return x

    def exact(self, x):
        return np.sin(x[:, 0] + 2 * x[:, 1]) + x[:, 2]**2

    def gradient(self, x):
        slope = np.cos(x[:, 0] + 2 * x[:, 1])
        return np.stack([slope, 2 * slope, 2 * x[:, 2]], axis=1)

    def problem(self, x):
        outwards = np.sum(self.gradient(x) * x, axis=1)
        ambient = self.exact(x) + outwards / self.coefficient
        return ({"source": "Source", "robin": [{"box": [-2, -2, -2, 2, 2, 2], "ambient": "Ambient",
                                                "coefficient": self.coefficient}]},
                {"Source": 5 * np.sin(x[:, 0] + 2 * x[:, 1]) - 2, "Ambient": ambient})


ALL = (Sphere(), ScreenedSphere(), GradedSurface(), TensorBox(), RobinBall())
