# SPDX-License-Identifier: BSD-3-Clause
"""A wheel, built without a network from the libraries of the build folder, installed in an
environment of its own, uses the libraries that it carries."""

import glob
import os
import re
import shutil
import subprocess
import sys
import tarfile
import unittest

from testing import SOURCE, need

sys.path.insert(0, os.path.join(SOURCE, "Python"))
import build_backend  # noqa: E402
import own_names  # noqa: E402

need("venv", "ensurepip", "pip")
ENVIRONMENT = {name: value for name, value in os.environ.items() if name != "PYTHONPATH"}
BUILD = os.environ["SMG_BUILD_DIR"]

# Other libraries of the names of those in the wheel, loaded before, which lack all that these have; that
# of NumPy has one of the names, too.
OTHERS = """
import ctypes, sys
import numpy
for path in sys.argv[1:]:
    ctypes.CDLL(path, mode=ctypes.RTLD_GLOBAL)
"""
PROGRAM = """
import os, re, sys
import numpy as np
import streamingmultigrid as smg
points = np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0], [1, 1, 0.5]])
u = smg.solve(points, [[0, 1, 2], [2, 1, 3]], dirichlet={0: 0.0, 3: 1.0})
assert u[0] == 0 and u[3] == 1 and 0 < u[1] < 1, u
here = os.path.dirname(smg.__file__)
assert here.startswith(sys.prefix), here
others = {os.path.abspath(each) for each in sys.argv[1:]}
loaded = {line.split()[-1] for line in open("/proc/self/maps") if "/" in line}
for name in ("libsmgSolver", "libsmgIOCore", "libstreamingmultigrid", "libcholmod", "libmetis"):
    (path,) = [each for each in loaded - others if os.path.basename(each).startswith(name)]
    assert path.startswith(here), path
print(smg.__version__)
"""


def run(*command):
    return subprocess.run(command, check=True, env=ENVIRONMENT, timeout=900, stdout=subprocess.PIPE,
                          text=True).stdout  # fmt: skip


class WheelTest(unittest.TestCase):
    def test_wheel(self):
        run(sys.executable, "-m", "venv", "--clear", "--system-site-packages", "environment")
        python = os.path.join("environment", "bin", "python")
        run(python, "-m", "pip", "wheel", "--quiet", "--no-index", "--no-build-isolation", "--no-deps",
            "--config-settings", "build-dir=" + BUILD, "--wheel-dir", "wheels", SOURCE)  # fmt: skip
        (wheel,) = [name for name in os.listdir("wheels") if name.endswith(".whl")]
        self.assertRegex(wheel, r"^streamingmultigrid-[0-9.]+-py3-none-linux_\w+\.whl$")
        run(python, "-m", "pip", "install", "--quiet", "--no-index", os.path.join("wheels", wheel))
        version = run(python, "-c", PROGRAM).strip()
        self.assertEqual(wheel.split("-")[1], version)
        self.assertEqual(version, run(python, "-c", OTHERS + PROGRAM, *self.other_libraries()).strip())
        listed = run(python, "-m", "pip", "show", "--files", "streamingmultigrid")
        for name in ("LICENSE", "copyright", "py.typed", "entry_points.txt"):
            self.assertIn(name, listed)

    def other_libraries(self):
        """Empty libraries of the names of those that the library of the build folder needs."""
        (library,) = glob.glob(os.path.join(BUILD, "lib*", "**", "libstreamingmultigrid.so"), recursive=True)
        needed = re.findall(r"^\s*(\S+) => /", run("ldd", library), re.M)
        names = [name for name in needed if not build_backend.is_of_system(name)]
        for name in ("libcholmod.so.", "libsmgSolver.so.", "libsmgIOCore.so.", "libmetis.so."):
            self.assertTrue(any(each.startswith(name) for each in names), names)
        for name in names:
            run("cc", "-shared", "-Wl,-soname," + name, "-o", name, "-x", "c", os.devnull)
        return [os.path.abspath(name) for name in names]

    def test_own_names(self):
        """Of each library that some program here needs, in the library itself, and where it is asked for."""
        needed = re.findall(r"^\s*(\S+) => (/\S+)", run("ldd", shutil.which("cmake")), re.M)
        data = {}
        for name, path in needed:
            with open(path, "rb") as file:
                data[name] = file.read()
        names = {name: own_names.own_name(name, content) for name, content in data.items()}
        self.assertEqual(len(set(names.values())), len(names))
        for name, content in data.items():
            self.assertEqual(len(names[name]), len(name))
            self.assertNotEqual(names[name], own_names.own_name(name, content + b"another"))
            changed = own_names.renamed(content, names)
            self.assertEqual(len(changed), len(content))
            with open("changed", "wb") as file:
                file.write(changed)
            said = run("readelf", "--dynamic", "--version-info", "--wide", "changed")
            found = set(re.findall(r"(?:Library soname|Shared library): \[(.*)\]|File: (\S+)", said))
            found = {one or other for one, other in found}
            self.assertIn(names[name], found)
            self.assertFalse(found.intersection(names), found)
        with self.assertRaises(ValueError):
            own_names.renamed(data[name], {name: name + "longer"})
        with self.assertRaises(ValueError):
            own_names.renamed(b"no library", {})

    def test_a_module_for_toml_is_asked_for_where_there_is_none(self):
        """As Python before 3.11 in an environment without pip."""
        text = (
            "import importlib.abc, sys\n"
            "class Without(importlib.abc.MetaPathFinder):\n"
            "    def find_spec(self, name, path=None, target=None):\n"
            "        if name.split('.')[0] in %r:\n"
            "            raise ImportError(name)\n"
            "sys.meta_path.insert(0, Without())\n"
            "import build_backend\n"
            "print(build_backend.get_requires_for_build_wheel(), build_backend.get_requires_for_build_sdist())\n"
        )
        folder = os.path.join(SOURCE, "Python")
        for missing, found in ((("tomllib", "tomli", "pip"), "['tomli'] ['tomli']\n"), (("tomli", "pip"), None)):
            program = "import sys; sys.path.insert(0, %r)\n" % folder + text % (missing,)
            said = run(sys.executable, "-c", program)
            if found or sys.version_info >= (3, 11):
                self.assertEqual(said, found or "[] []\n")

    def test_source_archive(self):
        name = build_backend.build_sdist(os.getcwd())
        with tarfile.open(name) as archive:
            names = {entry.split("/", 1)[1] for entry in archive.getnames()}
        self.assertTrue({"PKG-INFO", "pyproject.toml", "CMakeLists.txt", "LICENSE",
                         "Python/streamingmultigrid/__init__.py"} <= names)  # fmt: skip
        self.assertFalse(any(each.startswith("build/") for each in names))


unittest.main(verbosity=2)
