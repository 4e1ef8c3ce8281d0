# SPDX-License-Identifier: BSD-3-Clause
"""What documents show in Python runs as it stands: the blocks of docs/python.md, of the README and of pages on groups, one
after the other, and the notebook."""

import json
import os
import shutil
import unittest

from testing import SINK, SOURCE, need

need("matplotlib")
import matplotlib  # noqa: E402

from documents import blocks  # noqa: E402

matplotlib.use("Agg")


def run(text, name):
    exec(compile(text, name, "exec"), {"__name__": "__main__"})


class Documents(unittest.TestCase):
    def setUp(self):
        if not os.path.exists("Examples"):
            os.symlink(os.path.join(SOURCE, "Examples"), "Examples")

    def test_the_page_on_python(self):
        text = blocks("docs/python.md", "")
        self.assertGreater(text.count("\n"), 40)
        run(text, "docs/python.md")
        for name in ("field.vtu", "smooth.ply", "turned.ply"):
            self.assertGreater(os.path.getsize(name), 1e5)

    def test_the_first_way_of_the_readme(self):
        text = blocks("README.md", "streamingmultigrid as smg")
        self.assertIn("solve", text)
        run(text, "README.md")

    def test_pages_on_groups(self):
        shutil.copy(SINK, "heat_sink.msh")
        for page in ("docs/groups.md", "Examples/CalculiX/README.md"):
            text = blocks(page, "solve")
            self.assertIn("smg.group", text)
            run(text, page)

    def test_the_notebook_has_its_picture(self):
        path = os.path.join(SOURCE, "Examples", "Notebook", "scan_to_picture.ipynb")
        with open(path, encoding="utf-8") as file:
            cells = json.load(file)["cells"]
        os.environ["SMG_SCAN"] = "Examples/Data/bunny.smb"
        run("\n".join("".join(c["source"]) for c in cells if c["cell_type"] == "code"), path)
        self.assertGreater(os.path.getsize("scan.png"), 2e4)
        self.assertTrue(all(not cell.get("outputs") for cell in cells), "clear the outputs")


unittest.main()
