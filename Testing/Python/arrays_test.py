# SPDX-License-Identifier: BSD-3-Clause
"""Arrays of any type and stride give the same bits, without copies; wrong ones a clear error."""

import gc
import inspect
import os
import re
import unittest
import warnings
import weakref
from array import array

from streamingmultigrid._library import readable
from testing import SOURCE, bits, cube, np, smg, sphere, write_off


class TypesTest(unittest.TestCase):
    def setUp(self):
        self.points, self.cells = sphere(3)
        self.points = np.round(self.points * 64) / 64  # exact in half precision
        self.expected = self.solve(self.points, self.cells)

    def solve(self, points, cells, values=None, held=None):
        held = self.points[:, 2] >= 0.5 if held is None else held
        values = np.round(self.points[:, 0] * 8) if values is None else values
        return smg.solve(points, cells, dirichlet=smg.mask(held) >> values, source=2)

    def test_types(self):
        types = [np.int8, np.int16, np.int32, np.int64, np.float16, np.float32, np.float64,
                 np.longdouble, ">f8", ">i4"]  # fmt: skip
        for type_ in types:
            with self.subTest(values=type_):
                values = np.round(self.points[:, 0] * 8).astype(type_)
                self.assertEqual(bits(self.solve(self.points, self.cells, values)), bits(self.expected))
        for type_ in [np.float16, np.float32, np.longdouble, ">f4"]:
            with self.subTest(points=type_):
                found = self.solve(self.points.astype(type_), self.cells)
                self.assertEqual(bits(found), bits(self.expected))
        for type_ in [np.int16, np.uint16, np.int32, np.uint32, np.int64, np.uint64, ">i8"]:
            with self.subTest(cells=type_):
                found = self.solve(self.points, self.cells.astype(type_))
                self.assertEqual(bits(found), bits(self.expected))
        for type_ in [bool, np.uint8, np.float32, np.int64]:
            with self.subTest(mask=type_):
                held = (self.points[:, 2] >= 0.5).astype(type_)
                found = self.solve(self.points, self.cells, held=held)
                self.assertEqual(bits(found), bits(self.expected))

    def test_strides(self):
        wide = np.full((len(self.points), 7), 5.0)
        wide[:, 5:2:-1] = self.points
        for points in (np.asfortranarray(self.points), wide[:, 5:2:-1], self.points.tolist()):
            self.assertEqual(bits(self.solve(points, self.cells)), bits(self.expected))
        every = np.repeat(self.cells, 2, axis=0)[::2]
        for cells in (np.asfortranarray(self.cells), every, self.cells.tolist()):
            self.assertEqual(bits(self.solve(self.points, cells)), bits(self.expected))
        values = np.round(self.points[:, 0] * 8)[::-1].copy()[::-1]
        self.assertEqual(bits(self.solve(self.points, self.cells, values)), bits(self.expected))
        values.flags.writeable = False
        self.assertEqual(bits(self.solve(self.points, self.cells, values)), bits(self.expected))

    def test_points_may_change_after_the_mesh_is_made(self):
        points, cells = self.points.copy(), self.cells.copy()
        mesh = smg.mesh(points, cells)
        points[:], cells[:] = np.nan, 0
        self.assertEqual(bits(mesh.points), bits(self.points))
        np.testing.assert_array_equal(mesh.cells, self.cells)

    def test_columns_return_as_they_were_given(self):
        for type_ in (np.int8, np.uint16, np.int64, np.float32, np.float64):
            for shape in ((), (2,)):
                mesh = smg.mesh(self.points, self.cells)
                values = np.arange(len(self.points) * (shape or (1,))[0]).astype(type_)
                values = values.reshape(-1, *shape)
                mesh["Column"] = values
                self.assertEqual(mesh["Column"].dtype, type_)
                np.testing.assert_array_equal(mesh["Column"], values)
                of_cells = np.arange(len(self.cells)).astype(type_)
                mesh.add("OfCells", of_cells, cells=True)
                np.testing.assert_array_equal(mesh["OfCells"], of_cells)


