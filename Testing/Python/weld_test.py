# SPDX-License-Identifier: BSD-3-Clause
"""Points that were merged: arrays have their rows, and at each the result is that of the point that stayed."""

import unittest
import warnings

from testing import bits, cube, np, smg, sphere

NOISE, WELD = 1e-9, 1e-4


def soup(points, cells, noise):
    """The cells with points of their own, and one point of no cell: points, cells, the original of each point."""
    original = np.append(cells.reshape(-1), -1)
    own = np.concatenate([points[cells.reshape(-1)], [[7.0, 8.0, 9.0]]])
    if noise:
        own += np.random.default_rng(1).uniform(-noise, noise, own.shape)
    return own, np.arange(cells.size).reshape(cells.shape), original


def write_vtk(name, points, cells):
    with open(name, "w", encoding="ascii") as file:
        file.write("# vtk DataFile Version 3.0\n\nASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS %d double\n" % len(points))
        np.savetxt(file, points, fmt="%.17g")
        file.write("CELLS %d %d\n" % (len(cells), cells.size + len(cells)))
        np.savetxt(file, np.insert(cells, 0, cells.shape[1], axis=1), fmt="%d")
        file.write("CELL_TYPES %d\n" % len(cells) + ("5\n" if cells.shape[1] == 3 else "10\n") * len(cells))
        file.write("POINT_DATA %d\nSCALARS Own double 1\nLOOKUP_TABLE default\n" % len(points))
        np.savetxt(file, np.arange(len(points)), fmt="%d")


