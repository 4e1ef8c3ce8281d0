# SPDX-License-Identifier: BSD-3-Clause
"""What is said in Python is what problem and handle files say; arrays become columns of the job."""

import json
import os
import unittest

from testing import SOURCE, cube, need, np, smg, sphere

need("jsonschema")
import jsonschema  # noqa: E402

from streamingmultigrid._columns import Columns  # noqa: E402
from streamingmultigrid._merged import Merged  # noqa: E402
from streamingmultigrid._problem import handles, problem  # noqa: E402
from streamingmultigrid._regions import as_region  # noqa: E402

with open(os.path.join(SOURCE, "docs", "problem.schema.json"), encoding="utf-8") as schema_file:
    SCHEMA = json.load(schema_file)


class Mesh:
    """What descriptions ask of a mesh: 8 vertices, 12 cells, a diagonal of 5."""

    n_vertices, n_cells, n_elements = 8, 12, 12
    elements = np.arange(12)
    bounds = (0, 3, 0, 4, 0, 0)
    merged = staticmethod(lambda: Merged(np.empty(0, int), np.empty(0, int)))
    columns = {"vertices": {"T": {"type": "float64", "components": 1}, "Flow": {
        "type": "float32", "components": 3}}, "cells": {"part": {"type": "int32", "components": 1}}}


def said(**given):
    columns = Columns(Mesh())
    written = json.loads(json.dumps(problem(columns, given), default=lambda x: x.tolist()))
    jsonschema.validate(written, SCHEMA)
    return written, columns.added