class ErrorsTest(unittest.TestCase):
    def test_meshes(self):
        points, cells = sphere(1)
        wrong = cells.copy()
        wrong[3, 1] = len(points)
        for given, words in (
            ((points[:, :1], cells), r"points: the shape is \(42, 1\)"),
            ((points, cells[:, :2]), r"cells: the shape is \(80, 2\)"),
            ((points, cells.astype(float)), "integers"),
            ((points, cells < 9), "cells: the corners are of type bool; they must be integers"),
            ((points, [[True, False, True]]), "bool"),
            ((points, wrong), "42"),
            ((points, -cells), "-"),
            ((points * 1j, cells), "complex"),
            ((points.astype(object), cells), "objects"),
            ((np.ma.masked_less(points, 0), cells), "masked"),
            ((points[:, 0], cells), r"\(42,\)"),
            (("text", cells), "only real numbers"),
            (([[0, 0, 0], [1, 0]], cells), "points"),
            ((np.where(points > 0.9, np.nan, points), cells), "finite|not a number|NaN|nan"),
        ):
            with self.subTest(words=words), self.assertRaisesRegex(smg.InputError, words) as caught:
                smg.mesh(*given)
            self.assertEqual(str(caught.exception).count("\n"), 0)
            self.assertIsInstance(caught.exception, ValueError)

    def test_sentences_name_arguments(self):
        """Options of the command line are called as arguments, whatever else a sentence says of them."""
        for sentence, said in (
            ("no triangles (option --cells).", "no triangles (argument cells)."),
            ("more (option --scratch-limit, property ScratchLimit)", "more (argument scratch_limit)"),
            ("merge (option --weld 0; in ParaView Clean; in C++ x), or (b)", "merge (argument weld=0), or (b)"),
            ("solve out of core (without --in-core)", "solve out of core (without in_core)"),
            ("a file (of --x)", "a file (of --x)"),
            ("distance: from[0].vertices: none", "distance: sources[0].vertices: none"),
            ("distance: from: none", "distance: sources: none"),
            ("deform: handles.handles[1].scale: 0", "deform: handles[1].scale: 0"),
            ('no point: add "center": [x, y, z].', "no point: give center=[x, y, z]."),
            ("region: dirichlet[0].box: must", "region: box: must"),
            ("region: dirichlet[0]: must", "region: must"),
        ):
            self.assertEqual(readable(sentence), said)
        known = {name for call in (smg.open, smg.Mesh.solve, smg.Mesh.smooth, smg.Mesh.deform, smg.Mesh.simplify)
                 for name in inspect.signature(call).parameters}  # fmt: skip
        named = set()
        for layer in ("Solver", "IO"):
            for folder, _, files in os.walk(os.path.join(SOURCE, layer)):
                for file in files:
                    if file.endswith((".cpp", ".h")):
                        with open(os.path.join(folder, file), encoding="utf-8") as text:
                            named.update(re.findall(r"\(option --([a-z-]+)", text.read()))
        self.assertIn("weld", named)
        self.assertLessEqual({name.replace("-", "_") for name in named}, known)

    def test_jobs(self):
        points, cells = sphere(2)
        mesh = smg.mesh(points, cells)
        mask = points[:, 2] > 0
        with open("wrong.json", "w", encoding="utf-8") as file:
            file.write("{")
        for call, error, words in (
            (lambda: mesh.solve(source=np.ones(7)), smg.InputError, "162 vertices or 320 cells"),
            (lambda: mesh.solve(dirichlet=smg.tag("part", 1) >> 0), smg.Error, "part"),
            (lambda: mesh.solve(dirichlet=smg.sphere((9, 9, 9), 1) >> 0), smg.Error, "no vertex"),
            (lambda: mesh.solve(dirichlet=smg.boundary >> 0), smg.Error, "boundary"),
            (lambda: mesh.solve(dirichlet={999: 1.0}), smg.Error, "999"),
            (lambda: mesh.solve(), smg.Error, "."),
            (lambda: mesh.solve(dirichlet={0: np.nan}), smg.Error, "."),
            (lambda: mesh.solve(dirichlet={0: 1.0}, memory="1KB"), smg.InputError, "1KB"),
            (lambda: mesh.smooth(size=1e200), smg.Error, r"details to smooth \(argument size\)"),
            (lambda: mesh.distance(), smg.InputError, "sources"),
            (lambda: mesh.distance([999]), smg.Error, r"sources\[0\].vertices"),
            (lambda: mesh.distance([0], within=np.nan), smg.InputError, "within is nan"),
            (lambda: mesh.distance(wall=True), smg.Error, "walls .* tetrahedral"),
            (lambda: mesh.distance([0], to=[1], accuracy="approximate"), smg.Error, "exact distances on a surface"),
            (lambda: mesh.deform([smg.handle(smg.everywhere, scale=2)]), smg.InputError, "center="),
            (lambda: mesh.deform([smg.handle(smg.above(z=0), rotate=((0, 0, 1), 5))]), smg.InputError, "center="),
            (lambda: smg.handle(smg.above(z=0), rotate=5), smg.InputError, "rotate: 5"),
            (lambda: mesh.deform([smg.handle(smg.above(z=0), translate=(0, 1))]), smg.InputError, r"handles\[0\]"),
            (lambda: mesh.select(smg.box((1, 1, 1), (0, 0, 0))), smg.InputError, "^region: box: must be"),
            (lambda: smg.mesh(points, cells.astype(float)), smg.InputError, "integers"),
            (lambda: mesh.blend("Light", patch="scan"), smg.Error, "scan|Light"),
            (lambda: mesh["Light"], smg.InputError, "Light"),
            (lambda: mesh.add("a\0b", np.ones(162)), smg.InputError, "character 0"),
            (lambda: mesh.add(7, np.ones(162)), smg.InputError, "text"),
            (lambda: mesh.add("", np.ones(162)), smg.InputError, "text"),
            (lambda: mesh.solve(source="a\0b"), smg.InputError, "character 0"),
            (lambda: mesh.save("a.vsm\0b"), smg.InputError, "character 0"),
            (lambda: smg.open("a.vsm\0b"), smg.InputError, "character 0"),
            (lambda: mesh.smooth(column="Light"), smg.Error, "Light"),
            (lambda: mesh.deform(None), smg.InputError, "handles: None"),
            (lambda: mesh.deform("nowhere.json"), smg.Error, "nowhere.json: cannot be opened: No such"),
            (lambda: mesh.solve(problem="nowhere.json"), smg.Error, "nowhere.json: cannot be opened"),
            (lambda: mesh.solve(problem="wrong.json"), smg.Error, "wrong.json: this is not valid JSON"),
            (lambda: mesh.distance([1.5]), smg.InputError, "integers"),
            (lambda: smg.above(z=0) & smg.below(z=1) >> 1, smg.InputError, r"in parentheses: \(a & b\) >> value"),
            (lambda: mask & smg.below(z=1) >> 1, smg.InputError, "in parentheses"),
            (lambda: mask | smg.below(z=1) >> 1, smg.InputError, "in parentheses"),
            (lambda: smg.above(z=0) >> 1 | smg.below(z=1) >> 1, smg.InputError, "are a list"),
            (lambda: smg.above(z=0) >> 1 >> 2, smg.InputError, "has a value"),
            (lambda: mesh.distance(smg.above(z=0) >> 1), smg.InputError, "has a value"),
            (lambda: mesh.solver(screening=1).solve(np.ones((162, 2))[:, :0]), smg.InputError,
             r"b: the shape is \(162, 0\): there is no right-hand side"),
            (lambda: mesh.add("none", np.ones((162, 0))), smg.InputError, "must have one or more columns"),
            (lambda: mesh.distance(smg.boundary & smg.above(z=0)), smg.Error, "boundary"),
            (lambda: mesh.distance(smg.above(z=0.9) & smg.below(z=-0.9)), smg.InputError, "nothing"),
            (lambda: mesh.distance(~smg.everywhere), smg.InputError, "nothing"),
            (lambda: mesh.simplify(50, scratch="nowhere"), smg.Error, "nowhere.*: No such"),
            (lambda: mesh.save("x.unknown"), smg.Error, "unknown"),
            (lambda: mesh.simplify(), smg.InputError, "vertices"),
            (lambda: smg.open("nowhere.ply"), FileNotFoundError, "nowhere.ply"),
        ):
            with self.subTest(words=words), self.assertRaisesRegex(error, words) as caught:
                call()
            # None of the words of the files and of the command line.
            self.assertNotRegex(str(caught.exception), r'\bfrom\[|handles\.handles|dirichlet\[0\]\.box|"[a-z]+":|--[a-z]')
        moved = mesh.deform([smg.handle(smg.everywhere, translate=(0, 0, 1))]).to_numpy()
        np.testing.assert_allclose(moved, points + [0, 0, 1], atol=1e-12)
        for call in (mesh.solve, mesh.solver, lambda **o: mesh.estimate("solve", **o),
                     lambda **o: mesh.save("a.vsm", **o), lambda **o: mesh.distance([0]).save("a.vsm", **o),
                     lambda **o: smg.solve(points, cells, **o), lambda **o: smg.mesh(points, cells, **o),
                     lambda **o: mesh.simplify(50, **o)):  # fmt: skip
            self.assertRaisesRegex(TypeError, "'dirichlets'", call, dirichlets={0: 1.0})
        # NaN where nothing is read from an array is no fault.
        held = points[:, 2] > 0.5
        values = np.where(held, 1.0, np.nan)
        np.testing.assert_allclose(mesh.solve(dirichlet=smg.mask(held) >> values), 1)
        with self.assertRaisesRegex(smg.Error, "NaN|nan|finite|not a number"):
            mesh.solve(dirichlet=smg.mask(points[:, 2] > 0.4) >> values)

    def test_memory(self):
        mesh = smg.mesh(*sphere(6))
        with self.assertRaisesRegex(smg.MemoryLimitError, "limit.*MiB") as caught:
            mesh.solve(dirichlet={0: 1.0, 1: 2.0}, memory="1MiB")
        self.assertIsInstance(caught.exception, MemoryError)

    def test_a_column_of_cells_for_vertices(self):
        points, cells = cube(2)
        with self.assertRaisesRegex(smg.InputError, "27 vertices"):
            smg.solve(points, cells, initial=np.ones(48), source=1)

    def test_closed(self):
        mesh = smg.mesh(*sphere(2))
        u = mesh.solve(dirichlet={0: 0.0, 1: 1.0})
        values = u.to_numpy()
        mesh.close()
        mesh.close()
        with self.assertRaisesRegex(smg.Error, "closed"):
            mesh.info(full=True)
        u.save("closed.vsm")  # a field has what it needs of its mesh
        self.assertEqual(bits(u.to_numpy()), bits(values))
        self.assertEqual(sum(block.n_cells for block in u.blocks()), len(u.read("Corners", cells=True)))
        self.assertTrue(u.report.converged)
        with smg.open("closed.vsm") as saved:
            self.assertEqual(bits(saved["Solution"]), bits(values))


