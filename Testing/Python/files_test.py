# SPDX-License-Identifier: BSD-3-Clause
"""Files that change while they are open, and files that a result must not overwrite."""

import os
import shutil
import time
import unittest
import warnings

from testing import np, run, smg, sphere, write_off

HELD = smg.above(z=0.9)


def write_two():
    """Twice the same mesh, in different orders, as .vsm and .ply files a and b."""
    points, triangles = sphere(3)
    chance = np.random.default_rng(1)
    order = chance.permutation(len(points))
    place = np.argsort(order)
    write_off("a.off", points, triangles)
    write_off("b.off", points[order], place[triangles])
    for name in "ab":
        run("convert", name + ".off", name + ".ply", "--order", "axis" if name == "a" else "bfs")
        run("convert", name + ".ply", name + ".vsm")


def replace(name, how):
    """The file `t` becomes that of the other order."""
    time.sleep(0.02)  # more than a tick of the clock of the file system
    if how == "rename":
        shutil.copy("b" + name, "new")
        os.replace("new", "t" + name)
    else:
        shutil.copyfile("b" + name, "t" + name)


class ReplacedTest(unittest.TestCase):
    def setUp(self):
        write_two()

    def test_a_field_of_a_mesh_that_was_replaced(self):
        uses = {
            "array": lambda mesh, field: field.to_numpy(),
            "save": lambda mesh, field: field.save("out.vtp"),
            "save .vsm": lambda mesh, field: field.save("out.vsm"),
            "column of the mesh": lambda mesh, field: mesh["OriginalId"],
            "next job": lambda mesh, field: mesh.distance(HELD).to_numpy(),
            "blocks": lambda mesh, field: list(mesh.blocks(100)),
            "simplify": lambda mesh, field: mesh.simplify(50, path="out.ply"),
        }
        for how in ("rename", "write"):
            for name, use in uses.items():
                with self.subTest(how=how, use=name):
                    shutil.copy("a.vsm", "t.vsm")
                    mesh = smg.open("t.vsm")
                    field = mesh.solve(dirichlet=HELD >> 1, screening=1)
                    replace(".vsm", how)
                    with self.assertRaisesRegex(smg.Error, "t.vsm"):
                        use(mesh, field)

    def test_a_file_that_is_written_again(self):
        for how in ("rename", "write"):
            shutil.copy("a.ply", "t.ply")
            mesh = smg.open("t.ply")
            moved = mesh.smooth(size="4edges")
            moved.save("before.ply")
            replace(".ply", how)
            with self.assertRaisesRegex(smg.Error, "t.ply: was replaced or changed"):
                moved.save("after.ply")
            self.assertFalse(os.path.exists("after.ply"))
            moved.save("after.vsm")  # of the mesh that was opened, which is kept


VTK = """# vtk DataFile Version 3.0
mesh
ASCII
DATASET UNSTRUCTURED_GRID
POINTS {points} double
{coordinates}
CELLS {cells} {size}
{corners}
CELL_TYPES {cells}
{types}
"""


def write_vtk(name, points, cells, more=""):
    """Legacy VTK of cells, each a type and its corners."""
    with open(name, "w") as file:
        file.write(VTK.format(
            points=len(points), cells=len(cells), size=sum(len(cell) for cell in cells),
            coordinates="\n".join("%r %r %r" % tuple(map(float, point)) for point in points),
            corners="\n".join(" ".join(map(str, (len(cell) - 1, *cell[1:]))) for cell in cells),
            types="\n".join(str(cell[0]) for cell in cells)) + more)