class ProblemTest(unittest.TestCase):
    def check(self, expected, **given):
        written, added = said(**given)
        self.assertEqual(written, expected)
        return added

    def test_what_is_not_clear_is_refused(self):
        mask = np.arange(8) > 3
        for given, words in (
            ({"dirichlet": mask}, "say where"),
            ({"dirichlet": 0}, "say where"),
            ({"dirichlet": smg.boundary}, "no value"),
            ({"flux": smg.boundary}, "no value"),
            ({"dirichlet": {0.5: 1}}, "numbers of vertices"),
        ):
            with self.subTest(given=given), self.assertRaisesRegex(smg.InputError, words):
                said(**given)
        for mask in (mask.astype(np.uint8), mask.astype(int)):  # as a column keeps it
            with self.assertRaisesRegex(smg.InputError, "smg.mask"):
                as_region(mask)

    def test_conditions_by_name(self):
        """They say what region >> value says, take masks and numbers, and know where they belong."""
        conditions = {
            "dirichlet": (smg.dirichlet, (7.0,), 7.0),
            "flux": (smg.neumann, (7.0,), 7.0),
            "robin": (smg.robin, (2.0, 20.0), (2.0, 20.0)),
            "soft": (smg.soft, (2.0, 20.0), (2.0, 20.0)),
        }
        mask = np.arange(8) > 3
        for name, (function, arguments, value) in conditions.items():
            with self.subTest(name=name):
                for region in (smg.boundary, smg.tag("T", 3), smg.sphere([0, 0, 0], 1)):
                    self.assertEqual(said(**{name: [function(region, *arguments)]})[0], said(**{name: [region >> value]})[0])
                for region, same in ((mask, smg.mask(mask)), ([4, 7], smg.vertices([4, 7]))):
                    self.assertEqual(said(**{name: [function(region, *arguments)]})[0], said(**{name: [same >> value]})[0])
                self.assertEqual(said(**{name: function(smg.boundary, *arguments)}), said(**{name: smg.boundary >> value}))
                for other in ("dirichlet", "flux", "robin", "soft", "source", "conductivity"):
                    if other != name:
                        with self.assertRaisesRegex(smg.InputError, "^%s: .* belongs to %s=" % (other, name)):
                            said(**{other: [function(smg.boundary, *arguments)]})

    def test_regions(self):
        for region, where in (
            (smg.above(z=1), {"halfspace": [0, 0, 1, 1]}),
            (smg.below(y=2), {"halfspace": [0, -1, 0, -2]}),
            (smg.halfspace((1, 2, 3), 4), {"halfspace": [1, 2, 3, 4]}),
            (smg.box((0, 1, 2), (3, 4, 5)), {"box": [0, 1, 2, 3, 4, 5]}),
            (smg.sphere((1, 2, 3), 0.5), {"sphere": [1, 2, 3, 0.5]}),
            (smg.vertices([3, 1]), {"vertices": [3, 1]}),
            (smg.nearest([1, 2, 3]), {"nearest": [[1, 2, 3]]}),
            (smg.nearest(np.ones((2, 3), int)), {"nearest": [[1, 1, 1], [1, 1, 1]]}),
            (smg.tag("part", 3), {"tag": ["part", 3]}),
            (smg.mask("T"), {"mask": "T"}),
            (smg.boundary, {"boundary": True}),
            (smg.everywhere, {}),
        ):
            with self.subTest(region=region):
                self.check({"dirichlet": [{**where, "value": 1.5}]}, dirichlet=[region >> 1.5])
                self.check({"dirichlet": [{**where, "value": 1.5}]}, dirichlet=region >> 1.5)

    def test_regions_are_combined(self):
        """Vertex by vertex; of columns of the cells alone, cell by cell."""
        points, cells = cube(4)
        mesh = smg.mesh(points, cells)
        x, y, z = points.T
        part = (points[cells].mean(axis=1)[:, 0] > 0.5).astype(int)
        mesh["Part"], mesh["Half"] = part, x > 0.5
        outside = ((points == 0) | (points == 1)).any(axis=1)
        ball, left = smg.sphere((0, 0, 0), 0.9), smg.below(x=0.3)
        far = smg.sphere((9, 9, 9), 1)  # of no vertex
        in_ball, on_left = (points**2).sum(axis=1) <= 0.81, x <= 0.3
        of_part = np.zeros(len(points), bool)
        of_part[cells[part == 1]] = True
        for region, mask in (
            (ball, in_ball),
            (ball | left, in_ball | on_left),
            (ball & left, in_ball & on_left),
            (ball - left, in_ball & ~on_left),
            (~ball, ~in_ball),
            (~(ball | left), ~(in_ball | on_left)),
            (smg.boundary & left, outside & on_left),
            (~smg.boundary, ~outside),
            (smg.everywhere - ball, ~in_ball),
            (smg.plane(z=0) & smg.mask(y > 0.5), (z == 0) & (y > 0.5)),
            ((y > 0.5) & smg.plane(z=0), (z == 0) & (y > 0.5)),
            (smg.mask("Half") | smg.vertices([0, 3]), (x > 0.5) | np.isin(np.arange(len(x)), [0, 3])),
            (smg.tag("Half", 1) & ball, (x > 0.5) & in_ball),
            (smg.nearest([0, 0, 0]) | left, on_left),
            (smg.tag("Part", 1), part == 1),
            (smg.tag("Part", [0, 1]), np.isin(part, [0, 1])),
            (np.ones(len(x), bool) - ball, ~in_ball),
            (~smg.tag("Part", 1), part != 1),
            (smg.tag("Part", 1) & smg.mask("Part"), part == 1),
            (smg.tag("Part", 1) & smg.below(x=0.5), of_part & (x <= 0.5)),
            (left | smg.tag("Part", 1), of_part | on_left),
            (ball | far, in_ball),
            (ball - far, in_ball),
            (~far & left, on_left),
            (smg.everywhere - far, in_ball | True),
        ):
            with self.subTest(region=region):
                np.testing.assert_array_equal(mesh.select(region), mask)
                if len(mask) == len(points):
                    np.testing.assert_array_equal(mesh.distance(region), mesh.distance(smg.mask(mask)))
                else:
                    np.testing.assert_array_equal(
                        mesh.solve(dirichlet={0: 0}, source=1, conductivity=[1, region >> 5]),
                        mesh.solve(dirichlet={0: 0}, source=1, conductivity=[1, smg.mask(mask) >> 5]),
                    )

    def test_words_do_not_combine_regions(self):
        one, two = smg.above(z=0), smg.below(x=0)
        for combined in (lambda: one and two, lambda: one or two, lambda: not one):
            with self.assertRaisesRegex(TypeError, "combine regions with &"):
                combined()

    def test_a_plane_has_a_tolerance(self):
        written, _ = said(dirichlet=[smg.plane(y=3) >> 0, smg.plane(x=1, tolerance=0.5) >> 1])
        one, two = (entry["box"] for entry in written["dirichlet"])
        self.assertAlmostEqual(one[1], 3 - 5e-6)
        self.assertAlmostEqual(one[4], 3 + 5e-6)
        self.assertEqual((two[0], two[3]), (0.5, 1.5))
        self.assertTrue(all(abs(one[k]) > 1e100 for k in (0, 2, 3, 5)))

    def test_masks_become_columns(self):
        mask = np.arange(8) < 3
        (column,) = self.check({"dirichlet": [{"mask": "#mask", "value": 1}]}, dirichlet=smg.mask(mask) >> 1)
        self.assertEqual((column.name, column.cells, column.is_argument), ("#mask", False, True))
        self.assertTrue(np.shares_memory(column.values, mask))
        (column,) = self.check(
            {"dirichlet": [{"mask": "#mask", "value": 1}]}, dirichlet=smg.mask(np.ones(12)) >> 1)
        self.assertTrue(column.cells)

    def test_every_datum(self):
        self.check(
            {
                "weights": "clamped", "screening": 2, "source": "T", "field": "q", "initial": 3,
                "conductivity": [{"value": 25}, {"tag": ["part", 2], "value": 200}],
                "flux": [{"boundary": True, "value": 4}],
                "robin": [{"halfspace": [0, 0, 1, 0], "coefficient": 5, "ambient": "T"}],
                "soft": [{"weight": "T", "value": 7}, {"mask": "T", "weight": 6, "value": 7}],
                "outputs": ["gradient"],
            },
            weights="clamped", screening=2, source="T", field="q", initial=3,
            conductivity=[25, smg.tag("part", 2) >> 200], flux=[smg.boundary >> 4],
            robin=smg.above(z=0) >> (5, "T"), soft=[("T", 7), smg.mask("T") >> (6, 7)],
            outputs="gradient",
        )  # fmt: skip

    def test_several_right_hand_sides(self):
        self.check(
            {"columns": 2, "dirichlet": [{"boundary": True, "value": [1, 2]}], "source": [3, 3]},
            dirichlet=smg.boundary >> [1, 2], source=3)
        self.check({"columns": 2, "source": [1, 2]}, source=np.array([1, 2]), columns=2)
        (column,) = self.check({"columns": 2, "source": "#source"}, source=np.ones((8, 2)))
        self.assertEqual(column.values.shape, (8, 2))
        self.check({"columns": 3, "dirichlet": [{"boundary": True, "value": "position"}]},
                   dirichlet=smg.boundary >> "position")
        self.check({"columns": 3, "source": "Flow"}, source="Flow")
        self.check({"columns": 4, "source": [1, 1, 1, 1]}, source=1, columns=4)
        with self.assertRaisesRegex(smg.InputError, r"\(8, 8\)"):
            said(source=np.ones(8), columns=8)
        with self.assertRaisesRegex(smg.InputError, "2 and 3 components"):
            said(source=[1, 2], initial="Flow")

    def test_values_of_single_vertices(self):
        expected = {"dirichlet": [{"vertices": [0, 5], "value": 1}, {"vertices": [2], "value": 2}]}
        self.check(expected, dirichlet={0: 1, 2: 2, 5: 1})
        self.check(expected, dirichlet=smg.vertices([0, 2, 5]) >> [1, 2, 1])
        self.check({"columns": 2, "dirichlet": [{"vertices": [1], "value": [1, 2]},
                                                {"vertices": [0], "value": [3, 4]}]},
                   dirichlet=smg.vertices([1, 0]) >> [[1, 2], [3, 4]])
        # All of them, in any order: rows are those of the numbers, not of the mesh.
        written, _ = said(dirichlet={7 - i: float(i) for i in range(8)})
        self.assertEqual({e["vertices"][0]: e["value"] for e in written["dirichlet"]},
                         {7 - i: i for i in range(8)})
        # Many become a column.
        Mesh.n_vertices = 1000
        try:
            written, (column,) = said(dirichlet={i: i / 7 for i in range(0, 1000, 2)})
        finally:
            Mesh.n_vertices = 8
        (entry,) = written["dirichlet"]
        self.assertEqual(entry["value"], column.name)
        self.assertTrue((column.values[entry["vertices"]] == np.arange(0, 1000, 2) / 7).all())

    def test_conductivity(self):
        tensor = np.array([[1, 4, 6], [4, 2, 5], [6, 5, 3]])
        self.check({"source": 1, "conductivity": [1, 2, 3, 4, 5, 6]}, source=1, conductivity=tensor)
        self.check({"source": 1, "conductivity": [1, 2, 3, 0, 0, 0]}, source=1, conductivity=[1, 2, 3])
        for shape, components in (((12,), ()), ((12, 3), (3,)), ((12, 6), (6,)), ((12, 3, 3), (6,))):
            values = np.ones(shape) if shape != (12, 3, 3) else np.tile(tensor, (12, 1, 1))
            (column,) = self.check({"source": 1, "conductivity": "#conductivity"}, source=1, conductivity=values)
            self.assertEqual((column.values.shape[1:], column.cells), (components, True))
        self.assertEqual(column.values[7].tolist(), [1, 2, 3, 4, 5, 6])
        # Of three or six cells, they may be numbers of the cells.
        for count, shape, words in ((3, (3,), r"\(3, 1\)"), (6, (6,), r"\(6, 1\)"), (3, (3, 3), r"\(3, 6\)")):
            Mesh.n_cells = count
            try:
                with self.assertRaisesRegex(smg.InputError, words):
                    said(source=1, conductivity=np.ones(shape))
                said(source=1, conductivity=np.ones((count, 1)))
            finally:
                Mesh.n_cells = 12
        with self.assertRaisesRegex(smg.InputError, "symmetric"):
            said(source=1, conductivity=[[1, 2, 0], [0, 1, 0], [0, 0, 1]])
        with self.assertRaisesRegex(smg.InputError, "12 cells"):
            said(source=1, conductivity=np.ones(8))

    def test_densities_of_cells(self):
        (column,) = self.check({"source": "#source"}, source=np.ones(12))
        self.assertTrue(column.cells)
        source, screening = self.check(
            {"source": "#source", "screening": "#screening"}, source=np.ones(8), screening=np.ones(12))
        self.assertEqual((source.cells, screening.cells), (False, True))
        (column,) = self.check({"columns": 2, "source": [1, 1], "field": "#field"}, source=1, columns=2,
                               field=np.ones((12, 6)))
        self.assertTrue(column.cells)

    def test_errors_say_what_is_wrong(self):
        for given, words in (
            ({"source": np.ones(99)}, r"\(99,\).*8 vertices or 12 cells"),
            ({"source": np.ones(7)}, r"\(7,\).*8 vertices or 12 cells"),
            ({"source": np.ones((99, 2))}, r"\(99, 2\).*8 vertices or 12 cells"),
            ({"source": np.ones(8) * 1j}, "source: .*complex"),
            ({"robin": smg.boundary >> (1, np.ones(8) * 1j)}, "robin: .*complex"),
            ({"dirichlet": smg.vertices([1, 2]) >> ["a", "b"]}, "dirichlet: .*real numbers"),
            ({"source": np.array([None] * 8)}, "objects"),
            ({"source": ["a", 1]}, "only real numbers"),
            ({"source": np.ma.array(np.ones(8), mask=[1] + [0] * 7)}, "1 values are masked"),
            ({"dirichlet": smg.mask(np.ones(8)) >> np.ones((12, 2))}, "8 vertices"),
            ({"dirichlet": {"a": 1}}, "numbers of vertices"),
            ({"robin": smg.boundary >> 1}, "coefficient, ambient"),
            ({"source": 1, "field": np.ones((12, 2))}, "3"),
        ):
            with self.subTest(given=given), self.assertRaisesRegex(smg.InputError, words):
                said(**given)
        for wrong in (
            lambda: smg.plane(), lambda: smg.plane(x=1, y=2), lambda: smg.vertices([]),
            lambda: smg.vertices([-1]), lambda: smg.vertices([0.5]), lambda: smg.box((0, 0), (1, 1, 1)),
            lambda: smg.sphere((0, 0, np.inf), 1), lambda: smg.mask(np.ones((3, 2))),
            lambda: smg.nearest([1, 2]), lambda: np.ones(8) >> smg.boundary,
        ):  # fmt: skip
            self.assertRaises(smg.InputError, wrong)

    def test_numbers_that_are_not_finite_are_named(self):
        nan, inf = float("nan"), float("inf")
        for given, words in (
            ({"source": inf}, r"^problem\.source\S* is inf: give a finite number there\.$"),
            ({"dirichlet": {0: 1.0, 1: nan}}, r"^problem\.dirichlet\S* is nan: give a finite number there\.$"),
            ({"screening": -inf, "source": 1}, r"^problem\.screening\S* is -inf: give a finite number there\.$"),
            ({"source": 1, "tolerance": nan}, "^tolerance is nan: give a finite number there\\.$"),
        ):
            with self.subTest(given=given), self.assertRaisesRegex(smg.InputError, words):
                smg.mesh(*sphere(1)).solve(**given)

    def test_arrays_are_named_by_their_arguments(self):
        mesh = smg.mesh(*sphere(1))
        none, large = np.zeros(len(sphere(1)[0])), np.full(len(sphere(1)[0]), 1e200)
        for given, name in (({"dirichlet": smg.mask(none) >> 1}, "mask"), ({"source": large, "screening": 1}, "source")):
            with self.subTest(name), self.assertRaisesRegex(smg.Error, "the array given as %s[. ]" % name):
                mesh.solve(**given)
        with self.assertRaisesRegex(smg.Error, "its vertices have .*, the array given as patch, its cells"):
            mesh.blend(patch=none, columns=["x"])

    def test_a_problem_file_is_completed(self):
        self.check({"source": 2, "screening": 1}, problem={"source": 5, "screening": 1}, source=2)


