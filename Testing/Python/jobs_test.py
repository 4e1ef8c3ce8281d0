# SPDX-License-Identifier: BSD-3-Clause
"""Each job in Python has the bits of the command line, from files and from arrays."""

import gzip
import json
import lzma
import os
import shutil
import unittest
import warnings

from testing import (
    BUNNY, SINK, SOURCE, bits, cube, file_result, np, run, smg, sphere, write_off,
)  # fmt: skip

HEAT = {
    "conductivity": [smg.group("chip") >> 25, smg.group("heat sink") >> 200],
    "source": smg.group("chip") >> 5e7,
    "flux": smg.group("solder") >> -10000,
    "robin": smg.group("air") >> (50, 20),
    "outputs": ["gradient", "flux"],
}
HELD = smg.sphere((-0.07, 0.14, 0.01), 0.04)


class CommandLineTest(unittest.TestCase):
    def test_solve(self):
        run("solve", SINK, "heat.vsm", "--problem",
            os.path.join(SOURCE, "Examples", "HeatConduction", "heat.json"), "--report", "heat.json")
        mesh = smg.open(SINK)
        heat = mesh.solve(**HEAT)
        self.assertEqual(heat.shape, (1740,))
        for name in ("Solution", "Gradient", "Flux"):
            self.assertEqual(bits(heat[name]), bits(file_result("heat.vsm", name)), name)
        with open("heat.json", encoding="utf-8") as file:
            said = json.load(file)
        for key in ("residuals", "conditions", "energy", "mean", "minimum", "maximum", "balance"):
            self.assertEqual(heat.report[key], said[key], key)
        self.assertAlmostEqual(heat.report.maximum[0]["value"], 77.75, 2)
        # Files have the same bytes, too.
        heat.save("python.vtu")
        run("solve", SINK, "smg.vtu", "--problem",
            os.path.join(SOURCE, "Examples", "HeatConduction", "heat.json"))
        with open("python.vtu", "rb") as one, open("smg.vtu", "rb") as two:
            self.assertEqual(one.read(), two.read())

    def test_deform(self):
        file = os.path.join(SOURCE, "Examples", "Deformation", "bunny.json")
        run("deform", BUNNY, "deformed.vsm", "--handles", file)
        mesh = smg.open(BUNNY)
        one = mesh.deform([
            smg.handle(smg.below(y=0.05), fixed=True),
            smg.handle(smg.sphere((-0.068, 0.134, 0.027), 0.034),
                       rotate={"axis": [0, 1, 0], "degrees": 70, "center": [-0.065, 0.11, 0.01]},
                       scale=1.3, translate=[-0.015, 0.012, 0.01]),
            smg.handle(smg.sphere((-0.068, 0.175, -0.055), 0.025), rotate=((-0.4, 0.8, 0.45), 90),
                       center=(-0.065, 0.152, -0.008), scale=1.3, translate=(-0.037, 0.025, 0.02)),
        ], weights="clamped", tolerance=1e-6)  # fmt: skip
        two = mesh.deform(file)
        expected = file_result("deformed.vsm", "Position")
        self.assertEqual(bits(two.to_numpy().astype(np.float32)), bits(expected.astype(np.float32)))
        self.assertEqual(bits(one.to_numpy()), bits(two.to_numpy()))

    def test_smooth(self):
        run("smooth", BUNNY, "smooth.vsm", "--size", 0.01, "--steps", 2, "--hold",
            '{"sphere": [-0.07, 0.14, 0.01, 0.04]}')
        smooth = smg.open(BUNNY).smooth(size=0.01, steps=2, hold=HELD)
        self.assertEqual(bits(smooth.to_numpy().astype(np.float32)),
                         bits(file_result("smooth.vsm", "Position").astype(np.float32)))
        smooth.save("python.vsm")
        self.assertEqual(bits(file_result("python.vsm", "Position")),
                         bits(file_result("smooth.vsm", "Position")))

    def test_smooth_with_the_winding_mended(self):
        points, cells = sphere(3)
        wound = cells.copy()
        wound[::3] = wound[::3, ::-1]
        well, badly = smg.mesh(points, cells).smooth(size=0.5), smg.mesh(points, wound).smooth(size=0.5, orient=True)
        np.testing.assert_allclose(badly.to_numpy(), well.to_numpy(), rtol=0, atol=1e-6)
        badly.save("oriented.ply")
        for mesh in (smg.open("oriented.ply"), badly.simplify(600)):
            a, b, c = np.moveaxis(mesh.points[mesh.cells], 1, 0)
            self.assertTrue((np.einsum("ij,ij->i", np.cross(b - a, c - a), a) > 0).all())

    def test_smooth_a_column(self):
        mesh = smg.open(BUNNY)
        noise = np.random.default_rng(1).random(mesh.n_vertices)
        by_value = mesh.smooth(column=noise, size="8edges")
        mesh["Noise"] = noise
        by_name = mesh.smooth(column="Noise", size="8edges")
        self.assertEqual((by_value.name, by_name.name), ("Values", "Noise"))
        self.assertEqual(bits(by_value.to_numpy()), bits(by_name.to_numpy()))
        mesh.save("noisy.vsm")
        with self.assertWarns(smg.ReportWarning) as left_out:
            mesh.save("noisy.stl")
        self.assertIn("Noise", str(left_out.warning))
        run("smooth", "noisy.vsm", "quiet.vsm", "--column", "Noise", "--size", "8edges")
        self.assertEqual(bits(by_name.to_numpy()), bits(file_result("quiet.vsm", "Noise")))

    def test_blend(self):
        mesh = smg.open(BUNNY)
        points = mesh.points
        patch = (points[:, 0] > 0).astype(np.int32)
        light = (points * 1000 + 20 * patch[:, None]).astype(np.float32)
        blended = mesh.blend({"Light": light}, patch=patch, hold=HELD, anchor=0.1)
        self.assertEqual(blended.shape, light.shape)
        with_columns = smg.open(BUNNY)
        with_columns["Light"], with_columns["scan"] = light, patch
        with_columns.save("patches.vsm")
        run("blend", "patches.vsm", "blended.vsm", "--patch", "scan", "--columns", "Light", "--hold",
            '{"sphere": [-0.07, 0.14, 0.01, 0.04]}', "--anchor", 0.1)
        self.assertEqual(blended.to_numpy().dtype, np.float32)
        self.assertEqual(bits(blended.to_numpy()), bits(file_result("blended.vsm", "Light")))

    def test_distance(self):
        run("distance", BUNNY, "distance.vsm", "--from", '{"vertices": [21000]}', "--source",
            "--direction")
        distance = smg.open(BUNNY).distance(smg.vertices([21000]), source=True, direction=True)
        for name in ("Distance", "DistanceSource", "DistanceDirection"):
            self.assertEqual(bits(distance[name]), bits(file_result("distance.vsm", name)), name)
        run("distance", BUNNY, "distance.vsm", "--from", '{"vertices": [21000]}', "--to", '{"vertices": [5, 99]}',
            "--report", "paths.json")
        with open("paths.json", encoding="utf-8") as file:
            reported = {path["to"]: path for path in json.load(file)["distance"]["paths"]}
        paths = smg.open(BUNNY).distance(smg.vertices([21000]), to=[5, 99]).paths
        self.assertEqual({path.to for path in paths}, {5, 99})
        for path in paths:
            self.assertEqual((path.source, path.length), (21000, reported[path.to]["length"]))
            self.assertEqual(path.points.tolist(), reported[path.to]["points"])
            self.assertAlmostEqual(np.linalg.norm(np.diff(path.points, axis=0), axis=1).sum(), distance[path.to], 12)
        with self.assertRaisesRegex(smg.InputError, "only distances with `to`"):
            _ = distance.paths
        square = np.array([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0], [9, 0, 0], [9, 1, 0], [9, 0, 1]], float)
        found = smg.distance(square, [[0, 1, 2], [0, 2, 3], [4, 5, 6]], [0], to=[2, 5])
        self.assertEqual(found["Distance"][2], np.sqrt(2))
        self.assertEqual([(path.to, path.source, path.length) for path in found["paths"]], [(2, 0, np.sqrt(2)), (5, -1, np.inf)])
        self.assertEqual([path.points.shape for path in found["paths"]], [(2, 3), (0, 3)])
        self.assertEqual(repr(found["paths"]), "[<ShortestPath from 0 to 2, length 1.41421, 2 points>, "
                         "<ShortestPath from -1 to 5, length inf, 0 points>]")  # fmt: skip
        run("distance", SINK, "wall.vsm", "--wall")
        wall = smg.open(SINK).distance(wall=True)
        self.assertEqual(bits(wall.to_numpy()), bits(file_result("wall.vsm", "Distance")))

    def test_simplify(self):
        run("simplify", BUNNY, "small.ply", "--vertices", 2000)
        with smg.open(BUNNY) as mesh:
            small = mesh.simplify(2000)
            mesh.simplify(2000, path="python.ply")
        with open("python.ply", "rb") as one, open("small.ply", "rb") as two:
            self.assertEqual(one.read(), two.read())
        self.assertLessEqual(small.n_vertices, 2000)
        self.assertLessEqual(small.simplify(500).n_vertices, 500)
        self.assertEqual(small.report.vertices, small.n_vertices)
        self.assertEqual(bits(small.points), bits(smg.open(BUNNY).points[small["OriginalId"]]))
        points, cells = sphere(4)
        for vertices in (100, 2000):
            small = smg.mesh(points, cells).simplify(vertices)
            self.assertEqual(bits(small.points), bits(points[small["OriginalId"]]))
            self.assertTrue(np.isfinite(small.points).all())

    def test_simplify_holds(self):
        """A region, a mask of vertices or cells, numbers and lists: all of their vertices are in the result."""
        points, cells = sphere(5)
        high = points[:, 2] > 0.7
        last = np.arange(len(points)) >= len(points) - 5
        of_cells = high[cells].all(axis=1)
        ball = smg.mesh(points, cells)
        for hold, held in (
            (smg.above(z=0.7), high),
            (high, high),
            (np.flatnonzero(last), last),
            ([smg.above(z=0.7), smg.vertices(np.flatnonzero(last))], high | last),
            (smg.mask(of_cells), np.isin(np.arange(len(points)), cells[of_cells])),
        ):
            small = ball.simplify(len(points) // 2, hold=hold)
            kept = dict(zip(small["OriginalId"].tolist(), small.points))
            for vertex in np.flatnonzero(held).tolist():
                self.assertEqual(bits(kept[vertex]), bits(points[vertex]))
            self.assertEqual(set(small.columns["vertices"]), {"OriginalId"})
        with self.assertWarnsRegex(smg.ReportWarning, "%d are held" % high.sum()):
            self.assertGreaterEqual(ball.simplify(50, hold=high).n_vertices, high.sum())
        with self.assertWarnsRegex(smg.ReportWarning, "1 vertex belongs to no cell"):
            loose = smg.mesh(np.vstack([points, [[9, 9, 9]]]), cells)
        kept = loose.simplify(len(points) // 2, hold=np.append(high, True))["OriginalId"]
        self.assertTrue(set(np.flatnonzero(high)) <= set(kept.tolist()))
        for nothing in (np.zeros(len(points) + 1, bool), np.arange(len(points) + 1) == len(points)):
            with self.assertRaisesRegex(smg.InputError, "hold: .*selects no vertex"):
                loose.simplify(50, hold=nothing)
        few, _ = smg.simplify(points, cells, 2000, hold=last)
        self.assertTrue(set(map(tuple, points[last])) <= set(map(tuple, few)))


    def test_info(self):
        """The report of smg info; what depends on the order is that of the mesh as it was opened."""
        def rounded(text):
            return json.loads(text, parse_float=lambda number: float("%.9e" % float(number)))

        ball = os.path.abspath(write_off("ball.off", *sphere(5)))
        run("convert", ball, "ball.vsm")
        for file, options, others in (
            (BUNNY, {}, set()),  # a stream
            (os.path.abspath("ball.vsm"), {}, set()),
            (ball, {"order": "keep"}, {"expected_solve"}),
            (ball, {}, {"expected_solve", "width", "span", "mean_width", "pool_bytes_peak"}),
        ):
            with self.subTest(file=file, options=options):
                run("info", file, "--full", "--report", "info.json")
                with open("info.json", encoding="utf-8") as report:
                    said = rounded(report.read())
                found = rounded(json.dumps(smg.open(file, **options).info(full=True)))
                self.assertEqual(list(found), list(said))
                different = {key for key in said if key != "description" and found[key] != said[key]}
                different |= {key for key, value in said["description"].items()
                              if found["description"][key] != value}  # fmt: skip
                self.assertEqual(different, others)


class ArraysTest(unittest.TestCase):
    """Arrays and the file of the same mesh have the same results."""

    def setUp(self):
        self.points, self.cells = sphere(4)
        self.file = write_off("sphere.off", self.points, self.cells)

    def same(self, job, *arguments, **options):
        of_file = getattr(smg.open(self.file), job)(*arguments, **options).to_numpy()
        of_arrays = getattr(smg, job)(self.points, self.cells, *arguments, **options)
        self.assertEqual(bits(of_file), bits(of_arrays), job)
        return of_arrays

    def test_jobs(self):
        u = self.same("solve", dirichlet={0: 0.0, 99: 1.0})
        self.assertEqual(u.shape, (len(self.points),))
        self.assertEqual((u[0], u[99]), (0, 1))
        self.assertTrue(((-1e-6 < u) & (u < 1 + 1e-6)).all())
        moved = self.same("deform", [smg.handle(smg.below(z=-0.8), fixed=True),
                                     smg.handle(smg.above(z=0.8), translate=[0, 0, 1])])
        self.assertAlmostEqual(moved[:, 2].max(), 2, 6)
        self.same("smooth", size="8edges", hold=self.points[:, 2] > 0.5)
        self.same("smooth", column=self.points, size="8edges")
        self.same("blend", self.points[:, 0] + (self.points[:, 1] > 0), patch=self.points[:, 1] > 0)
        self.same("distance", [0])

    def test_conditions_by_arrays(self):
        """What masks and arrays select is what regions select."""
        z = self.points[:, 2]
        by_region = self.same("solve", dirichlet=[smg.above(z=0.5) >> 1, smg.below(z=-0.5) >> 0])
        by_mask = self.same("solve", dirichlet=[smg.mask(z >= 0.5) >> 1, smg.mask(z <= -0.5) >> 0])
        by_value = self.same("solve", dirichlet=smg.mask(np.abs(z) >= 0.5) >> (z > 0))
        by_number = self.same("solve", dirichlet={int(i): float(z[i] > 0)
                                                  for i in np.flatnonzero(np.abs(z) >= 0.5)})
        for other in (by_mask, by_value, by_number):
            self.assertEqual(bits(by_region), bits(other))

    def test_several_columns(self):
        x = self.same("solve", dirichlet=smg.mask(np.abs(self.points[:, 2]) > 0.5) >> self.points)
        self.assertEqual(x.shape, (len(self.points), 3))
        one = smg.solve(self.points, self.cells, initial=0,
                        dirichlet=smg.mask(np.abs(self.points[:, 2]) > 0.5) >> self.points[:, 0])
        np.testing.assert_allclose(x[:, 0], one, atol=1e-6)

    def test_tetrahedra(self):
        points, cells = cube(6)
        inner = smg.solve(points, cells, dirichlet=smg.boundary >> points @ [1, 2, 3], tolerance=1e-11)
        np.testing.assert_allclose(inner, points @ [1, 2, 3], atol=1e-8)
        found = smg.solve(points, cells, dirichlet=smg.plane(x=0) >> 0, flux=smg.plane(x=1) >> 1,
                          outputs="gradient", tolerance=1e-11)
        np.testing.assert_allclose(found["Solution"], points[:, 0], atol=1e-8)
        np.testing.assert_allclose(found["Gradient"], np.tile([1, 0, 0], (len(cells), 1)), atol=1e-7)
        conductivity = np.where(points[cells].mean(axis=1)[:, 0] < 0.5, 1, 4)
        u = smg.solve(points, cells, dirichlet=[smg.plane(x=0) >> 0, smg.plane(x=1) >> 5],
                      conductivity=conductivity, tolerance=1e-11)
        np.testing.assert_allclose(u[np.isclose(points[:, 0], 0.5)], 4, atol=1e-8)

    def test_vertices_of_no_cell(self):
        points = np.concatenate([[[9, 9, 9]], self.points])
        u = smg.solve(points, self.cells + 1, dirichlet={1: 0.0, 100: 1.0})
        self.assertTrue(np.isnan(u[0]))
        self.assertEqual(bits(u[1:]), bits(self.same("solve", dirichlet={0: 0.0, 99: 1.0})))
        moved = smg.smooth(points, self.cells + 1)
        self.assertEqual(moved[0].tolist(), [9, 9, 9])


class ResultTest(unittest.TestCase):
    def test_arrays_of_a_job_stay_out_of_files(self):
        points, cells = sphere(3)
        mesh = smg.mesh(points, cells)
        mesh["Height"] = points[:, 2]
        u = mesh.solve(source=points[:, 0], dirichlet=smg.mask(points[:, 2] > 0.9) >> 0)
        self.assertEqual(set(mesh.columns["vertices"]) - {"OriginalId"}, {"Height"})
        u.save("u.vtu")
        with smg.open("u.vtu") as saved:
            self.assertEqual(set(saved.columns["vertices"]) - {"OriginalId"}, {"Height", "Solution"})
            self.assertEqual(bits(saved["Solution"]), bits(u.to_numpy()))
        # Another job with other arrays leaves the first one as it was.
        before = u.report["conditions"]
        mesh.solve(source=-points[:, 0], dirichlet=smg.mask(points[:, 2] < -0.9) >> 0)
        self.assertEqual(u.report["conditions"], before)
        self.assertEqual(u.names, ("Solution",))
        self.assertEqual(set(u.columns["vertices"]) - {"OriginalId"}, {"Height", "Solution"})

    def test_not_converged(self):
        points, cells = sphere(4)
        mesh = smg.mesh(points, cells)
        problem = {"dirichlet": {0: 0, 99: 1}, "max_cycles": 1, "tolerance": 1e-12}
        with self.assertWarns(smg.NotConvergedWarning) as caught:
            u = mesh.solve(**problem)
        self.assertEqual(caught.filename, __file__)
        self.assertFalse(u.report.converged)
        with self.assertRaises(smg.NotConverged) as caught:
            mesh.solve(strict=True, **problem)
        self.assertEqual(bits(caught.exception.result.to_numpy()), bits(u.to_numpy()))
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            mesh.solve(dirichlet={0: 0, 99: 1})

    def test_sources_that_cannot_be_balanced(self):
        points, cells = sphere(4)
        for job in (lambda **o: smg.solve(points, cells, **o), smg.mesh(points, cells).solve):
            with self.assertWarnsRegex(smg.ReportWarning, "do not sum to zero") as caught:
                job(source=1.0)
            self.assertEqual(caught.filename, __file__)
            with warnings.catch_warnings():
                warnings.simplefilter("error")
                job(source=points[:, 0])

    def test_what_a_format_cannot_hold(self):
        points, cells = sphere(3)
        mesh = smg.mesh(points, cells)
        mesh["Flow"] = points * 2
        u = mesh.solve(dirichlet={0: 0.0, 99: 1.0})
        for save in (mesh.save, u.save, u.save):
            with self.assertWarnsRegex(smg.ReportWarning, "'Flow'.*'Flow_0' to 'Flow_2'") as caught:
                save("flow.ply")
            self.assertEqual(caught.filename, __file__)
            os.remove("flow.ply")
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            u.save("flow.vtu")

    def test_results_have_the_shape_of_what_was_given(self):
        points, cells = sphere(2)
        one = points[:, :1]
        mesh = smg.mesh(points, cells)
        for job in (lambda v: mesh.solve(source=v, dirichlet={0: 0.0}),
                    lambda v: mesh.solve(dirichlet=smg.mask(points[:, 2] > 0) >> v),
                    lambda v: mesh.smooth(column=v), lambda v: mesh.blend(v, patch=points[:, 2] > 0)):
            flat, matrix = job(one[:, 0]), job(one)
            self.assertEqual((flat.shape, matrix.shape), ((len(points),), (len(points), 1)))
            self.assertEqual(matrix.to_numpy().shape, matrix.shape)
            self.assertEqual(bits(flat.to_numpy()), bits(matrix.to_numpy()))
        self.assertEqual(smg.solve(points, cells, source=one, dirichlet={0: 0}).shape, one.shape)

    def test_estimates(self):
        mesh = smg.open(BUNNY)
        estimate = mesh.estimate("smooth", size="8edges")
        self.assertIn("not read yet", repr(mesh))
        run("smooth", BUNNY, "out.ply", "--size", "8edges", "--dry-run", "--report", "dry.json")
        with open("dry.json", encoding="utf-8") as file:
            said = json.load(file)
        for key in ("vertices", "memory_bytes", "memory_limit", "passes"):
            self.assertEqual(estimate[key], said[key], key)
        self.assertIn("memory", repr(estimate))
        self.assertGreater(estimate.memory_bytes, 0)
        mesh.estimate("solve", dirichlet={0: 0, 1: 1}, path="out.vtu")
        mesh.estimate("simplify", 1000)
        exact = mesh.estimate("smooth", hold=np.zeros(mesh.n_vertices, bool))
        self.assertEqual(exact.vertices, mesh.info()["vertices"])
        self.assertRaises(smg.InputError, mesh.estimate, "sing")

    def test_cache(self):
        points, cells = sphere(3)
        file = write_off("cached.off", points, cells)
        mesh = smg.open(file, cache="cache")
        self.assertFalse(os.path.exists("cache"))  # before it is used
        u = mesh.solve(dirichlet={0: 0, 9: 1})
        (name,) = os.listdir("cache")
        state = os.stat(os.path.join("cache", name)).st_mtime_ns
        again = smg.open(file, cache="cache").solve(dirichlet={0: 0, 9: 1})
        self.assertEqual(bits(u.to_numpy()), bits(again.to_numpy()))
        self.assertEqual(os.stat(os.path.join("cache", name)).st_mtime_ns, state)
        write_off("cached.off", points * 2, cells)
        smg.open(file, cache="cache").info()
        self.assertEqual(len(os.listdir("cache")), 2)
        # Of two files, either may change.
        for scale in (1, 3):
            smg.mesh(points * scale, cells).save("scaled%d.ele" % scale)
            shutil.copy("scaled%d.node" % scale, "pair.node")
            if scale == 1:
                shutil.copy("scaled1.ele", "pair.ele")
            bounds = smg.open("pair.ele", cache="two").bounds
            np.testing.assert_allclose(bounds, np.array(mesh.bounds) * scale)
            self.assertEqual(smg.open("pair.node", cache="two").bounds, bounds)
        for pack, suffix in ((gzip.open, ".gz"), (lzma.open, ".xz")):  # also if they are compressed
            for scale in (1, 3):
                with open("scaled%d.node" % scale, "rb") as plain, pack("packed.node" + suffix, "wb") as packed:
                    packed.write(plain.read())
                shutil.copy("scaled1.ele", "packed.ele")
                bounds = smg.open("packed.ele", cache="two").bounds
                np.testing.assert_allclose(bounds, np.array(mesh.bounds) * scale)
            os.remove("packed.node" + suffix)
        for scale in (1, 3):  # or a piece
            smg.mesh(points * scale, cells).save("piece.vtu")
            with open("pieces.pvtu", "w", encoding="utf-8") as index:
                index.write('<VTKFile type="PUnstructuredGrid" version="1.0"><PUnstructuredGrid>'
                            '<Piece Source="piece.vtu"/></PUnstructuredGrid></VTKFile>')  # fmt: skip
            bounds = smg.open("pieces.pvtu", cache="two").bounds
            np.testing.assert_allclose(bounds, np.array(mesh.bounds) * scale)
        with self.assertRaisesRegex(smg.Error, "cache: .*cached.off"):
            smg.open(file, cache="cached.off").info()


unittest.main(verbosity=2)
