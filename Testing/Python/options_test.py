# SPDX-License-Identifier: BSD-3-Clause
"""Every option of every job is the same in every door, as the table of the job in the library says: on the
command line and in JSON with the same refusals, in signatures, docstrings and documents, and as a property
in ParaView."""

import glob
import inspect
import os
import re
import subprocess
import unittest

import option_tables
from streamingmultigrid import _options as options
from testing import SOURCE, smg

SMG = os.environ["SMG_PROGRAM"]
JOBS = options.described()
#: What a command needs besides the option at hand, and the same as arguments.
NEEDED = {
    "solve": (["--problem", "p.json"], {"source": 1.0}),
    "deform": (["--handles", "h.json"], {"handles": smg.handle(smg.boundary, fixed=True)}),
    "smooth": ([], {}),
    "blend": (["--patch", "p", "--columns", "c"], {"columns": "c", "patch": "p"}),
    "distance": (["--from", '{"boundary": true}'], {"sources": smg.boundary}),
    "area": ([], {}),
    "simplify": (["--vertices", "10"], {"vertices": 10}),
}
#: Without a property that comes from the table.
WITHOUT_PROPERTY = {
    "problem": "a file, a text, arrays and Mesh Conditions", "handles": "Mesh Handles", "size": "a number and its unit",
    "memory": "in MiB", "scratch_limit": "in MiB", "in_core": "of Streaming Poisson alone", "text": "of writers",
    "orient": "pieces keep their cells as they are",
}  # fmt: skip


def wrong_values(option):
    """Values that the option cannot have, for Python and as texts."""
    kind = option["kind"]
    if kind == "number":
        ends = [float(each) for each in re.findall(r"-?[0-9.]+", option.get("allowed", ""))]
        is_open = "at least" not in option["allowed"]
        return [(ends[0] if is_open else ends[0] - 1), *ends[1:]]
    if kind == "count":
        least, most = (int(each.replace(",", "")) for each in re.findall(r"[0-9,]+", option["allowed"]))
        return [least - 1, most + 1, least + 0.5]
    return {"choice": ["nonsense"], "size": ["-1", "3miles"], "column": [], "where": [{"nowhere": 1}]}.get(kind, [])


def sentence(text, name):
    """What an error says of an option of this name, without the place before and the advice after it."""
    text = re.sub(r"\s*\(smg \w+ --help explains the usage\)\s*$", "", text.strip())
    found = re.search(r"%s(?:\[\d+\])?: (.*)$" % re.escape(name), text)
    return (found[1] if found else "?? " + text).rstrip(".")


class OptionsTest(unittest.TestCase):
    def for_all(self, check):
        """Calls `check` with each job and option."""
        for job, rows in JOBS.items():
            for option in rows:
                with self.subTest(job=job, option=option["key"]):
                    check(job, option)

    def test_there_are_all_jobs(self):
        self.assertEqual(set(JOBS), set(NEEDED))
        self.assertGreater(sum(len(rows) for rows in JOBS.values()), 60)

    def test_the_command_line_has_them(self):
        helps = {
            job: subprocess.run([SMG, job, "--help"], capture_output=True, text=True, check=True).stdout
            for job in JOBS
        }
        def check(job, option):
            self.assertIn(option_tables.flag(option), helps[job])
            if not option.get("common") and option["kind"] != "description":
                self.assertIn(option["help"], re.sub(r"\s+", " ", helps[job]))

        self.for_all(check)

    def test_the_command_line_and_json_refuse_the_same(self):
        refused = []
        mesh = smg.mesh([[0, 0, 0], [1, 0, 0], [0, 1, 0]], [[0, 1, 2]])
        def check(job, option):
            if option.get("common"):
                return
            flags, arguments = NEEDED[job]
            name = options.name_of(option)
            for value in wrong_values(option):
                is_where = option["kind"] == "where"
                text = '{"nowhere": 1}' if is_where else str(value)
                without = [each for each in flags if option["excludes"] != each] if "excludes" in option else flags
                done = subprocess.run(
                    [SMG, job, "a.ply", "b.ply", *without, option_tables.flag(option), text],
                    capture_output=True,
                    text=True,
                )
                self.assertEqual(done.returncode, 2, done.stderr)
                said = sentence(done.stderr, option_tables.flag(option))
                if is_where:  # regions of Python cannot be wrong in this way
                    self.assertIn("is not known here", said)
                    continue
                with self.assertRaises(smg.InputError) as raised:
                    mesh.estimate(job, **{**arguments, name: value})
                if job != "distance" or name != "within":  # Python says the value
                    self.assertEqual(said, sentence(str(raised.exception), name))
                refused.append(value)

        self.for_all(check)
        self.assertGreater(len(refused), 40)

    def test_python_has_them(self):
        def check(job, option):
            if option["key"] == "text":  # where results are saved
                return
            name = options.name_of(option)
            parameters = inspect.signature(getattr(smg.Mesh, job)).parameters
            self.assertIn(name, parameters)
            if job != "simplify":
                document = re.sub(r"\s+", " ", getattr(smg.Mesh, job).__doc__)
                text = "" if option["kind"] == "description" else re.sub(r"\s+", " ", option["help"])
                self.assertIn("%s: %s" % (name, text), document)

        self.for_all(check)

    def test_documents_have_them(self):
        for path in option_tables.DOCUMENTS.values():
            with open(path, encoding="utf-8") as file:
                text = file.read()
            self.assertIn("<!-- options ", text)
            self.assertEqual(text, option_tables.completed(text), "run Testing/Python/option_tables.py")

    def test_paraview_has_them(self):
        found = {("simplify", "checkpoint")}  # a simplification in ParaView has none
        for path in glob.glob(os.path.join(SOURCE, "ParaViewPlugin", "StreamingMultigrid", "*.xml")):
            with open(path, encoding="utf-8") as file:
                found.update(re.findall(r'<Option job="(\w+)" key="(\w+)"', file.read()))

        def check(job, option):
            key = option["key"]
            is_of_all = option.get("common") and ("solve", key) in found
            self.assertTrue((job, key) in found or is_of_all or key in WITHOUT_PROPERTY)

        self.for_all(check)


if __name__ == "__main__":
    unittest.main()