class LeftOutTest(unittest.TestCase):
    """What the reader of a mesh leaves out or changes is said when the mesh is opened, once."""

    SQUARE = [(0, 0, 0), (1, 0, 0), (0, 1, 0), (1, 1, 0)]
    HALVES = [(5, 0, 1, 2), (5, 1, 3, 2)]

    def sentences(self, opened):
        with warnings.catch_warnings(record=True) as caught:
            warnings.simplefilter("always")
            mesh = opened()
            _ = mesh.n_vertices
            _ = mesh.points
        for each in caught:
            self.assertIs(each.category, smg.ReportWarning)
            self.assertEqual(each.filename, __file__)
        return [str(each.message) for each in caught]

    def test_each_kind(self):
        middles = [(0.5, 0, 0), (0.5, 0.5, 0), (0, 0.5, 0)]
        ids = "POINT_DATA 4\nSCALARS OriginalId vtktypeint64 1\nLOOKUP_TABLE default\n3 2 1 0\n"
        other = "POINT_DATA 4\nSCALARS OriginalId double 1\nLOOKUP_TABLE default\n3 2 1 0\n"
        for what, points, cells, more, words in (
            ("nothing", self.SQUARE, self.HALVES, "", None),
            ("line", self.SQUARE, [*self.HALVES, (3, 0, 1)], "", "1 cell of another type"),
            ("lines", self.SQUARE, [*self.HALVES, (3, 0, 1), (3, 1, 2)], "", "2 cells of other types"),
            ("unused", [*self.SQUARE, (9, 9, 9)], self.HALVES, "", "1 vertex belongs to no cell"),
            ("degenerate", self.SQUARE, [*self.HALVES, (5, 0, 0, 1)], "", "1 cell is degenerate"),
            ("duplicate", self.SQUARE, [*self.HALVES, (5, 2, 0, 1)], "", "1 cell has the corners"),
            ("quadratic", self.SQUARE[:3] + middles, [(22, 0, 1, 2, 3, 4, 5)], "", "1 higher-order cell"),
            ("numbers", self.SQUARE, self.HALVES, ids, "of its own: rows are in the order of its numbers"),
            ("other numbers", self.SQUARE, self.HALVES, other, "is called 'OriginalId_1'"),
        ):
            with self.subTest(what):
                write_vtk("left.vtk", points, cells, more)
                with smg.open("left.vtk") as mesh:
                    found = self.sentences(lambda: mesh)
                    self.assertEqual(self.sentences(lambda: mesh), [])
                if words is None:
                    self.assertEqual(found, [])
                else:
                    self.assertRegex("".join(found), words)
                    self.assertTrue(all("left.vtk: " in sentence for sentence in found))

    def test_what_no_mesh_has_is_said(self):
        """Lists and elements of PLY files; groups, materials and lines of OBJ files."""
        names = ["x", "y", "z"]
        header = ["ply", "format ascii 1.0", "element vertex 3", *("property float " + name for name in names),
                  "%s", "element face 1", "property list uchar int vertex_indices", "%s", "%s", "end_header", ""]
        for parts, rows, words in (
            (("", "", ""), ("", "", ""), None),
            (("property list uchar int near", "", ""), (" 0", "", ""), "the list 'near' of the element 'vertex'"),
            (("", "property list uchar float texcoord", ""), ("", " 0", ""), "the list 'texcoord' of the element 'face'"),
            (("", "", "element camera 1\nproperty float f"), ("", "", "3\n"), "the element 'camera'"),
            (("", "", "element camera 0\nproperty float f"), ("", "", ""), None),
        ):
            with self.subTest(parts), open("left.ply", "w", encoding="ascii") as file:
                lines = "\n".join(header) % parts
                file.write("\n".join(line for line in lines.split("\n") if line) + "\n")
                file.write("0 0 0%s\n1 0 0%s\n0 1 0%s\n3 0 1 2%s\n%s" % (*[rows[0]] * 3, rows[1], rows[2]))
                file.flush()
                found = self.sentences(lambda: smg.open("left.ply"))
                self.assertEqual(found, []) if words is None else self.assertRegex("".join(found), words)
        for more, words in (("g a\n", "groups and materials"), ("usemtl steel\n", "groups and materials"),
                            ("l 1 2\nl 2 3\n", "2 elements of lines"), ("p 1\n", "1 element of lines or points")):
            with self.subTest(more), open("left.obj", "w", encoding="ascii") as file:
                file.write("v 0 0 0\nv 1 0 0\nv 0 1 0\n%sf 1 2 3\n" % more)
                file.flush()
                self.assertRegex("".join(self.sentences(lambda: smg.open("left.obj"))), words)

    def test_arrays(self):
        triangles = [cell[1:] for cell in self.HALVES]
        self.assertEqual(self.sentences(lambda: smg.mesh(self.SQUARE, triangles)), [])
        found = self.sentences(
            lambda: smg.mesh([*self.SQUARE, (9, 9, 9)], [*triangles, (0, 0, 1)]))
        self.assertRegex("".join(found), "1 vertex belongs to no cell")
        self.assertRegex("".join(found), "1 cell is degenerate")


