# SPDX-License-Identifier: BSD-3-Clause
"""The union of the blocks is the mesh, however many there are."""

import unittest

from testing import SINK, bits, np, smg, sphere


class BlocksTest(unittest.TestCase):
    def union(self, blocks, most, names, cell_names=()):
        """Columns in the original order; each vertex must come once without a ghost."""
        ids, cell_ids, corners = [], [], []
        values = {name: [] for name in ("Position", *names, *cell_names)}
        count = 0
        for block in blocks:
            count += 1
            self.assertLessEqual(block.n_points, most)
            self.assertEqual(block.points.shape, (block.n_points, 3))
            self.assertEqual(len(block.cells), block.n_cells)
            self.assertTrue((block.cells >= 0).all() and (block.cells < block.n_points).all())
            self.assertEqual(len(np.unique(block.cells)), block.n_points)
            own = ~block.ghost
            ids.append(block.rows[own])
            cell_ids.append(block.cell_rows)
            corners.append(block.rows[block.cells])
            for name in ("Position", *names):
                values[name].append(block[name][own])
            for name in cell_names:
                values[name].append(block[name])
        ids, cell_ids = np.concatenate(ids), np.concatenate(cell_ids)
        self.assertEqual(sorted(ids), list(range(len(ids))))
        order, cell_order = np.argsort(ids), np.argsort(cell_ids)
        self.assertEqual(sorted(cell_ids), list(range(len(cell_ids))))
        found = {name: np.concatenate(values[name])[order] for name in ("Position", *names)}
        found.update((name, np.concatenate(values[name])[cell_order]) for name in cell_names)
        found["Corners"] = np.concatenate(corners)[cell_order]
        return found, count

    def test_of_a_mesh(self):
        mesh = smg.open(SINK)
        for most in (50, 333, 1_000_000):
            found, count = self.union(mesh.blocks(max_points=most), most, [], ["PhysicalTag"])
            self.assertEqual(count == 1, most > 1740)
            self.assertEqual(bits(found["Position"]), bits(mesh.points))
            self.assertEqual(bits(found["PhysicalTag"]), bits(mesh["PhysicalTag"]))
            np.testing.assert_array_equal(np.sort(found["Corners"]), np.sort(mesh.cells))

    def test_of_a_field(self):
        points, cells = sphere(4)
        mesh = smg.mesh(points, cells)
        mesh["Height"] = points[:, 2].astype(np.float32)
        u = mesh.solve(dirichlet={0: 0.0, 99: 1.0}, outputs="gradient")
        for most in (100, 1000, 1_000_000):
            found, _ = self.union(u.blocks(most), most, ["Solution", "Height"], ["Gradient"])
            self.assertEqual(bits(found["Solution"]), bits(u.to_numpy()))
            self.assertEqual(bits(found["Gradient"]), bits(u["Gradient"]))
            self.assertEqual(bits(found["Height"]), bits(points[:, 2].astype(np.float32)))
            self.assertEqual(bits(found["Position"]), bits(points))
        moved = mesh.deform([smg.handle([0], fixed=True), smg.handle([99], target=[0, 0, 3])])
        found, _ = self.union(moved.blocks(500), 500, [])
        self.assertEqual(bits(found["Position"]), bits(moved.to_numpy()))

    def test_columns_are_chosen(self):
        mesh = smg.mesh(*sphere(2))
        mesh["A"], mesh["B"] = np.ones(162), np.ones(320)
        (block,) = mesh.blocks(columns=["B"])
        with self.assertRaises(smg.Error):
            block["A"]
        (block,) = list(mesh.blocks(columns=["B"]))[:1]
        self.assertRaisesRegex(smg.InputError, "no column 'C'", list, mesh.blocks(columns=["C"]))

    def test_a_block_passes(self):
        mesh = smg.mesh(*sphere(3))
        blocks = mesh.blocks(max_points=200)
        first = next(blocks)
        points = first.points
        next(blocks)
        self.assertIs(first.points, points)  # read before: a copy
        with self.assertRaisesRegex(smg.Error, "has passed"):
            first.cells
        blocks.close()
        for wrong in (0, 3, -1, 10.0, "many", True):
            with self.assertRaisesRegex(smg.InputError, "max_points: .*at least 4"):
                list(mesh.blocks(max_points=wrong))

    def test_columns_of_blocks_are_those_of_the_mesh(self):
        """Also where OriginalId has the numbers of another mesh, and no column a meaning."""
        mesh = smg.mesh(*sphere(4)).simplify(500)
        mesh["Ghost"] = np.arange(mesh.n_vertices) + 7
        for job in (mesh.solve, mesh.solver):
            with self.assertRaisesRegex(smg.InputError, "OriginalId"):  # 99 is another vertex there
                job(dirichlet={0: 0.0, 99: 1.0})
        for source in (mesh, mesh.solve(dirichlet=smg.mask(np.arange(mesh.n_vertices) < 2) >> 0, source=1)):
            for name in ("OriginalId", "Ghost"):
                whole = source[name]
                for block in source.blocks(max_points=100):
                    np.testing.assert_array_equal(block[name], whole[block.rows])
                    np.testing.assert_array_equal(block.points, mesh.points[block.rows])
        self.assertGreater(mesh["OriginalId"].max(), mesh.n_vertices)

    def test_nothing_iterates_over_numbers(self):
        mesh = smg.mesh(*sphere(2))
        for thing in (mesh, mesh.distance([0]), next(mesh.blocks())):
            self.assertRaises(TypeError, list, thing)


unittest.main(verbosity=2)
