#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Heat conduction in a chip and its heat sink, out of core, in Python.

Two materials conduct heat: the ceramic of the chip with 25 W/(m K), the aluminium of the heat sink
with 200 W/(m K). Heat flows in through the bottom of the chip with 100 kW/m^2; air of 20 degrees
cools the top of the plate and the fins with 100 W/(m^2 K). All other surfaces are insulated.

What this lesson shows:
 1. A coefficient may differ from region to region: the last one that a cell lies in counts.
 2. A facet of the boundary is in a region if all its corners are.
 3. The report says what flows through each condition; the file has the flux in the cells.

Run it:

    python3 heat_conduction.py ../../Data/heat_sink.vtk heat.vtu

    2116 vertices, 6822 cells: converged after 8 cycles, relative residual 6.8e-09
    peak: 67.8414 degrees at vertex 36 of the file
    flux[0]: 19.6 W into the body through 196 mm^2 of 67.2205 degrees
    robin[0]: -19.6 W into the body through 5476 mm^2 of 55.7925 degrees
"""

import sys

import streamingmultigrid as smg


def main():
    sink = smg.open(sys.argv[1], memory="64MB")
    heat = sink.solve(
        conductivity=[smg.everywhere >> 25, smg.tag("Material", 2) >> 200],
        flux=smg.below(z=0.001) >> 100_000,  # lengths are in metres; z points up
        robin=smg.above(z=0.005) >> (100, 20),  # the coefficient, and the temperature of the air
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
