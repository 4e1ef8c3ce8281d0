# SPDX-License-Identifier: BSD-3-Clause
"""Progress, Ctrl-C, threads: what happens during a call; and that nothing is left behind."""

import _thread
import contextlib
import gc
import io
import os
import signal
import sys
import tempfile
import threading
import time
import unittest
import weakref

from streamingmultigrid._process import HandleLock, closing
from testing import BUNNY, bits, np, smg, sphere

POINTS, CELLS = sphere(5)
PROBLEM = {"dirichlet": {0: 0.0, 99: 1.0}}


class Rich:
    """The protocol of rich.progress.Progress."""

    def __init__(self):
        self.tasks = []

    def add_task(self, description, total):
        self.tasks.append([description, total, 0])
        return len(self.tasks) - 1

    def update(self, task, completed):
        self.tasks[task][2] = completed


class ProgressTest(unittest.TestCase):
    def test_functions(self):
        said = []
        mesh = smg.mesh(POINTS, CELLS, progress=said.append)
        self.assertTrue(said)
        mesh.solve(**PROBLEM, progress=said.append)
        self.assertTrue(all(0 <= part <= 1 for part in said))
        self.assertGreater(said[-1], 0.9)

    def test_bars(self):
        mesh = smg.mesh(POINTS, CELLS)
        rich = Rich()
        mesh.solve(**PROBLEM, progress=rich)
        (task,) = rich.tasks
        self.assertEqual(task[:2], ["solve", 1.0])
        self.assertGreater(task[2], 0.9)
        with contextlib.redirect_stderr(io.StringIO()) as shown:
            mesh.solve(**PROBLEM, progress=True)
        self.assertIn("solve [####", shown.getvalue())
        try:
            import tqdm
        except ImportError:
            self.skipTest("tqdm is not installed")
        with contextlib.redirect_stderr(io.StringIO()), tqdm.tqdm(total=50) as bar:
            mesh.solve(**PROBLEM, progress=bar)
            self.assertGreater(bar.n, 45)
            self.assertLessEqual(bar.n, 50 + 1e-9)
        with contextlib.redirect_stderr(io.StringIO()) as shown:
            mesh.solve(**PROBLEM, progress=tqdm.tqdm)
        self.assertIn("solve", shown.getvalue())
        self.assertRaises(smg.InputError, mesh.solve, **PROBLEM, progress=5)

    def test_opening_is_a_part(self):
        smg.mesh(POINTS, CELLS).save("part.off")
        said = []
        smg.open("part.off").solve(**PROBLEM, progress=said.append)
        self.assertEqual(said, sorted(said))


class CancelTest(unittest.TestCase):
    def test_what_a_progress_function_raises_is_raised(self):
        class Enough(Exception):
            pass

        def enough(done):
            if done > 0.3:
                raise Enough

        mesh = smg.mesh(POINTS, CELLS)
        for call in (
            lambda: mesh.solve(**PROBLEM, progress=enough),
            lambda: mesh.smooth(progress=enough),
            lambda: mesh.deform([smg.handle([0], fixed=True), smg.handle([9], target=[0, 0, 9])],
                                progress=enough),
            lambda: mesh.distance([0], progress=enough),
            lambda: mesh.save("cancelled.vtu", progress=enough),
            lambda: mesh.solver(**PROBLEM, progress=enough),
            lambda: mesh.info(full=True, progress=enough),
            lambda: mesh.simplify(9, progress=enough),
            lambda: mesh.select(smg.boundary, progress=enough),
        ):  # fmt: skip
            self.assertRaises(Enough, call)
        self.assertFalse(os.path.exists("cancelled.vtu"))
        u = mesh.solve(**PROBLEM)  # it can be used as before
        self.assertEqual(bits(u.to_numpy()), bits(smg.solve(POINTS, CELLS, **PROBLEM)))

    def test_interrupt(self):
        mesh = smg.mesh(POINTS, CELLS)
        before = signal.getsignal(signal.SIGINT)
        said = []

        def interrupt(done):
            if not said:
                signal.raise_signal(signal.SIGINT)
            said.append(done)

        self.assertRaises(KeyboardInterrupt, mesh.solve, **PROBLEM, progress=interrupt)
        self.assertLess(len(said), 5)
        self.assertIs(signal.getsignal(signal.SIGINT), before)

    def test_interrupt_from_outside(self):
        """Without any progress function, at any time; what was there before still works."""
        mesh = smg.mesh(POINTS, CELLS)
        for _ in range(20):
            # A thread that goes has finalizers of its own, where Python loses the interrupt.
            interrupter = threading.Thread(target=_thread.interrupt_main)
            with self.assertRaises(KeyboardInterrupt):
                interrupter.start()
                while True:
                    mesh.solve(**PROBLEM)
            interrupter.join()
        mesh.solve(**PROBLEM)

    def test_interrupt_where_a_lock_is_left(self):
        """There is no step of Python at which it could stay taken."""

        def interrupt(frame, event, _):
            if event == "call" and frame.f_code.co_name == "__exit__":
                raise KeyboardInterrupt

        lock = HandleLock()
        sys.setprofile(interrupt)
        try:
            with lock:
                pass
        except KeyboardInterrupt:
            pass
        finally:
            sys.setprofile(None)
        free = []
        thread = threading.Thread(target=lambda: free.append(lock.is_free()))
        thread.start()
        thread.join()
        self.assertEqual(free, [True])

    def test_interrupt_while_something_is_closed(self):
        """What goes in the same moment is closed and removed all the same, and the interrupt is not lost."""
        with tempfile.TemporaryDirectory() as scratch:
            mesh = smg.mesh(POINTS, CELLS, scratch=scratch)
            going = [mesh.solve(**PROBLEM), mesh.simplify(500), closing(_thread.interrupt_main)]
            del mesh
            self.assertEqual(going[1].n_corners, 3)
            self.assertNotEqual(os.listdir(scratch), [])
            with self.assertRaises(KeyboardInterrupt):
                going.clear()  # from the last to the first
            self.assertEqual(os.listdir(scratch), [])

    def test_a_handler_of_the_program_is_used(self):
        mesh = smg.mesh(POINTS, CELLS)
        called = []
        before = signal.signal(signal.SIGINT, lambda *arguments: called.append(arguments[0]))
        try:
            mesh.solve(**PROBLEM, progress=lambda done: called or signal.raise_signal(signal.SIGINT))
        finally:
            signal.signal(signal.SIGINT, before)
        self.assertEqual(called, [signal.SIGINT])

    def test_what_the_handler_of_a_timer_raises_is_raised(self):
        """At any time, not only while a progress function runs."""

        class TooLong(Exception):
            pass

        def end(*_):
            raise TooLong

        mesh = smg.mesh(POINTS, CELLS)
        before = signal.signal(signal.SIGALRM, end)
        try:
            for delay in np.geomspace(1e-4, 0.1, 20):
                with self.assertRaises(TooLong):
                    signal.setitimer(signal.ITIMER_REAL, delay)
                    while True:
                        mesh.solve(**PROBLEM)
            self.assertIs(signal.getsignal(signal.SIGALRM), end)
        finally:
            signal.signal(signal.SIGALRM, before)