class NamesTest(unittest.TestCase):
    def test_a_number_sign_is_a_character_as_any_other(self):
        """Arguments of jobs are told from columns by what they are, not by their names."""
        points, cells = sphere(3)
        mesh = smg.mesh(points, cells)
        mesh["#source"], mesh["#"] = points[:, 0], np.arange(len(cells))
        u = mesh.solve(source=points[:, 1], dirichlet={0: 0.0})
        expected = smg.solve(points, cells, source=points[:, 1], dirichlet={0: 0.0})
        self.assertEqual(bits(u.to_numpy()), bits(expected))
        self.assertEqual(bits(mesh.solve(source="#source", dirichlet={0: 0.0}).to_numpy()),
                         bits(smg.solve(points, cells, source=points[:, 0], dirichlet={0: 0.0})))
        for source in (mesh, u):
            source.save("names.vsm")
            with smg.open("names.vsm") as saved:
                self.assertEqual(bits(saved["#source"]), bits(points[:, 0]))
                np.testing.assert_array_equal(saved["#"], np.arange(len(cells)))
                names = {*saved.columns["vertices"], *saved.columns["cells"]}
                self.assertEqual(names - {"Solution"}, {"#source", "#", "OriginalId", "OriginalCellId"})
                self.assertEqual(set(saved.columns["vertices"]), set(source.columns["vertices"]))
        self.assertIn("#source", [column["name"] for column in mesh.info()["columns"]["vertices"]])
        self.assertIn("#source", mesh.simplify(100).columns["vertices"])


