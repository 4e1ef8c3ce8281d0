# SPDX-License-Identifier: BSD-3-Clause
"""Meshes of other packages, by the attributes that they have.

PyVista itself is used where it is installed; else the small part of it that the package uses is
imitated below, and the test says so.
"""

import pathlib
import sys
import types
import unittest
import warnings

from testing import bits, cube, np, smg, sphere

try:
    import pyvista

    print("with PyVista", pyvista.__version__)
except ImportError:
    print("PyVista is not installed: an imitation of its interface is used")
    pyvista = types.ModuleType("pyvista")

    class DataSet:
        """Points and the data of points and cells, as of pyvista.DataSet."""

        def __init__(self, points):
            self.points = np.asarray(points)
            self.point_data, self.cell_data = {}, {}

    class PolyData(DataSet):
        """Polygons, counted as in VTK, as of pyvista.PolyData."""

        def __init__(self, points, faces):
            super().__init__(points)
            self.faces = np.asarray(faces)

    class UnstructuredGrid(DataSet):
        """Cells of one size with their types, as of pyvista.UnstructuredGrid."""

        def __init__(self, cells, celltypes, points):
            super().__init__(points)
            self.celltypes = np.asarray(celltypes)
            rows = np.reshape(cells, (len(celltypes), -1))
            self.cell_connectivity = rows[:, 1:].ravel()
            self.offset = np.arange(len(rows) + 1) * (rows.shape[1] - 1)
            self.cells = np.asarray(cells)

    def register_dataset_accessor(name, target):
        """As of PyVista 0.48: an attribute that is made of the dataset."""

        def register(accessor):
            setattr(target, name, property(accessor))
            return accessor

        return register

    for _thing in (DataSet, PolyData, UnstructuredGrid, register_dataset_accessor):
        setattr(pyvista, _thing.__name__, _thing)
    sys.modules["pyvista"] = pyvista


def counted(cells):
    return np.concatenate([[len(cell), *cell] for cell in cells])


class PyVistaTest(unittest.TestCase):
    def test_surfaces(self):
        points, cells = sphere(2)
        dataset = pyvista.PolyData(points, counted(cells))
        dataset.point_data["Height"] = points[:, 2]
        dataset.cell_data["part"] = np.arange(len(cells))
        mesh = smg.from_pyvista(dataset)
        self.assertEqual(bits(mesh.points), bits(points))
        np.testing.assert_array_equal(mesh.cells, cells)
        self.assertEqual(bits(mesh["Height"]), bits(points[:, 2]))
        self.assertEqual(mesh["part"].tolist(), list(range(len(cells))))
        back = mesh.to_pyvista()
        self.assertEqual(bits(back.points), bits(points))
        np.testing.assert_array_equal(back.faces, dataset.faces)
        self.assertEqual(bits(back.point_data["Height"]), bits(points[:, 2]))

    def test_polygons(self):
        points = np.array([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0], [2, 0, 0], [2, 1, 0], [3, 0.5, 0]])
        dataset = pyvista.PolyData(
            points.astype(float), counted([[0, 1, 2, 3], [1, 4, 2], [4, 6, 5, 2]]))
        dataset.cell_data["part"] = np.array([5, 6, 7])
        mesh = smg.from_pyvista(dataset)
        self.assertEqual(mesh.cells.tolist(), [[0, 1, 2], [0, 2, 3], [1, 4, 2], [4, 6, 5], [4, 5, 2]])
        self.assertEqual(mesh["part"].tolist(), [5, 5, 6, 7, 7])
        u = mesh.solve(dirichlet=smg.plane(x=0) >> 0, flux=smg.tag("part", 7) >> 1)
        self.assertTrue(np.isfinite(u.to_numpy()).all())

    def test_concave_polygons_are_those_of_a_file(self):
        corners = [(0.5, 0.5), (0.5, 1), (0, 1), (0, 0), (1, 0), (1, 0.5)]
        points = np.array([(x, y, 2) for x, y in corners], float)
        text = "OFF\n6 1 0\n" + "\n".join("%r %r 2" % corner for corner in corners) + "\n6 %s\n"
        for first in range(6):
            cell = [(first + k) % 6 for k in range(6)]
            pathlib.Path("l.off").write_text(text % " ".join(map(str, cell)))
            mesh = smg.from_pyvista(pyvista.PolyData(points, counted([cell])))
            self.assertEqual(sorted(mesh.cells.tolist()), sorted(smg.open("l.off").cells.tolist()))
            a, b, c = np.moveaxis(points[mesh.cells], 1, 0)
            self.assertAlmostEqual(np.linalg.norm(np.cross(b - a, c - a), axis=1).sum() / 2, 0.75)
        wrong = pyvista.PolyData(points, counted([[0, 1, 2, 9]]))
        self.assertRaisesRegex(smg.InputError, "the corner 9", smg.from_pyvista, wrong)

    def test_lines_come_before_polygons(self):
        points, cells = sphere(2)
        dataset = pyvista.PolyData(points, counted(cells))
        dataset.n_verts, dataset.n_lines, dataset.GetPolys = 1, 2, None  # as a vtkPolyData has it
        part = np.arange(3 + len(cells))
        dataset.cell_data["part"] = part
        with self.assertWarnsRegex(smg.ReportWarning, "3 cells of other types are left out"):
            mesh = smg.from_pyvista(dataset)
        np.testing.assert_array_equal(mesh.read("part", cells=True), part[3:])
        dataset.n_strips = 1
        self.assertRaisesRegex(smg.InputError, "strips", smg.from_pyvista, dataset)

    def test_solids(self):
        points, cells = cube(2)
        grid = pyvista.UnstructuredGrid(counted(cells), np.full(len(cells), 10, np.uint8), points)
        mesh = smg.from_pyvista(grid)
        np.testing.assert_array_equal(mesh.cells, cells)
        result = mesh.solve(dirichlet=smg.boundary >> points[:, 0], outputs="gradient").to_pyvista()
        self.assertIsInstance(result, pyvista.UnstructuredGrid)
        self.assertEqual(result.point_data["Solution"].shape, (27,))
        self.assertEqual(result.cell_data["Gradient"].shape, (48, 3))
        wrong = pyvista.UnstructuredGrid(counted(cells), np.full(len(cells), 14, np.uint8), points)
        self.assertRaisesRegex(smg.InputError, "triangulate", smg.from_pyvista, wrong)

    def test_plugin(self):
        """What the entry points of the package name."""
        from streamingmultigrid import _pyvista

        points, cells = sphere(3)
        dataset = pyvista.PolyData(points, counted(cells))
        moved = dataset.smg.smooth(size="8edges")
        again = moved.smg.smooth(size="8edges")  # what it makes is what it takes
        self.assertEqual(again.points.shape, points.shape)
        self.assertEqual(bits(moved.points), bits(smg.smooth(points, cells, size="8edges")))
        self.assertLessEqual(len(dataset.smg.simplify(100).points), 100)
        solved = dataset.smg.solve(dirichlet={0: 0.0, 99: 1.0})
        solution = solved.point_data["Solution"]
        self.assertEqual(bits(solution), bits(smg.solve(points, cells, dirichlet={0: 0.0, 99: 1.0})))
        smg.mesh(points, cells).save("plugin.vsm")
        self.assertEqual(len(_pyvista.read("plugin.vsm").points), len(points))