class ThreadsTest(unittest.TestCase):
    def test_python_runs_during_a_call(self):
        """Another thread gets turns, though none is taken from a thread that runs Python."""
        mesh = smg.mesh(POINTS, CELLS)
        turns, ended = [], threading.Event()

        def count():
            while not ended.is_set():
                turns.append(1)
                time.sleep(0)

        counter = threading.Thread(target=count)
        interval = sys.getswitchinterval()
        counter.start()
        try:
            sys.setswitchinterval(1e6)
            before = len(turns)
            mesh.solve(**PROBLEM)
            during = len(turns) - before
        finally:
            sys.setswitchinterval(interval)
            ended.set()
            counter.join()
        self.assertGreater(during, 0)

    def test_jobs_on_different_meshes_run_at_once(self):
        """Each waits in its progress function for the other."""
        meeting = threading.Barrier(2)

        def solve(i):
            met = []

            def meet(done):
                if not met:
                    met.append(meeting.wait(60))

            mesh = smg.mesh(POINTS, CELLS)
            found[i] = bits(mesh.solve(dirichlet={0: 0.0, i + 1: 1.0}, progress=meet).to_numpy())

        found = [None] * 2
        threads = [threading.Thread(target=solve, args=(i,)) for i in range(2)]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        mesh = smg.mesh(POINTS, CELLS)
        self.assertEqual(found, [bits(mesh.solve(dirichlet={0: 0.0, i: 1.0}).to_numpy()) for i in (1, 2)])

    def test_threads_share_a_mesh(self):
        """Its jobs take turns, and do not disturb each other."""
        mesh = smg.mesh(POINTS, CELLS)
        expected = [bits(mesh.solve(dirichlet={0: 0.0, i: 1.0}).to_numpy()) for i in range(1, 5)]
        found = [None] * 4

        def solve(i):
            found[i - 1] = bits(mesh.solve(dirichlet={0: 0.0, i: 1.0}).to_numpy())

        threads = [threading.Thread(target=solve, args=(i,)) for i in range(1, 5)]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        self.assertEqual(found, expected)


class ScratchTest(unittest.TestCase):
    def test_a_progress_function_cannot_use_what_is_in_use(self):
        mesh = smg.mesh(POINTS, CELLS)
        for use in (lambda _: mesh.n_vertices, lambda _: mesh.close(), lambda _: mesh.info()):
            with self.assertRaisesRegex(smg.Error, "progress function"):
                mesh.smooth(progress=use)
        opened = smg.open(BUNNY)
        with self.assertRaisesRegex(smg.Error, "progress function"):
            opened.solve(dirichlet={0: 0}, progress=lambda _: opened.n_cells)
        self.assertEqual(mesh.smooth().shape, POINTS.shape)

    def test_nothing_is_left(self):
        with tempfile.TemporaryDirectory() as scratch:
            mesh = smg.mesh(POINTS, CELLS, scratch=scratch)
            u = mesh.solve(**PROBLEM)
            small = mesh.simplify(500)
            self.assertEqual(small.n_corners, 3)
            self.assertEqual(u.shape, (len(POINTS),))
            del mesh, u, small
            gc.collect()
            self.assertEqual(os.listdir(scratch), [])

    def test_memory_of_repeated_jobs(self):
        """The arrays of a job go with its field."""
        mesh = smg.mesh(POINTS, CELLS)
        source = POINTS[:, 2].copy()
        gone = weakref.ref(source)
        u = mesh.solve(source=source, dirichlet={0: 0.0})
        del source
        gc.collect()
        self.assertIsNotNone(gone())
        np.testing.assert_array_equal(u.report["conditions"][0]["vertices"], 1)
        del u
        gc.collect()
        self.assertIsNone(gone())


unittest.main(verbosity=2)
