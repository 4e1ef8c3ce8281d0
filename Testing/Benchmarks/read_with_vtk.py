#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""read_with_vtk.py MESH OUT.json : the cost of holding the mesh of a .ply or .vtk file in memory.

Reads the file with VTK's own reader in this process, writes the numbers and prints a sentence.
"""

import json
import resource
import sys
import time


def reader_of(path):
    if path.endswith(".ply"):
        from vtkmodules.vtkIOPLY import vtkPLYReader

        return vtkPLYReader()
    from vtkmodules.vtkIOLegacy import vtkDataSetReader

    return vtkDataSetReader()


def cpu_seconds():
    usage = resource.getrusage(resource.RUSAGE_SELF)
    return usage.ru_utime + usage.ru_stime


def peak_bytes():
    # Not ru_maxrss, which a child inherits from its parent.
    with open("/proc/self/status") as status:
        for line in status:
            if line.startswith("VmHWM:"):
                return 1024 * int(line.split()[1])


def main(path, out):
    reader = reader_of(path)
    reader.SetFileName(path)
    before, begin = cpu_seconds(), time.monotonic()
    reader.Update()
    mesh = reader.GetOutput()
    if mesh is None or mesh.GetNumberOfCells() == 0:
        sys.exit(f"read_with_vtk.py: {path}: VTK's reader delivers no cells.")
    numbers = {
        "vertices": mesh.GetNumberOfPoints(),
        "cells": mesh.GetNumberOfCells(),
        "cpu_seconds": cpu_seconds() - before,
        "wall_seconds": time.monotonic() - begin,
        "peak_bytes": peak_bytes(),
    }
    with open(out, "w") as file:
        json.dump(numbers, file, indent=2)
    print(
        f"\nVTK's {reader.GetClassName()} alone, which only reads: "
        f"{1e6 * numbers['cpu_seconds'] / numbers['vertices']:.2f} CPU us/vertex, "
        f"{numbers['peak_bytes'] / 2**20:.0f} MiB resident."
    )


main(*sys.argv[1:])