class ColumnsTest(unittest.TestCase):
    def test_columns_are_copied_unless_told(self):
        points, cells = sphere(2)
        for copy in (True, False):
            for values in (points[:, 0].copy(), points[:, 0] > 0, points.astype(np.float32)[::-1]):
                mesh = smg.mesh(points, cells)
                mesh.add("Values", values, copy=copy)
                before = mesh["Values"].copy()
                values[:] = 0
                self.assertEqual(np.array_equal(mesh["Values"], before), copy)

        class Lender:  # as the arrays of other libraries
            def __init__(self, array):
                self.array = array

            def __array__(self, *_, **__):
                return self.array

        for lent in (array("d", points[:, 0]), Lender(points[:, 0].copy()), memoryview(points[:, 0].copy())):
            mesh = smg.mesh(points, cells)
            mesh["Values"] = lent
            np.asarray(lent)[:] = 0
            self.assertEqual(bits(mesh["Values"]), bits(points[:, 0]))
        mesh = smg.mesh(points, cells)
        values = points[:, 0].copy()
        mesh["Values"] = values
        values *= 7
        self.assertEqual(bits(mesh["Values"]), bits(points[:, 0]))

    def test_names(self):
        points, cells = sphere(2)
        mesh = smg.mesh(points, cells)
        mesh["Point"], mesh["Cell"] = points, np.ones(len(cells))
        u = mesh.solve(dirichlet={0: 0.0, 9: 1.0}, outputs="flux")
        for each, names in ((mesh, ["Point", "Cell"]), (u, ["Point", "Cell", "Solution", "Flux"])):
            self.assertLessEqual(set(names), set(each.keys()))
            for name in each.keys():
                self.assertIn(name, each)
                self.assertEqual(len(each[name]), len(each.read(name)))
            self.assertNotIn("Other", each)
            self.assertEqual((each.n_points, each.n_cells), (len(points), len(cells)))
            self.assertEqual(each.n_vertices, len(points))

    def test_a_field_is_used_as_an_array(self):
        points, cells = sphere(2)
        mesh = smg.mesh(points, cells)
        u, v = mesh.solve(dirichlet={0: 0.0, 9: 1.0}), mesh.distance([0])
        a, b = u.to_numpy(), v.to_numpy()
        for found, expected in (
            (u + 1, a + 1), (1 - u, 1 - a), (u * v, a * b), (-u, -a), (abs(u), abs(a)),
            (u > 0.5, a > 0.5), (np.sqrt(v), np.sqrt(b)), (a + v, a + b), (u == u, a == a),
            (np.add.reduce(u), a.sum()), (np.maximum(u, v), np.maximum(a, b)),
        ):  # fmt: skip
            self.assertEqual(bits(found), bits(expected))
        self.assertEqual((u.dtype, u.ndim, u.size, len(u)), (a.dtype, 1, a.size, len(a)))
        self.assertEqual(len({u, v, u}), 2)
        with self.assertRaises(smg.InputError):
            np.add(a, 1, out=u)
        # As a value, a mask, and a column of a job.
        self.assertEqual(bits(mesh.solve(source=v, dirichlet={0: 0})), bits(mesh.solve(source=b, dirichlet={0: 0})))
        self.assertEqual(bits(mesh.smooth(hold=u > 0.5)), bits(mesh.smooth(hold=a > 0.5)))
        self.assertEqual(bits(mesh.smooth(column=u)), bits(mesh.smooth(column=a)))

    def test_import_all_keeps_the_builtins(self):
        names = {}
        exec("from streamingmultigrid import *", names)
        own = {name for name in names if name not in ("__builtins__", "__name__")}
        self.assertEqual(own & set(dir(names["__builtins__"] if isinstance(names["__builtins__"], type(os))
                                       else os.sys.modules["builtins"])), set())  # fmt: skip
        self.assertIn("solve", own)

    def test_plane_points(self):
        points, cells = sphere(2)
        flat = points * [1, 1, 0]
        for dtype in (float, np.float32, int):
            given = (points[:, :2] * 100).astype(dtype)
            self.assertEqual(
                bits(smg.mesh(given, cells).points),
                bits(np.concatenate([given, np.zeros((len(given), 1), dtype)], axis=1).astype(float)),
            )
        self.assertEqual(bits(smg.distance(points[:, :2], cells, [0])), bits(smg.distance(flat, cells, [0])))


