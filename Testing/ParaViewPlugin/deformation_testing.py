# SPDX-License-Identifier: BSD-3-Clause
"""Shared code of the deformation tests: the bunny with fixed feet and turned ears."""

import smg_testing as t

EARS_CENTER, EARS_ANGLE, EARS_SCALE, EARS_SHIFT = [-0.06, 0.17, 0.0], 40.0, 1.1, [0.0, 0.01, 0.0]

# The same for the program smg.
HANDLE_FILE = {"weights": "clamped", "handles": [
    {"region": {"halfspace": [0, -1, 0, -t.FEET]}, "fixed": True},
    {"region": {"halfspace": [0, 1, 0, t.EARS]}, "translate": EARS_SHIFT, "scale": EARS_SCALE,
     "rotate": {"axis": [0, 1, 0], "degrees": EARS_ANGLE, "center": EARS_CENTER}}]}


def make_handles(source, MeshHandle):
    """Makes two Mesh Handles and returns the last one."""
    feet = MeshHandle(Input=source, RegionFunction="Plane", Motion="Fixed")
    feet.RegionFunction.Origin = [0, t.FEET, 0]
    feet.RegionFunction.Normal = [0, 1, 0]
    ears = MeshHandle(Input=feet, RegionFunction="Plane", Motion="Similarity")
    ears.RegionFunction.Origin = [0, t.EARS, 0]
    ears.RegionFunction.Normal = [0, -1, 0]
    ears.Center = EARS_CENTER
    ears.RotationAxis = [0, 1, 0]
    ears.RotationAngle = EARS_ANGLE
    ears.Scale = EARS_SCALE
    ears.Translation = EARS_SHIFT
    return ears
