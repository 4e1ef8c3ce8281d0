# SPDX-License-Identifier: BSD-3-Clause
"""Every job with every option, by every way out: a table of jobs, and what holds of each of them."""

import json
import os
import typing
import unittest
import warnings

from testing import bits, cube, np, smg, sphere, write_off

from streamingmultigrid import _report

MESHES = {"surface": sphere(2), "solid": cube(3)}

#: Where each kind of result can be written: the formats of meshes, by kind, and those with columns.
COLUMNS = ("vsm", "vtk", "vtu", "vtkhdf")
SUFFIXES = {
    "surface": (*COLUMNS, "ply", "vtp", "obj", "off", "stl", "mesh", "msh", "node", "e", "sma", "smb"),
    "solid": (*COLUMNS, "mesh", "msh", "node", "e", "sva", "svb"),
}
HOLD_COLUMNS = {"surface": (*COLUMNS, "ply", "vtp", "msh", "e"), "solid": (*COLUMNS, "msh", "e")}
#: Formats whose numbers are rounded, that keep no order of vertices, or that have columns by components.
LOSSY = {"stl", "sma", "smb", "sva", "svb", "obj", "off", "mesh", "msh", "node", "e"}


def table(kind, mesh):
    """The jobs: name, function, columns of the result, the others of which are of cells."""
    points = mesh.points
    part = (points[:, 0] > 0.3).astype(np.int32)
    two = smg.vertices([0, 9]) >> np.array([[0.0, 1.0], [1.0, 3.0]])
    fixed = {"dirichlet": {0: 0.0, 9: 1.0}}
    motion = [smg.handle([0], fixed=True), smg.handle([9], translate=[0, 0, 0.1])]
    yield "solve", lambda: mesh.solve(**fixed), ["Solution"]
    yield "solve two", lambda: mesh.solve(dirichlet=two), ["Solution"]
    yield "solve, source", lambda: mesh.solve(source=points[:, 0], **fixed), ["Solution"]
    for outputs in (["gradient"], ["flux"], ["gradient", "flux"]):
        names = ["Solution", *map(str.capitalize, outputs)]
        yield "solve, %s" % outputs, lambda o=outputs: mesh.solve(outputs=o, **fixed), names
        yield "two, %s" % outputs, lambda o=outputs: mesh.solve(outputs=o, dirichlet=two), names
    yield "deform", lambda: mesh.deform(motion), ["Position"]
    if kind == "surface":
        for options in ({}, {"keep_volume": False}, {"steps": 2}, {"hold": points[:, 0] > 0.5}):
            yield "smooth %s" % list(options), lambda o=options: mesh.smooth(**o), ["Position"]
    one, three = points[:, 1].copy(), points.astype(np.float32)
    yield "smooth one", lambda: mesh.smooth(column={"One": one}), ["One"]
    yield "smooth three", lambda: mesh.smooth(column={"Three": three}), ["Three"]
    for columns in ({"One": one}, {"Three": three}, {"One": one, "Three": three}, {"Three": three, "One": one}):
        for seam in ("zero", "average"):
            yield (
                "blend %s, %s" % (list(columns), seam),
                lambda c=columns, s=seam: mesh.blend(c, patch=part, seam=s),
                list(columns),
            )
    for wall in (False, True) if kind == "solid" else (False,):
        for source in (False, True):
            for direction in (False, True):
                options = {"source": source, "group": source != direction, "direction": direction, "wall": wall}
                names = ["Distance"] + ["DistanceSource"] * source + ["DistanceGroup"] * (source != direction)
                names += ["DistanceDirection"] * direction
                sources = [] if wall else [[0]]
                yield "distance %s" % options, lambda s=sources, o=options: mesh.distance(*s, **o), names


