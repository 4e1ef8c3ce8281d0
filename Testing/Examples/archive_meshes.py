# SPDX-License-Identifier: BSD-3-Clause
"""The archive of real meshes, for the scripts of this folder; without it they are skipped."""

import os
import sys

ARCHIVE = os.environ["SMG_TEST_DATA_DIR"]
CHOSEN = {"bunny_tet.mesh": ("--cells", "tets")}  # options of its conversion, where required

if not ARCHIVE:
    print("skipped: SMG_TEST_DATA_DIR names no archive of meshes")
    sys.exit(77)


def in_archive(name):
    return os.path.join(ARCHIVE, name)