def moebius(n=40):
    """A band that is twisted once."""
    turn = 2 * np.pi * np.arange(n) / n
    sides = [np.column_stack([(1 + s * np.cos(turn / 2)) * np.cos(turn), (1 + s * np.cos(turn / 2)) * np.sin(turn),
                              s * np.sin(turn / 2)]) for s in (-0.3, 0.3)]
    one, other = np.arange(n), np.arange(n) + n
    next_one, next_other = np.append(one[1:], n), np.append(other[1:], 0)
    return np.concatenate(sides), np.concatenate(
        [np.column_stack([one, next_one, other]), np.column_stack([other, next_one, next_other])])


class WarningsTest(unittest.TestCase):
    """What the report warns of is a warning of Python, of methods and of functions on arrays."""

    def test_warnings(self):
        points, cells = sphere(3)
        ball, facets = sphere(1)
        many = np.concatenate([ball + [3 * i, 0, 0] for i in range(100)])
        bodies = np.concatenate([facets + len(ball) * i for i in range(100)])
        for arrays, job, arguments, words in (
            (moebius(), "smooth", {}, "cannot be wound"),
            ((many, bodies), "simplify", {"vertices": 100}, "left out"),
            ((points, cells), "solve", {"source": 1.0}, "do not sum to zero"),
        ):
            for call in (getattr(smg.mesh(*arrays), job), lambda **o: getattr(smg, job)(*arrays, **o)):
                with self.subTest(job=job), warnings.catch_warnings(record=True) as caught:
                    warnings.simplefilter("always")
                    found = call(**arguments)
                    _ = getattr(found, "report", None)
                    self.assertRegex("".join(str(w.message) for w in caught), words)
                    self.assertEqual(len(caught), len({str(w.message) for w in caught}))
                    for each in caught:
                        self.assertTrue(issubclass(each.category, smg.ReportWarning))


class LifetimesTest(unittest.TestCase):
    def test_blocks_keep_the_arrays_that_they_read(self):
        mesh = smg.mesh(*sphere(3))
        heat = np.arange(mesh.n_vertices, dtype=float)
        mesh.add("heat", heat, copy=False)
        expected, gone = heat.copy(), weakref.ref(heat)
        del heat
        blocks = mesh.blocks(max_points=100)
        first = next(blocks)
        found = {int(i): v for i, v in zip(first.rows, first["heat"])}
        mesh["heat"] = np.zeros(mesh.n_vertices)
        mesh.close()
        self.assertIsNotNone(gone())
        for block in blocks:
            found.update(zip(block.rows.tolist(), block["heat"].tolist()))
        np.testing.assert_array_equal([found[i] for i in range(len(expected))], expected)
        del blocks, first, block
        gc.collect()
        self.assertIsNone(gone())

    def test_a_simplified_mesh_lives_as_long_as_its_blocks(self):
        blocks = smg.mesh(*sphere(3)).simplify(100).blocks(max_points=30)
        self.assertGreater(sum(block.n_cells for block in blocks), 100)

    def test_the_file_of_a_mesh_is_not_overwritten(self):
        name = write_off("kept.off", *sphere(2))
        with open(name, "rb") as file:
            before = file.read()
        mesh = smg.open(name, cache="cache")
        for call in (
            lambda: mesh.save(name),
            lambda: mesh.smooth().save(name),
            lambda: mesh.simplify(50, path=name),
            lambda: mesh.simplify(50).save(name),
            lambda: mesh.smooth().simplify(50).smooth().save(name),
        ):
            with self.assertRaisesRegex(smg.InputError, "kept.off"):
                call()
        with open(name, "rb") as file:
            self.assertEqual(file.read(), before)


