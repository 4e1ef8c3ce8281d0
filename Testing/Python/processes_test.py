# SPDX-License-Identifier: BSD-3-Clause
"""Forked children leave what their parent has alone, and can use it; the interpreter ends at any time."""

import gc
import multiprocessing
import os
import pickle
import shutil
import signal
import subprocess
import sys
import tempfile
import textwrap
import unittest
import warnings

from testing import BUNNY, bits, np, smg, sphere
from streamingmultigrid import _process

POINTS, CELLS = sphere(5)
PROBLEM = {"dirichlet": {0: 0.0, 99: 1.0}}
LIMIT = 120  # seconds, after which something hangs

warnings.filterwarnings("ignore", category=DeprecationWarning)  # of forks with threads, Python 3.12


def in_child(function):
    """What a forked child finds: "" if the function does not fail, else the error. It then ends as
    programs do, with its finalizers."""
    read, write = os.pipe()
    child = os.fork()
    if child == 0:
        signal.alarm(LIMIT)
        try:
            said = function() or ""
        except BaseException as error:
            said = "%s: %s" % (type(error).__name__, error)
        os.write(write, said.encode())
        os.close(write)
        gc.collect()
        _process._end()  # what the package does at the end; this script would remove its folders
        os._exit(0)
    os.close(write)
    with os.fdopen(read) as pipe:
        said = pipe.read()
    _, status = os.waitpid(child, 0)
    if status != 0:
        said += " status %d" % status
    return said


def equal(found, expected):
    return "" if bits(found) == bits(expected) else "other bits"


def refused(call):
    """The memory of a solver is its parent's."""
    try:
        call()
    except smg.Error as error:
        return "" if "make it again in the child" in str(error) else str(error)
    return "no error"


class ForkTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.scratch = tempfile.TemporaryDirectory()
        cls.mesh = smg.open(BUNNY, scratch=cls.scratch.name, threads=3)
        cls.field = cls.mesh.solve(**PROBLEM)
        cls.small = cls.mesh.simplify(500)
        cls.solver = cls.mesh.solver(**PROBLEM)
        cls.load = np.zeros(cls.mesh.n_vertices)
        cls.load[99] = 1
        cls.values, cls.points = cls.field.to_numpy(), cls.mesh.points
        cls.x = cls.solver.solve(cls.load)
        next(iter(cls.field.blocks()))

    @classmethod
    def tearDownClass(cls):
        for each in (cls.field, cls.small, cls.solver, cls.mesh):
            each.close()
        assert os.listdir(cls.scratch.name) == []
        cls.scratch.cleanup()

    #: What a child does with its copies.
    USES = {
        "nothing": lambda t: None,
        "reads the mesh": lambda t: equal(t.mesh.points, t.points),
        "reads the field": lambda t: equal(t.field.to_numpy(), t.values),
        "reads blocks": lambda t: equal(
            np.concatenate([b["Solution"][~b.ghost] for b in t.field.blocks()]),
            t.values[np.concatenate([b.rows[~b.ghost] for b in t.field.blocks()])],
        ),
        "solves": lambda t: equal(t.mesh.solve(**PROBLEM).to_numpy(), t.values),
        "simplifies": lambda t: equal(t.mesh.simplify(500).points, t.small.points),
        "solves with the solver": lambda t: refused(lambda: t.solver.solve(t.load)),
        "multiplies": lambda t: refused(lambda: t.solver.multiply(t.x)),
        "preconditions": lambda t: refused(lambda: t.solver.precondition(t.load)),
        "makes a solver": lambda t: equal(t.mesh.solver(**PROBLEM).solve(t.load), t.x),
        "closes the solver": lambda t: t.solver.close(),
        "closes the field": lambda t: t.field.close(),
        "closes the mesh": lambda t: t.mesh.close(),
        "closes the simplified mesh": lambda t: t.small.close(),
        "drops all": lambda t: [t.__dict__.clear(), gc.collect(), None][2],
        "saves": lambda t: t.field.save("child.vtu") and None,
    }

    def test_a_child_uses_its_copies_and_leaves_those_of_its_parent(self):
        files = set(os.listdir(self.scratch.name))
        for use, function in self.USES.items():
            with self.subTest(use=use):
                self.assertEqual(in_child(lambda f=function: f(self)), "")
                self.assertLessEqual(files, set(os.listdir(self.scratch.name)))
                self.assertEqual(bits(self.mesh.points), bits(self.points))
                self.assertEqual(bits(self.field.to_numpy()), bits(self.values))
                self.assertEqual(bits(self.solver.solve(self.load)), bits(self.x))
                self.assertLessEqual(self.small.n_vertices, 500)
                self.assertGreater(len(self.small.points), 0)

    def test_pool(self):
        """The default of multiprocessing up to Python 3.13."""
        with multiprocessing.get_context("fork").Pool(2) as pool:
            means = pool.map(_mean, range(4))
            pool.map(_drop, range(4))
        self.assertEqual(set(means), {float(self.points.mean())})
        self.assertEqual(bits(self.mesh.solve(**PROBLEM).to_numpy()), bits(self.values))

    def test_in_a_progress_function(self):
        """The child is in the middle of a call, with which it does not go on; the parent does."""
        children = []

        def fork(_):
            if not children:
                children.append(os.fork())

        mesh = smg.mesh(POINTS, CELLS, scratch=self.scratch.name, threads=3)
        own = os.getpid()
        try:
            u = mesh.solve(**PROBLEM, progress=fork)
        except smg.Error as error:
            if os.getpid() == own:
                raise
            signal.alarm(LIMIT)
            used = 0
            try:
                mesh.points
            except smg.Error as again:
                used = "forked" in str(again)
            mesh.close()
            fresh = smg.mesh(POINTS, CELLS).solve(**PROBLEM)
            is_right = "forked" in str(error) and used and fresh.shape == (len(POINTS),)
            os._exit(0 if is_right else 1)
        if os.getpid() != own:
            os._exit(2)
        self.assertEqual(os.waitpid(children[0], 0)[1], 0)
        self.assertEqual(bits(u.to_numpy()), bits(smg.solve(POINTS, CELLS, **PROBLEM)))

    def test_while_another_thread_computes(self):
        """Its handles are lost in the child, with a sentence; it opens its own."""
        import threading

        mesh = smg.mesh(POINTS, CELLS, threads=3)
        other = smg.mesh(POINTS, CELLS)
        computes, may_end = threading.Event(), threading.Event()

        def wait(_):
            computes.set()
            may_end.wait(LIMIT)

        thread = threading.Thread(target=lambda: mesh.solve(**PROBLEM, progress=wait))
        thread.start()
        computes.wait()
        try:
            for each in (mesh, other):
                self.assertRegex(in_child(lambda m=each: m.n_cells and ""), "forked in the middle")
            self.assertEqual(in_child(lambda: mesh.close()), "")
            self.assertEqual(in_child(lambda: smg.mesh(POINTS, CELLS).simplify(500).n_cells and ""), "")
        finally:
            may_end.set()
            thread.join()
        self.assertEqual(bits(mesh.points), bits(POINTS))


def _mean(_):
    return float(ForkTest.mesh.points.mean())


def _drop(_):
    ForkTest.mesh = ForkTest.field = ForkTest.small = ForkTest.solver = None
    gc.collect()


