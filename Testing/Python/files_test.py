# SPDX-License-Identifier: BSD-3-Clause
"""Files that change while they are open, and files that a result must not overwrite."""

import os
import shutil
import time
import unittest

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