class OthersTest(unittest.TestCase):
    def test_trimesh(self):
        points, cells = sphere(2)
        mesh = smg.from_pyvista(types.SimpleNamespace(vertices=points, faces=cells))
        np.testing.assert_array_equal(mesh.cells, cells)

    def test_attributes_are_columns(self):
        points, cells = sphere(1)
        mesh = smg.from_pyvista(types.SimpleNamespace(
            vertices=points, faces=cells, vertex_attributes={"q": points[:, 0]},
            face_attributes={"part": np.arange(len(cells))}))
        np.testing.assert_array_equal(mesh["q"], points[:, 0])
        np.testing.assert_array_equal(mesh["part"], np.arange(len(cells)))

    def test_faces_of_four_corners_are_quadrilaterals(self):
        points = np.array([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0], [2, 0, 0], [2, 1, 0]], float)
        faces = np.array([[0, 1, 2, 3], [1, 4, 5, 2]])
        mesh = smg.from_pyvista(types.SimpleNamespace(vertices=points, faces=faces))
        self.assertEqual(sorted(mesh.cells.tolist()), [[0, 1, 2], [0, 2, 3], [1, 4, 5], [1, 5, 2]])

    def test_meshio(self):
        points, cells = cube(2)

        def block(type_, data):
            return types.SimpleNamespace(type=type_, data=np.asarray(data))

        solid = types.SimpleNamespace(
            points=points,
            cells=[block("triangle", cells[:5, :3]), block("tetra", cells[:20]), block("tetra", cells[20:])],
            point_data={"T": points[:, 0], "names": np.array(["a"] * 27)},
            cell_data={"part": [np.full(5, 9), np.arange(20), np.arange(20, 48)]},
        )
        with warnings.catch_warnings(record=True) as caught:
            warnings.simplefilter("always")
            mesh = smg.from_pyvista(solid)
        said = "".join(str(each.message) for each in caught)
        self.assertRegex(said, "5 cells of other types are left out.*only numbers can be columns: 'names'")
        np.testing.assert_array_equal(mesh.cells, cells)
        self.assertEqual(mesh["part"].tolist(), list(range(48)))
        self.assertIn("T", mesh.columns["vertices"])
        points, cells = sphere(1)
        flat = types.SimpleNamespace(
            points=points, cells=[block("triangle", cells[:30]), block("triangle", cells[30:])])
        np.testing.assert_array_equal(smg.from_pyvista(flat).cells, cells)
        flat.cells.append(block("hexahedron", [list(range(8))]))
        self.assertRaisesRegex(smg.InputError, "hexahedron", smg.from_pyvista, flat)

    def test_what_is_no_mesh(self):
        for thing in (5, types.SimpleNamespace(points=[[0, 0, 0]]), types.SimpleNamespace(faces=[1])):
            self.assertRaises(smg.InputError, smg.from_pyvista, thing)


unittest.main(verbosity=2)
