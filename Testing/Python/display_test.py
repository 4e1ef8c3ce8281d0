# SPDX-License-Identifier: BSD-3-Clause
"""What meshes, fields and reports say of themselves, in words and in notebooks."""

import inspect
import pydoc
import unittest
import xml.etree.ElementTree as xml

from testing import BUNNY, SINK, np, smg, sphere


class DisplayTest(unittest.TestCase):
    def parse(self, html):
        return xml.fromstring("<body>%s</body>" % html)

    def test_a_mesh(self):
        mesh = smg.open(SINK)
        self.assertIn("not read yet", repr(mesh))
        text = str(mesh)
        for words in ("1,740", "5,359 tetrahedra", "PhysicalTag", "[0, 0.034]"):
            self.assertIn(words, text)
        self.assertRegex(text, r"bodies +1\n")
        self.assertRegex(text, r"boundary +[0-9,]+ faces, 1 surface\n")
        self.assertRegex(text, r"PhysicalTag +int64 x 1, of the cells: \[1, 2\]; 1 \([0-9,]+\), 2 \([0-9,]+\)")
        page = self.parse(smg.open(BUNNY)._repr_html_())
        self.assertGreater(len(page.findall(".//svg/path")), 500)

    def test_a_field(self):
        points, cells = sphere(4)
        mesh = smg.mesh(points, cells)
        u = mesh.solve(dirichlet={0: 0.0, 99: 1.0})
        self.assertIn("Solution", repr(u))
        page = self.parse(u._repr_html_())
        self.assertEqual(len(page.findall(".//svg/polyline")), 1)
        self.assertGreater(len(page.findall(".//svg/path")), 500)
        self.assertGreater(len({path.get("fill") for path in page.findall(".//svg/path")}), 50)
        self.parse(mesh.smooth()._repr_html_())
        self.assertIn("converged after", repr(u.report))
        self.parse(u.report._repr_html_())
        self.parse(mesh.estimate("solve", dirichlet={0: 0.0})._repr_html_())
        np.testing.assert_array_equal(np.asarray(u), u.to_numpy())

    def test_what_is_closed(self):
        mesh = smg.mesh(*sphere(1))
        u = mesh.solve(dirichlet={0: 0.0, 9: 1.0})
        for thing in (u, mesh):
            thing.close()
            self.assertIn(", closed>", repr(thing))
            self.assertIn(", closed>", "".join(self.parse(thing._repr_html_()).itertext()))

    def test_without_cycles(self):
        """Of what is prescribed everywhere, there is no convergence to be shown."""
        points, cells = sphere(1)
        u = smg.mesh(points, cells).solve(dirichlet=smg.everywhere >> 1)
        self.parse(u.report._repr_html_())

    def test_help(self):
        for name in smg.__all__:
            thing = getattr(smg, name)
            with self.subTest(name=name):
                self.assertTrue(isinstance(thing, smg.Region) or inspect.getdoc(thing))
                if inspect.isclass(thing):
                    for method, member in vars(thing).items():
                        if callable(member) and not method.startswith("_"):
                            self.assertTrue(inspect.getdoc(member), "%s.%s" % (name, method))
        self.assertIn("dirichlet", str(inspect.signature(smg.Mesh.solve)))
        self.assertEqual(list(inspect.signature(smg.solve).parameters)[:2], ["points", "cells"])
        self.assertIn("(n, k)", pydoc.render_doc(smg.solve))


unittest.main(verbosity=2)