class TableTest(unittest.TestCase):
    def setUp(self):
        warnings.simplefilter("ignore", smg.ReportWarning)  # of columns that a format cannot hold

    def each(self):
        for kind, arrays in MESHES.items():
            mesh = smg.mesh(*arrays)
            for name, job, names in table(kind, mesh):
                yield self.subTest(mesh=kind, job=name), kind, mesh, job(), names

    def test_a_memory_limit_that_is_too_low_is_of_one_kind(self):
        """Of every job, of what is opened, and of the default of a mesh."""
        for kind, arrays in (("surface", sphere(6)), ("solid", cube(32))):
            mesh = smg.mesh(*arrays)
            jobs = {name: getattr(mesh, name) for name in ("solve", "deform", "smooth", "blend", "distance", "simplify")}
            x = mesh.points[:, 0]
            arguments = {
                "solve": {"dirichlet": {0: 0.0, 9: 1.0}},
                "deform": {"handles": [smg.handle([0], fixed=True), smg.handle([9], translate=[0, 0, 0.1])]},
                "smooth": {"column": {"X": x}},
                "blend": {"columns": {"X": x}, "patch": (x > 0.3).astype(np.int32)},
                "distance": {"sources": [0]},
                "simplify": {"vertices": 100},
            }
            for name, job in jobs.items():
                with self.subTest(mesh=kind, job=name):
                    self.assertRaises(smg.MemoryLimitError, job, **arguments[name], memory="1MiB")
            if kind == "solid":
                with self.subTest(job="wall distance"):
                    self.assertRaises(smg.MemoryLimitError, mesh.distance, wall=True, memory="1MiB")
        smg.mesh(*sphere(2)).save("ball.ply")
        with self.assertRaises(smg.MemoryLimitError):
            smg.open("ball.ply", memory="1MiB").points
        os.remove("ball.ply")

    def test_everywhere_is_a_place_as_any_other(self):
        for kind, arrays in MESHES.items():
            mesh = smg.mesh(*arrays)
            for places in (smg.everywhere, [smg.everywhere], [[0], smg.everywhere]):
                with self.subTest(mesh=kind, places=places):
                    self.assertTrue((mesh.distance(places).to_numpy() == 0).all())
                    one = np.cos(9 * mesh.points[:, 1])
                    np.testing.assert_array_equal(mesh.smooth(column={"One": one}, hold=places).to_numpy(), one)
                    small = mesh.simplify(20, hold=places)
                    self.assertEqual(small.n_vertices, mesh.simplify(mesh.n_vertices).n_vertices)
            if kind == "solid":
                wall = mesh.distance(wall=True).to_numpy()
                self.assertEqual(bits(mesh.distance(smg.everywhere, wall=True).to_numpy()), bits(wall))

    def test_arrays(self):
        """Whole arrays, arithmetic and blocks have the same numbers."""
        for case, _, mesh, field, names in self.each():
            with case:
                self.assertEqual(list(field.names), names)
                values = field.to_numpy()
                self.assertEqual((values.shape, values.dtype), (field.shape, field.dtype))
                self.assertEqual(len(field), mesh.n_vertices)
                self.assertEqual(bits(values), bits(np.asarray(field)))
                self.assertEqual(bits(values), bits(field[names[0]]))
                self.assertEqual(bits(values + 1), bits(field + 1))
                whole = {name: field[name] for name in names}
                for block in field.blocks(40):
                    for name in names:
                        rows = block.rows if len(whole[name]) == mesh.n_vertices else block.cell_rows
                        self.assertEqual(bits(block[name]), bits(whole[name][rows]), name)

    def test_files(self):
        """What a format can hold is in the file, in the order of the mesh; what it cannot is refused."""
        for case, kind, mesh, field, names in self.each():
            with case:
                moves = names == ["Position"]
                for suffix in SUFFIXES[kind]:
                    path = "result." + suffix
                    if not moves and suffix not in HOLD_COLUMNS[kind]:
                        with self.assertRaisesRegex(smg.Error, "cannot hold"):
                            field.save(path)
                        continue
                    field.save(path)
                    if suffix in ("ply", "stl", "vtk"):  # as text it is the same mesh
                        field.save("text." + suffix, text=True)
                        with open("text." + suffix, encoding="ascii") as text:
                            self.assertGreater(len(text.read()), 0)
                        with smg.open("text." + suffix) as found, smg.open(path) as binary:
                            self.assertEqual(bits(found.points.astype(np.float32)), bits(binary.points.astype(np.float32)))
                            self.assertEqual(found.columns, binary.columns)
                        os.remove("text." + suffix)
                    elif suffix in ("vsm", "vtu", "vtkhdf", "vtp", "smb", "svb"):
                        with self.assertRaisesRegex(smg.Error, "not written as text"):
                            field.save(path, text=True)
                    with smg.open(path) as found:
                        self.assertEqual(found.n_cells, mesh.n_cells, suffix)
                        if suffix in LOSSY:
                            continue
                        for name in names:
                            cells = name in ("Gradient", "Flux")
                            expected = field[name]
                            if suffix == "ply" and name not in found and not moves:
                                continue  # a column for each component, Solution_0 ...
                            written = found.read(name, cells=cells).reshape(expected.shape)
                            np.testing.assert_allclose(written, expected, rtol=1e-6, err_msg=suffix)
                    os.remove(path)

    def odd_jobs(self):
        """Jobs whose reports have entries, or values, that others do not have."""
        points, cells = MESHES["surface"]
        mesh = smg.mesh(points, cells)
        two = smg.mesh(np.concatenate([points, points + 5]), np.concatenate([cells, cells + len(points)]))
        yield "simplified", mesh.simplify(50)
        yield "within an error", mesh.simplify(error=0.1)
        yield "within no error", mesh.simplify(error=1e-12)
        yield "unreached", two.distance([0], source=True)
        yield "not converged", mesh.solve(dirichlet={0: 0, 9: 1}, max_cycles=1, tolerance=1e-15)
        yield "singular", two.solve(source=1)
        yield "all prescribed", mesh.solve(dirichlet=smg.everywhere >> 1)
        yield "in core", mesh.solve(dirichlet={0: 0, 9: 1}, in_core=True)
        yield "nothing moves", two.deform([smg.handle([0], fixed=True)])

    def fits(self, value, kind):
        """Whether a value is of a type in all its parts: a float is no int, and no int a bool."""
        of, parts = typing.get_origin(kind), typing.get_args(kind)
        if kind is typing.Any:
            return True
        if of is typing.Union:
            return any(self.fits(value, part) for part in parts)
        if of is list:
            return isinstance(value, list) and all(self.fits(each, parts[0]) for each in value)
        if of is dict:
            return isinstance(value, dict) and all(self.fits(each, parts[1]) for each in value.values())
        return type(value) is kind

    def test_estimates(self):
        """All entries are of the types that are declared, before a file is read and after."""
        hints = typing.get_type_hints(smg.Estimate, vars(_report))
        made = smg.mesh(*MESHES["surface"])
        made.save("estimated.ply")
        for mesh in (made, smg.open("estimated.ply")):
            for job, arguments, options in (
                ("solve", (), {"dirichlet": {0: 0.0}}),
                ("smooth", (), {}),
                ("deform", ([smg.handle([0], fixed=True)],), {}),
                ("distance", ([0],), {}),
                ("simplify", (50,), {}),
                ("blend", ({"A": np.arange(162.0)},), {"patch": smg.of_vertices(np.arange(162) > 80)}),
            ):
                for path in (None, "result.vsm", "result.ply"):
                    with self.subTest(job=job, path=path, mesh=mesh.name):
                        estimate = mesh.estimate(job, *arguments, path=path, **options)
                        for name, value in estimate.items():
                            self.assertTrue(self.fits(value, hints[name]), (name, value))

    def test_reports(self):
        """All entries are attributes that are declared, of the types that are declared."""
        hints = typing.get_type_hints(smg.Report, vars(_report))
        seen = set()
        warnings.simplefilter("ignore", smg.NotConvergedWarning)
        fields = [(case, field.report) for case, _, _, field, _ in self.each()]
        odd = [(self.subTest(job=name), done.report) for name, done in self.odd_jobs()]
        for case, report in fields + odd:
            with case:
                self.assertLessEqual(set(report), set(hints))
                for name, value in report.items():
                    self.assertTrue(self.fits(value, hints[name]), (name, value))
                    self.assertIs(getattr(report, name), value)
                    seen.add(name)
                self.assertIs(type(report.to_dict()), dict)
                self.assertEqual(json.loads(json.dumps(report.to_dict())), report)
                with self.assertRaisesRegex(AttributeError, "no entry 'vertexes' .*: 'vertices' is meant"):
                    report.vertexes
        self.assertLessEqual({"energy", "steps", "seams", "distance", "dropped_bodies", "removed_source"}, seen)
        mesh = smg.mesh(*MESHES["surface"])
        estimate = mesh.estimate("smooth")
        self.assertLessEqual(set(estimate), set(smg.Estimate.__annotations__))
        with self.assertRaisesRegex(AttributeError, "no entry 'memory_byte' .*: 'memory_bytes' is meant"):
            estimate.memory_byte
        with self.assertRaisesRegex(AttributeError, "This report has no entry 'seams'"):
            mesh.smooth().report.seams

    def test_next_jobs(self):
        """A result goes into every other job, and what that finds is what it finds of a file of it."""
        for case, kind, _, field, names in self.each():
            with case:
                field.save("result.vsm")
                with field.as_mesh() as closed:
                    closed.n_vertices
                with smg.open("result.vsm") as file:
                    chained = field.as_mesh()
                    self.assertEqual(bits(chained.points), bits(file.points))
                    for name in names:
                        self.assertIn(name, chained)
                        self.assertEqual(bits(chained[name]), bits(field[name]))
                    jobs = [lambda m: m.distance([0]), lambda m: m.solve(dirichlet={0: 1.0})]
                    if kind == "surface":
                        jobs.append(lambda m: m.smooth())
                    for job in jobs:
                        self.assertEqual(bits(job(field).to_numpy()), bits(job(file).to_numpy()))
                        if names[-1] in job(field):  # another solve replaces fluxes
                            self.assertEqual(bits(job(field)[names[-1]]), bits(job(file)[names[-1]]))
                    if kind == "surface":
                        small = field.simplify(60)
                        self.assertEqual(bits(small.points), bits(chained.points[small["OriginalId"]]))

    def test_pyvista(self):
        try:
            import pyvista  # noqa: F401
        except ImportError:
            self.skipTest("PyVista is not installed")
        for case, _, _, field, names in self.each():
            with case:
                dataset = field.to_pyvista()
                for name in names:
                    if name != "Position":
                        data = dataset.point_data if name in dataset.point_data else dataset.cell_data
                        self.assertEqual(bits(data[name]), bits(field[name]))

    def test_functions_on_arrays(self):
        """They return what the field has: an array, or a dict of several."""
        points, cells = MESHES["surface"]
        part = (points[:, 0] > 0.3).astype(np.int32)
        mesh = smg.mesh(points, cells)
        for job, arguments, options in (
            ("solve", (), {"dirichlet": {0: 0.0, 9: 1.0}, "outputs": ["gradient", "flux"]}),
            ("deform", ([smg.handle([0], fixed=True), smg.handle([9], translate=[0, 0, 0.1])],), {}),
            ("smooth", (), {}),
            ("smooth", (), {"column": points}),
            ("blend", ({"A": points[:, 0], "B": points},), {"patch": part}),
            ("distance", ([0],), {"source": True, "direction": True}),
        ):
            with self.subTest(job=job, options=options):
                field = getattr(mesh, job)(*arguments, **options)
                found = getattr(smg, job)(points, cells, *arguments, **options)
                for name in field.names:
                    values = found[name] if isinstance(found, dict) else found
                    self.assertEqual(bits(values), bits(field[name]), name)