class ElementsTest(unittest.TestCase):
    """Of cells that are read in parts, an array has a row for each part, or for each cell."""

    def files(self):
        """Hexahedra, also with named faces, and quadrilaterals: (name, number of elements)."""
        n = 3
        grid = np.stack(np.meshgrid(*[np.arange(n + 1.0)] * 3, indexing="ij"), -1).reshape(-1, 3)
        number = np.arange(len(grid)).reshape((n + 1,) * 3)
        corners = [(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0), (0, 0, 1), (1, 0, 1), (1, 1, 1), (0, 1, 1)]
        hexahedra = np.stack([number[i:n + i, j:n + j, k:n + k].ravel() for i, j, k in corners], 1)
        for name, cells, kind in (("hexahedra.vtk", hexahedra, 12), ("quads.vtk", hexahedra[:9, :4], 9)):
            with open(name, "w", encoding="utf-8") as file:
                file.write("# vtk DataFile Version 3.0\n\nASCII\nDATASET UNSTRUCTURED_GRID\n")
                file.write("POINTS %d double\n" % len(grid))
                np.savetxt(file, grid)
                file.write("CELLS %d %d\n" % (len(cells), cells.size + len(cells)))
                np.savetxt(file, np.insert(cells, 0, cells.shape[1], axis=1), fmt="%d")
                file.write("CELL_TYPES %d\n" % len(cells) + "%d\n" % kind * len(cells))
            yield name, len(cells)
        # As Gmsh writes them: the faces come before the cells.
        faces = number[0][tuple(np.meshgrid(range(n), range(n), indexing="ij"))].ravel()
        quads = np.stack([faces, faces + n + 1, faces + n + 2, faces + 1], 1)
        with open("named.msh", "w", encoding="utf-8") as file:
            file.write("$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n2\n2 1 \"low\"\n3 2 \"body\"\n")
            file.write("$EndPhysicalNames\n$Nodes\n%d\n" % len(grid))
            np.savetxt(file, np.insert(grid, 0, np.arange(len(grid)) + 1, axis=1), fmt="%g")
            file.write("$EndNodes\n$Elements\n%d\n" % (len(quads) + len(hexahedra)))
            elements = [(3, 1, *corners) for corners in quads + 1] + [(5, 2, *corners) for corners in hexahedra + 1]
            for tag, (kind, group, *corners) in enumerate(elements, 1):
                file.write(" ".join(map(str, (tag, kind, 2, group, 1, *corners))) + "\n")
            file.write("$EndElements\n")
        yield "named.msh", len(hexahedra)

    def test_arrays_by_element(self):
        for name, count in self.files():
            with self.subTest(name):
                mesh = smg.open(name)
                self.assertGreater(mesh.n_cells, count)
                self.assertEqual(mesh.n_elements, count)
                np.testing.assert_array_equal(np.unique(mesh.elements), np.arange(count))
                values = np.linspace(1, 2, count)
                parts = values[mesh.elements]
                held = smg.below(x=0) >> 0.0
                for argument in ("conductivity", "source", "screening"):
                    given = {"source": 1.0, argument: values, "dirichlet": held}
                    one = mesh.solve(**given).to_numpy()
                    two = mesh.solve(**{**given, argument: parts}).to_numpy()
                    self.assertEqual(bits(one), bits(two), argument)
                mesh["k"] = values
                self.assertEqual(bits(mesh["k"]), bits(parts))
                one, two = (
                    mesh.solve(source=1.0, dirichlet=smg.mask(mask) >> 0).to_numpy()
                    for mask in (values > 1.5, parts > 1.5)
                )
                self.assertEqual(bits(one), bits(two))
                with self.assertRaisesRegex(smg.InputError, "row for each of the .* %d elements" % count):
                    mesh["k"] = values[1:]

    def test_a_tensor_or_a_row_for_each_element(self):
        with open("one.vtk", "w", encoding="utf-8") as file:
            file.write("# vtk DataFile Version 3.0\n\nASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS 16 float\n")
            for z in range(4):
                file.write("0 0 {0} 1 0 {0} 1 1 {0} 0 1 {0}\n".format(z))
            file.write("CELLS 3 27\n")
            for k in (0, 4, 8):
                file.write("8 %d %d %d %d %d %d %d %d\n" % tuple(range(k, k + 8)))
            file.write("CELL_TYPES 3\n12\n12\n12\n")
        mesh = smg.open("one.vtk")
        self.assertEqual(len(np.unique(mesh.elements)), 3)
        with self.assertRaisesRegex(smg.InputError, "may be a tensor or a row for each"):
            mesh.solve(conductivity=np.array([1.0, 2.0, 3.0]), dirichlet=smg.below(z=0) >> 0)

    def test_means_by_element(self):
        name, count = next(self.files())
        mesh = smg.open(name)
        u = mesh.solve(dirichlet=[smg.below(x=0) >> 0, smg.above(x=3) >> 3], outputs="gradient")
        gradient = u.read("Gradient", cells=True)[:, 0]
        means = np.bincount(mesh.elements, gradient) / np.bincount(mesh.elements)
        np.testing.assert_allclose(means, np.ones(count), rtol=1e-6)