class ColoursTest(unittest.TestCase):
    def test_what_is_written_is_read(self):
        """Colours of any type and size: in the file, clamped with a warning, or left out with one."""
        points, triangles = sphere(1)
        chance = np.random.default_rng(3)
        for suffix in ("off", "obj"):
            for type_ in ("u1", "i4", "i8", "f4", "f8"):
                for width in (3, 4):
                    for scale in (1.0, 1e-6, 255.0, 1e6, 1e20 if type_[0] == "f" else 1.0):
                        with self.subTest(suffix, type=type_, width=width, scale=scale):
                            with np.errstate(all="ignore"):
                                colours = (scale * chance.uniform(size=(len(points), width))).astype(type_)
                            mesh = smg.mesh(points, triangles)
                            mesh.add("Colors", colours, False)
                            with warnings.catch_warnings(record=True) as caught:
                                warnings.simplefilter("always")
                                mesh.save("coloured." + suffix)
                            said = "".join(str(each.message) for each in caught)
                            with warnings.catch_warnings():
                                warnings.simplefilter("error")
                                found = smg.open("coloured." + suffix)
                                if "Colors" not in found:
                                    self.assertIn("left out", said)
                                    continue
                                shares = found["Colors"] / (255.0 if found["Colors"].dtype == np.uint8 else 1.0)
                            expected = colours / (255.0 if type_ == "u1" else 1.0)
                            if (expected > 1).any():
                                self.assertIn("outside 0 to 1", said)
                            expected = np.clip(expected, 0, 1)[:, : shares.shape[1]]
                            np.testing.assert_allclose(shares, expected, atol=1e-6)


class RowsTest(unittest.TestCase):
    def test_rows_are_those_of_the_file(self):
        """With numbering="rows", whatever numbers of another file or order it has."""
        points, triangles = sphere(3)
        chance = np.random.default_rng(2)
        for name, most in (("permutation", 1), ("part of a larger mesh", 9)):
            ids = most * chance.permutation(len(points))
            cell_ids = most * chance.permutation(len(triangles))
            more = "".join(
                "%s %d\nSCALARS %s vtktypeint64 1\nLOOKUP_TABLE default\n%s\n"
                % (where, len(numbers), column, " ".join(map(str, numbers)))
                for where, column, numbers in (("POINT_DATA", "OriginalId", ids),
                                               ("CELL_DATA", "OriginalCellId", cell_ids)))
            write_vtk("rows.vtk", points, [(5, *corners) for corners in triangles], more)
            for cache in (None, "kept", "kept"):
                with self.subTest(name, cache=cache), warnings.catch_warnings():
                    warnings.simplefilter("ignore", smg.ReportWarning)
                    mesh = smg.open("rows.vtk", numbering="rows", cache=cache)
                    np.testing.assert_array_equal(mesh.points, points)
                    np.testing.assert_array_equal(mesh.cells, triangles)
                    np.testing.assert_array_equal(mesh["OriginalId_1"], ids)
                    np.testing.assert_array_equal(mesh["OriginalCellId_1"], cell_ids)
                    held = points[:, 2] > 0.9
                    there = mesh.solve(dirichlet=smg.mask(held) >> 1, screening=1, source=points[:, 0])
                    plain = smg.mesh(points, triangles).solve(
                        dirichlet=smg.mask(held) >> 1, screening=1, source=points[:, 0])
                    np.testing.assert_allclose(there.to_numpy(), plain.to_numpy(), atol=1e-6)


class OverwrittenTest(unittest.TestCase):
    def test_no_file_of_the_mesh(self):
        write_off("t.off", *sphere(2))
        run("convert", "t.off", "t.node")
        run("convert", "t.off", "t.vsm")
        for name, files in (("t.node", ("t.node", "t.ele")), ("t.ele", ("t.node", "t.ele")),
                            ("t.vsm", ("t.vsm",)), ("t.off", ("t.off",))):
            mesh = smg.open(name)
            moved = mesh.smooth(size="4edges")
            for file in files:
                with open(file, "rb") as content:
                    before = content.read()
                for save in (moved.save, mesh.save, lambda path: mesh.simplify(50, path=path)):
                    with self.subTest(mesh=name, file=file), self.assertRaisesRegex(
                            smg.Error, "choose another name"):
                        save(file)
                with open(file, "rb") as content:
                    self.assertEqual(content.read(), before)


if __name__ == "__main__":
    unittest.main()