class ArgumentsTest(unittest.TestCase):
    """An argument that a job does not have is a TypeError, before anything is read."""

    def test_arguments_of_other_functions(self):
        points, cells = MESHES["surface"]
        write_off("given.off", points, cells)
        handles = [smg.handle([0], fixed=True)]
        given = {
            "solve": ((), {"dirichlet": {0: 0.0}}),
            "deform": ((handles,), {}),
            "smooth": ((), {}),
            "blend": (("A",), {"patch": "B"}),
            "distance": (([0],), {}),
            "simplify": ((50,), {}),
        }
        for job, (arguments, options) in given.items():
            for wrong in ("text", "path", "copy", "smooth_size"):
                if job == "simplify" and wrong == "path":
                    continue
                mesh = smg.open("given.off")
                hint = "; it is one of save" if wrong in ("text", "path") and job != "simplify" else ""
                words = r"%s\(\) got an unexpected keyword argument '%s'%s" % (job, wrong, hint)
                more = {**options, wrong: True}
                for call in (
                    lambda: getattr(mesh, job)(*arguments, **more),
                    lambda: getattr(smg, job)(points, cells, *arguments, **more),
                ):
                    with self.subTest(job=job, wrong=wrong), self.assertRaisesRegex(TypeError, words):
                        call()
                self.assertIn("not read yet", repr(mesh))
            with self.subTest(job=job), self.assertRaisesRegex(TypeError, "positional argument"):
                getattr(smg.mesh(points, cells), job)(*arguments, "result.ply", "text")

    def test_a_name_is_no_number(self):
        mesh = smg.mesh(*MESHES["surface"])
        with self.assertRaisesRegex(smg.InputError, "simplify: vertices: must be an integer"):
            mesh.simplify("small.ply")