class GroupsTest(unittest.TestCase):
    """What a solve reports of groups of cells, against numpy."""

    def mesh(self):
        """A plate of 8 x 6 x 2 triangles, whose right half is in a group; (mesh, whether a triangle is in it)."""
        x, y = (each.ravel() for each in np.meshgrid(np.arange(9.0), np.arange(7.0), indexing="ij"))
        corner = (np.arange(8)[:, None] * 7 + np.arange(6)).ravel()
        triangles = np.concatenate([corner[:, None] + [0, 7, 8], corner[:, None] + [0, 8, 1]])
        is_right = x[triangles].min(axis=1) >= 4
        with open("plate.msh", "w", encoding="utf-8") as file:
            file.write("$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n1\n2 5 \"right\"\n$EndPhysicalNames\n")
            file.write("$Nodes\n%d\n" % len(x))
            file.writelines("%d %r %r 0\n" % (v + 1, *p) for v, p in enumerate(zip(x.tolist(), y.tolist())))
            file.write("$EndNodes\n$Elements\n%d\n" % len(triangles))
            for k, (t, label) in enumerate(zip((triangles + 1).tolist(), is_right.tolist())):
                file.write("%d 2 2 %d 1 %d %d %d\n" % (k + 1, 5 if label else 0, *t))
            file.write("$EndElements\n")
        return smg.open("plate.msh"), triangles, is_right

    def test_integrals(self):
        mesh, triangles, is_right = self.mesh()
        points = mesh.points
        u = mesh.solve(
            dirichlet=[smg.below(x=0) >> 0, smg.above(x=8) >> 1],
            source=points[:, 1],
            conductivity=[1, smg.group("right") >> 3],
            outputs=["flux", "gradient at vertices"],
            integrals=["right", "*"],
        )
        a, b = (points[triangles[:, k]] - points[triangles[:, 0]] for k in (1, 2))
        area = np.linalg.norm(np.cross(a, b), axis=1) / 2
        values, flux = u.to_numpy(), u.read("Flux", cells=True)
        gradient = -flux / np.where(is_right, 3.0, 1.0)[:, None]
        found = u.report.integrals
        self.assertEqual([part["name"] for part in found], ["all", "right"])
        for part, chosen in zip(found, (area, area * is_right)):
            np.testing.assert_allclose(part["measure"], chosen.sum(), rtol=1e-13)
            integral = (chosen * values[triangles].mean(axis=1)).sum()
            np.testing.assert_allclose(part["integral"][0], integral, rtol=1e-12)
            np.testing.assert_allclose(part["mean"][0], integral / chosen.sum(), rtol=1e-12)
            np.testing.assert_allclose(part["gradient"], chosen @ gradient, atol=1e-11)
            np.testing.assert_allclose(part["flux"], chosen @ flux, atol=1e-11)
        sums, shares = np.zeros((len(points), 3)), np.zeros(len(points))
        np.add.at(sums, triangles, (area[:, None] * gradient)[:, None, :])
        np.add.at(shares, triangles, area[:, None])
        np.testing.assert_allclose(u.read("Gradient"), sums / shares[:, None], atol=1e-12)
        self.assertIn("right: measure 24", str(u.report))
        with self.assertRaisesRegex(smg.Error, "integrals.*no group 'left'"):
            mesh.solve(dirichlet={0: 0.0}, integrals="left")