class ExitTest(unittest.TestCase):
    """Scripts end as they should: 0, with nothing on stderr but what is expected, nothing left."""

    START = """
        import os, sys, threading, time
        import streamingmultigrid as smg
        from testing import sphere
        points, cells = sphere(5)
        mesh = smg.mesh(points, cells)
        problem = {"dirichlet": {0: 0.0, 99: 1.0}}
        began = threading.Event()
        def solve(thread_ends=None):
            while True:
                try:
                    mesh.solve(**problem, progress=lambda _: began.set())
                except smg.Error:
                    return
        """
    ENDINGS = {
        "a daemon thread computes": """
            threading.Thread(target=solve, daemon=True).start()
            began.wait()
            """,
        "several daemon threads compute": """
            for _ in range(3):
                other = smg.mesh(points, cells)
                threading.Thread(target=lambda m=other: m.smooth(steps=500), daemon=True).start()
            threading.Thread(target=solve, daemon=True).start()
            began.wait()
            """,
        "a daemon thread computes, sys.exit": """
            threading.Thread(target=solve, daemon=True).start()
            began.wait()
            sys.exit(0)
            """,
        "handles are open": """
            field = mesh.solve(**problem)
            solver = mesh.solver(**problem)
            small = mesh.simplify(500)
            blocks = field.blocks(500)
            next(blocks)
            """,
        "in a child": """
            field = mesh.solve(**problem)
            solver = mesh.solver(**problem, threads=2)
            solver.solve(points)
            small = mesh.simplify(500)
            child = os.fork()
            if child:
                assert os.waitpid(child, 0)[1] == 0
                field.to_numpy(), small.points, mesh.smooth()
            """,
    }

    def test_endings(self):
        for name, script in self.ENDINGS.items():
            with self.subTest(ending=name), tempfile.TemporaryDirectory() as scratch:
                text = textwrap.dedent(self.START) + textwrap.dedent(script)
                path = [os.path.dirname(os.path.abspath(__file__)), os.environ["PYTHONPATH"]]
                done = subprocess.run(
                    [sys.executable, "-W", "ignore", "-c", text],
                    capture_output=True,
                    text=True,
                    timeout=LIMIT,
                    env={**os.environ, "TMPDIR": scratch, "PYTHONPATH": os.pathsep.join(path)},
                )
                self.assertEqual(done.returncode, 0, done.stderr)
                self.assertNotIn("FATAL", done.stderr)
                self.assertEqual(os.listdir(scratch), [])


class LibraryTest(unittest.TestCase):
    def test_a_library_of_another_build_is_refused(self):
        package = os.path.dirname(smg.__file__)
        for name, change, words in (
            ("_version.py", 'VERSION = "9.9.9"\n', "package is of version 9.9.9, but the library .* of version"),
            ("_library.py", '_FUNCTIONS["smg_of_later"] = []\n', "without smg_of_later"),
        ):
            with self.subTest(changed=name), tempfile.TemporaryDirectory() as folder:
                copy = os.path.join(folder, "a", "b", "streamingmultigrid")
                shutil.copytree(package, copy, ignore=shutil.ignore_patterns("vtk", "__pycache__"))
                with open(os.path.join(copy, name), "a", encoding="utf-8") as file:
                    file.write(change)
                done = subprocess.run(
                    [sys.executable, "-c", "import streamingmultigrid as smg; smg.__version__"],
                    capture_output=True,
                    text=True,
                    env={
                        **os.environ,
                        "PYTHONPATH": os.path.dirname(copy),
                        "LD_LIBRARY_PATH": os.path.join(os.environ["SMG_BUILD_DIR"], "lib"),
                    },
                )
                self.assertRegex(done.stderr.splitlines()[-1], "^ImportError: streamingmultigrid: .*" + words)


class PickleTest(unittest.TestCase):
    """A mesh of a file is sent to another process as its name; what is in this process alone is not."""

    def test_meshes_of_files(self):
        sent = pickle.loads(pickle.dumps(smg.open(BUNNY, memory="64MB", order="axis")))
        self.assertEqual(bits(sent.points), bits(smg.open(BUNNY).points))
        self.assertEqual(sent.defaults("memory"), {"memory": "64MB"})

    def test_others_say_what_to_do(self):
        changed = smg.open(BUNNY)
        changed["One"] = np.ones(changed.n_vertices)
        mesh = smg.mesh(POINTS, CELLS)
        for each in (mesh, mesh.solve(**PROBLEM), mesh.solver(**PROBLEM), mesh.simplify(500), changed):
            with self.assertRaisesRegex(smg.Error, "save"):
                pickle.dumps(each)


if __name__ == "__main__":
    unittest.main(verbosity=2)