class NoCellTest(unittest.TestCase):
    def test_a_vertex_of_no_cell_is_in_the_file_or_its_loss_is_said(self):
        """Of meshes and of results, from arrays and from files."""
        for kind, (points, cells) in MESHES.items():
            arrays = smg.mesh(np.concatenate([points, [[7.0, 8.0, 9.0]]]), cells)
            with warnings.catch_warnings():
                warnings.simplefilter("ignore", smg.ReportWarning)
                arrays.save("loose.vsm")
                moving = [smg.handle([0], fixed=True), smg.handle([9], translate=[0, 0, 0.1])]
                for mesh in (arrays, smg.open("loose.vsm")):
                    for source in (mesh, mesh.solve(dirichlet={0: 0, 9: 1}), mesh.deform(moving)):
                        moves = not isinstance(source, smg.Field) or source.name == "Position"
                        for suffix in SUFFIXES[kind] if moves else HOLD_COLUMNS[kind]:
                            with self.subTest(kind, mesh=mesh, source=source, suffix=suffix):
                                with warnings.catch_warnings(record=True) as caught:
                                    warnings.simplefilter("always")
                                    source.save("loose_out." + suffix)
                                said = any("left out" in str(each.message) and "vert" in str(each.message)
                                           for each in caught)
                                with smg.open("loose_out." + suffix) as found:
                                    kept = found.n_vertices == len(points) + 1
                                self.assertNotEqual(kept, said)


class SimplifiedTest(unittest.TestCase):
    """A simplified mesh names vertices of a larger one; it goes everywhere a mesh goes."""

    def test_files(self):
        small = smg.mesh(*sphere(4)).simplify(200)
        smooth = small.smooth()
        for source in (small, smooth):
            for suffix in SUFFIXES["surface"]:
                with self.subTest(source=source, suffix=suffix):
                    with warnings.catch_warnings():
                        warnings.simplefilter("ignore", smg.ReportWarning)
                        source.save("small." + suffix)
                    with smg.open("small." + suffix, order="keep") as found:
                        self.assertEqual(found.n_cells, small.n_cells)
                        if suffix not in ("stl", "sma", "smb"):
                            np.testing.assert_array_equal(found.n_vertices, small.n_vertices)
                            expected = source["Position"]
                            np.testing.assert_allclose(found.points, expected, atol=1e-6)
                            np.testing.assert_array_equal(found.cells, small.cells)


if __name__ == "__main__":
    unittest.main(verbosity=2)