class WeldTest(unittest.TestCase):
    def meshes(self):
        """What it is, the mesh, the original of each of its points, and the original mesh."""
        for kind, (points, cells) in (("surface", sphere(2)), ("solid", cube(2))):
            for noise, weld in ((0.0, 0.0), (NOISE, WELD)):
                own, corners, original = soup(points, cells, noise)
                name = "%s%g.vtk" % (kind, weld)
                write_vtk(name, own, corners)
                whole = smg.mesh(points, cells)
                yield kind + " of arrays", smg.mesh(own, corners, weld=weld), original, whole
                yield kind + " of a file", smg.open(name, weld=weld), original, whole
                yield kind + " converted", smg.open(name, weld=weld, cache="cached"), original, whole
                yield kind + " again", smg.open(name, weld=weld, cache="cached"), original, whole

    def jobs(self, kind, mesh):
        low, high = mesh.bounds[0], mesh.bounds[1]
        if high > 6:  # that of the point of no cell
            high = 1.0
        ends = [smg.below(x=low + 0.1) >> 0, smg.box([high - 0.1, -5, -5], [high, 5, 5]) >> 1]
        part = smg.below(x=low + 0.2)
        yield "solve", lambda m: m.solve(dirichlet=ends)
        yield "two", lambda m: m.solve(dirichlet=[ends[0].region >> [0, 1], ends[1].region >> [1, 5]])
        yield "deform", lambda m: m.deform([smg.handle(part, fixed=True), smg.handle(ends[1].region, translate=[0, 0, 1])])
        yield "distance", lambda m: m.distance(part, direction=True)
        if kind == "surface":
            yield "smooth", lambda m: m.smooth(size="6edges", hold=part)

    def test_results_of_merged_points(self):
        for what, mesh, original, whole in self.meshes():
            at = original[:-1]
            for name, job in self.jobs(what.split()[0], mesh):
                with self.subTest(what, job=name):
                    field = job(mesh)
                    expected = job(whole)
                    chained = field.as_mesh()
                    for column in field.names:
                        values = field[column]
                        self.assertEqual(len(values), len(original))
                        first = np.zeros(whole.n_vertices, int)
                        first[at[::-1]] = np.arange(len(at))[::-1]
                        self.assertEqual(bits(values[:-1]), bits(values[first[at]]), column)
                        if column != "DistanceDirection":  # of equally long ways, noise chooses one
                            np.testing.assert_allclose(values[:-1], expected[column][at], rtol=1e-4, atol=1e-5)
                        self.assertEqual(bits(chained[column]), bits(values))
                        next_values = chained.distance(smg.below(x=mesh.bounds[0] + 0.1)).to_numpy()
                        self.assertEqual(bits(next_values[:-1]), bits(next_values[first[at]]))
                    self.assertEqual(bits(np.asarray(field)), bits(field.to_numpy()))
                    if name in ("solve", "two"):
                        self.assertTrue(np.isnan(field.to_numpy()[-1]).all())  # of no cell
                    for block in field.blocks(60):
                        self.assertEqual(bits(block[field.name]), bits(field[field.name][block.rows]))
                    with warnings.catch_warnings():
                        warnings.simplefilter("ignore", smg.ReportWarning)
                        field.save("result.vtu")
                    field.save("result.vsm")
                    with smg.open("result.vsm") as saved:
                        for column in field.names:
                            self.assertEqual(bits(saved[column]), bits(field[column]), column)
                    with smg.open("result.vtu") as saved:
                        self.assertEqual(saved.n_vertices, whole.n_vertices)
                        self.assertFalse(np.isnan(saved[field.name]).any())

    def test_what_the_file_has_stays(self):
        for what, mesh, original, _ in self.meshes():
            with self.subTest(what):
                self.assertEqual(mesh.n_vertices, len(original))
                if "Own" in mesh:
                    self.assertEqual(bits(mesh["Own"]), bits(np.arange(len(original), dtype=float)))
                mesh["Added"] = smg.of_vertices(np.arange(len(original)))
                self.assertEqual(bits(mesh["Added"]), bits(np.arange(len(original))))
                chained = mesh.distance([int(mesh.cells[0, 0])]).as_mesh()
                self.assertEqual(bits(chained["Added"]), bits(mesh["Added"]))

    def test_regions(self):
        for what, mesh, original, _ in self.meshes():
            with self.subTest(what):
                selected = mesh.select(smg.below(x=0.5 * (mesh.bounds[0] + 1)))
                by_original = np.zeros(original.max() + 1, bool)
                by_original[original[:-1]] = selected[:-1]
                self.assertEqual(bits(selected[:-1]), bits(by_original[original[:-1]]))
                self.assertTrue(0 < selected.sum() < len(selected))

    def test_any_point_of_a_place_names_its_vertex(self):
        """Numbers, masks and values of points that were merged with others."""
        for what, mesh, original, _ in self.meshes():
            corner, far = original[0], original[-2]
            ends = [np.flatnonzero(original == each) for each in (corner, far)]
            self.assertTrue(all(len(rows) > 1 for rows in ends))
            results = []
            for pick in (0, -1):
                rows = [int(each[pick]) for each in ends]
                masks = [np.arange(len(original)) == row for row in rows]
                with self.subTest(what, rows=rows):
                    self.assertEqual(np.flatnonzero(mesh.select(smg.vertices([rows[0]]))).tolist(), ends[0].tolist())
                    self.assertEqual(np.flatnonzero(mesh.select(masks[0])).tolist(), ends[0].tolist())
                    held = [smg.handle(masks[0], fixed=True), smg.handle([rows[1]], translate=[0, 0, 1])]
                    results.append([
                        mesh.solve(dirichlet=dict(zip(rows, (0.0, 1.0)))).to_numpy(),
                        mesh.solve(dirichlet=[smg.mask(mask) >> value for mask, value in zip(masks, (0, 1))]).to_numpy(),
                        mesh.distance([rows[0]]).to_numpy(),
                        mesh.distance(masks[0]).to_numpy(),
                        mesh.deform(held).to_numpy(),
                    ])
            for first, last in zip(*results):
                self.assertEqual(bits(first), bits(last))
            self.assertEqual(bits(results[0][0]), bits(results[0][1]))
            both = {int(row): 2.0 for row in ends[0]}
            mesh.solve(dirichlet=both, screening=1.0)
            with self.subTest(what), self.assertRaisesRegex(smg.InputError, "several values"):
                mesh.solve(dirichlet={**both, int(ends[0][-1]): 3.0})
            source = np.zeros(len(original))
            source[ends[0]] = 1.0
            with warnings.catch_warnings():
                warnings.simplefilter("error")
                mesh.solve(source=source, screening=1.0)
            source[ends[0][-1]] = 2.0
            with self.assertWarnsRegex(smg.ReportWarning, "source: 1 point was merged"):
                mesh.solve(source=source, screening=1.0)

    def test_pyvista(self):
        try:
            import pyvista  # noqa: F401
        except ImportError:
            self.skipTest("PyVista is not installed")
        _, mesh, original, _ = next(iter(self.meshes()))
        field = mesh.solve(dirichlet=[smg.below(x=-0.9) >> 0, smg.box([0.9, -5, -5], [1, 5, 5]) >> 1])
        self.assertEqual(bits(field.to_pyvista().point_data["Solution"]), bits(field.to_numpy()))


if __name__ == "__main__":
    unittest.main(verbosity=2)
