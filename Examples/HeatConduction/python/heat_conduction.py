#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Heat conduction in a chip and its heat sink, out of core, in Python.

Two materials conduct heat: the ceramic of the chip with 25 W/(m K), the aluminium of the heat sink
with 200 W/(m K). The chip makes 50 MW/m^3, 19.6 W in all; 10 kW/m^2 leave through its solder, and air
of 20 degrees cools the heat sink with 50 W/(m^2 K). The sides of the chip are insulated. All places
are names that the mesher has given: see heat_sink.geo.

What this lesson shows:
 1. A coefficient may differ from part to part, a condition from face to face: by the names of the mesher.
 2. The report says what flows through each condition; the file has the flux in the cells.

Run it:

    python3 heat_conduction.py ../../Data/heat_sink.msh heat.vtu

    1740 vertices, 5359 cells: converged after 8 cycles, relative residual 7.3e-10
    peak: 77.748 degrees at vertex 515 of the file
    flux[0] (solder): -1.96 W into the body through 196 mm^2 of 76.5038 degrees
    robin[0] (air): -17.64 W into the body through 6980 mm^2 of 70.5444 degrees
"""

import sys

import streamingmultigrid as smg


def main():
    sink = smg.open(sys.argv[1], memory="64MB")
    heat = sink.solve(
        conductivity=[smg.group("chip") >> 25, smg.group("heat sink") >> 200],
        source=smg.group("chip") >> 5e7,  # lengths are in metres, as in the mesh
        flux=smg.group("solder") >> -10_000,
        robin=smg.group("air") >> (50, 20),  # the coefficient, and the temperature of the air
        outputs=["gradient", "flux"],
    )
    report = heat.save(sys.argv[2])
    print(
        f"{report.vertices} vertices, {report.cells} cells: "
        f"{'converged' if report.converged else 'not converged'} after {report.cycles} cycles, "
        f"relative residual {report.residuals[-1]:.2g}"
    )
    peak = report.maximum[0]
    print(f"peak: {peak['value']:.6g} degrees at vertex {peak['vertex']} of the file")
    for condition in report.conditions:
        print(
            f"{condition['name']}: {condition['flux'][0]:.6g} W into the body through "
            f"{1e6 * condition['area']:.6g} mm^2 of {condition['mean'][0]:.6g} degrees"
        )


main()