class HandlesTest(unittest.TestCase):
    def check(self, expected, given):
        columns = Columns(Mesh())
        written = handles(columns, given)
        written = json.loads(json.dumps(written, default=lambda x: x.tolist()))
        self.assertEqual(written, {"handles": expected})
        return columns.added

    def test_motions(self):
        self.check([{"region": {"boundary": True}, "fixed": True}], smg.handle(smg.boundary, fixed=True))
        self.check(
            [{"region": {"sphere": [0, 0, 0, 1]}, "scale": 1.3, "translate": [0, 0, 1],
              "rotate": {"axis": [0, 1, 0], "degrees": 70, "center": [1, 2, 3]}}],
            [smg.handle(smg.sphere((0, 0, 0), 1), rotate=((0, 1, 0), 70), center=(1, 2, 3), scale=1.3,
                        translate=np.array([0, 0, 1]))])
        self.check([{"region": {"nearest": [[0, 0, 0], [1, 0, 0]]}, "target": [[0, 0, 1], [1, 0, 1]]}],
                   smg.handle(smg.nearest([[0, 0, 0], [1, 0, 0]]), target=[[0, 0, 1], [1, 0, 1]]))
        added = self.check(
            [{"region": {"vertices": [1, 2]}, "target": "#target", "rotation": [0, 0, 1], "logScale": "#logScale"}],
            smg.handle([1, 2], target=np.ones((8, 3)), rotation=[0, 0, 1], log_scale=np.zeros(8)))
        self.assertEqual([column.values.shape for column in added], [(8, 3), (8,)])

    def test_errors(self):
        self.assertRaises(smg.InputError, smg.handle, smg.boundary)
        self.assertRaises(smg.InputError, handles, Columns(Mesh()), [1])
        with self.assertRaisesRegex(smg.InputError, r"handle: target: the shape is \(5, 3\).*of the 8 vertices"):
            handles(Columns(Mesh()), smg.handle([1, 2], target=np.zeros((5, 3))))
        for motion in ({"scale": 2}, {"rotate": ((0, 0, 1), 90)}, {"rotate": {"axis": [0, 0, 1], "degrees": 9}}):
            with self.assertRaisesRegex(smg.InputError, r"smg.plane\(z=0.0\) has no center"):
                smg.handle(smg.plane(z=0), **motion)


unittest.main(verbosity=2)
