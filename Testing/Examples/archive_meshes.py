# SPDX-License-Identifier: BSD-3-Clause
"""The archive of real meshes, for the scripts of this folder; they are skipped where there is none."""

import os
import sys

ARCHIVE = os.environ["SMG_TEST_DATA_DIR"]
CHOSEN = {"bunny_tet.mesh": ("--cells", "tets")}  # how to convert it, where that must be said

if not ARCHIVE:
    print("skipped: SMG_TEST_DATA_DIR names no archive of meshes")
    sys.exit(77)


def in_archive(name):
    return os.path.join(ARCHIVE, name)