class SidesTest(unittest.TestCase):
    """Of as many vertices as cells, or cells of the file, an array has to say which its rows are."""

    def meshes(self):
        """(what there are as many of, mesh): triangles; quadrilaterals, of which a torus has as many."""
        octahedron = np.concatenate([np.eye(3), -np.eye(3)])
        points = np.concatenate([octahedron, octahedron[:3] + 4])
        triangles = [(0, 1, 2), (1, 3, 2), (3, 4, 2), (4, 0, 2), (1, 0, 5), (3, 1, 5), (4, 3, 5), (0, 4, 5), (6, 7, 8)]
        yield "cells", smg.mesh(points, np.array(triangles))
        n = 8
        i, j = (each.ravel() for each in np.meshgrid(np.arange(n), np.arange(n), indexing="ij"))
        u, v = 2 * np.pi * i / n, 2 * np.pi * j / n
        with open("torus.off", "w", encoding="utf-8") as file:
            file.write("OFF\n%d %d 0\n" % (n * n, n * n))
            np.savetxt(file, np.stack([(3 + np.cos(v)) * np.cos(u), (3 + np.cos(v)) * np.sin(u), np.sin(v)], 1))
            number = lambda a, b: a % n * n + b % n  # noqa: E731
            corners = [number(i, j), number(i + 1, j), number(i + 1, j + 1), number(i, j + 1)]
            np.savetxt(file, np.stack([np.full(n * n, 4), *corners], 1), fmt="%d")
        yield "elements", smg.open("torus.off")

    def test_what_is_of_either(self):
        for noun, mesh in self.meshes():
            values = np.linspace(1, 2, mesh.n_vertices)
            x = mesh.points[:, 0].copy()
            mesh.add("OfVertices", values, cells=False)
            mesh.add("OfCells", smg.of_cells(values))
            mesh.add("MaskOfVertices", smg.of_vertices(values > 1.5))
            mesh.add("MaskOfCells", values > 1.5, cells=True)
            for name, given, job in (
                ("source", values, lambda v: mesh.solve(source=v, screening=1.0)),
                ("source", values, lambda v: mesh.solve(source=[1.0, smg.everywhere >> v], screening=1.0)),
                ("screening", values, lambda v: mesh.solve(source=1.0, screening=v)),
                ("patch", values > 1.5, lambda v: mesh.blend({"X": x}, patch=v)),
                ("mask", values > 1.5, lambda v: mesh.solve(source=1.0, dirichlet=smg.mask(v) >> 0.0)),
                ("mask", values > 1.5, lambda v: mesh.smooth(hold=v)),
                ("mask", values > 1.5, lambda v: mesh.distance(v)),
                ("mask", values > 1.5, lambda v: mesh.distance(smg.mask(v) & smg.everywhere)),
            ):
                with self.subTest(noun, name=name):
                    words = "^%s: the mesh has %d vertices and as many %s: say" % (name, len(values), noun)
                    with self.assertRaisesRegex(smg.InputError, words):
                        job(given)
                    prefix = "Mask" if given.dtype == bool else ""
                    found = {}
                    for said, column in ((smg.of_vertices, "OfVertices"), (smg.of_cells, "OfCells")):
                        found[column] = bits(job(said(given)).to_numpy())
                        self.assertEqual(found[column], bits(job(prefix + column).to_numpy()), column)
                    self.assertNotEqual(*found.values())
            with self.assertRaisesRegex(smg.InputError, "say of which"):
                mesh["New"] = values
            self.assertEqual(bits(mesh["OfVertices"]), bits(values))
            self.assertEqual(bits(mesh["OfCells"]), bits(values[mesh.elements]))

    def test_what_is_of_one_side_alone(self):
        for _, mesh in self.meshes():
            values = np.linspace(1, 2, mesh.n_vertices)
            vectors = np.stack([values] * 3, 1)
            fixed = {0: 0.0}
            mesh.add("P", smg.of_vertices(values > 1.5))
            for side, job in (
                (False, lambda v: mesh.solve(dirichlet=smg.everywhere >> v)),
                (False, lambda v: mesh.solve(soft=smg.everywhere >> (v, 1.0))),
                (False, lambda v: mesh.solve(initial=v, source=1.0, screening=1.0)),
                (False, lambda v: mesh.smooth(column={"V": v})),
                (False, lambda v: mesh.blend({"V": v}, patch="P")),
                (True, lambda v: mesh.solve(dirichlet=fixed, source=1.0, screening=1.0, conductivity=v)),
                (None, lambda v: mesh.solve(screening=1.0, field=v)),
            ):
                given, side = (vectors, True) if side is None else (values, side)
                right, wrong = (smg.of_cells, smg.of_vertices) if side else (smg.of_vertices, smg.of_cells)
                self.assertEqual(bits(job(given).to_numpy()), bits(job(right(given)).to_numpy()))
                nouns = ("vertices", "cells") if side else ("cells", "vertices")
                with self.assertRaisesRegex(smg.InputError, "said to be of the %s; one of the %s is needed" % nouns):
                    job(wrong(given))

    def test_results_are_of_the_vertices(self):
        for _, mesh in self.meshes():
            field = mesh.solve(source=1.0, screening=1.0)
            one, two = (
                mesh.solve(source=source, screening=1.0).to_numpy()
                for source in (field, smg.of_vertices(field))
            )
            self.assertEqual(bits(one), bits(two))

    def test_what_is_made_of_an_array_says_nothing(self):
        said = smg.of_cells(np.arange(9.0))
        self.assertEqual(bits(np.asarray(said)), bits(np.arange(9.0)))
        noun, mesh = next(iter(self.meshes()))
        with self.assertRaisesRegex(smg.InputError, "as many cells"):
            mesh.solve(source=said + 1, screening=1.0)
        with self.assertRaisesRegex(smg.InputError, "masked"):
            smg.of_cells(np.ma.masked_less(np.arange(9.0), 3))


unittest.main(verbosity=2)
