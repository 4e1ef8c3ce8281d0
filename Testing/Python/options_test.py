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
from testing import SOURCE, smg, write_json

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


#: What is none of a kind, in Python.
OTHERS = {
    "number": ["wide", [1], True, {}], "count": ["two", 1.5, True, [1]], "bytes": ["1furlong", -1, [1]],
    "flag": ["yes", 1, [True]], "choice": ["nonsense", 1, True], "column": ["", 7, {}], "columns": ["", 7, [""], []],
    "where": [7.5, [], {"sphere": 1}], "size": ["3miles", -1, [1], True], "folder": [7, "", [1]],
    "description": [7, ["x"]],
}  # fmt: skip


#: The same as texts of the command line.
TEXTS = {
    "number": ["nan", "inf", "1x", ""], "count": ["1.5", "x", ""], "bytes": ["1furlong", ""], "choice": ["", "0"],
    "size": ["0", "nan", "inf", "1km", "%", "edges", ""], "column": [""], "columns": ["", ",", "a,,b", "a,"],
    "where": ["{", ""], "folder": [""],
}  # fmt: skip


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
                said = sentence(self.refusal(job, *flags, option_tables.flag(option), text), option_tables.flag(option))
                if is_where:  # regions of Python cannot be wrong in this way
                    self.assertIn("is not known here", said)
                    continue
                with self.assertRaises(smg.InputError) as raised:
                    mesh.estimate(job, **{**arguments, name: value})
                self.assertEqual(said, sentence(str(raised.exception), name))
                refused.append(value)

        self.for_all(check)
        self.assertGreater(len(refused), 40)

    def refusal(self, job, *flags):
        """What the command line says of a wrong usage."""
        done = subprocess.run([SMG, job, "a.ply", "b.ply", *flags], capture_output=True, text=True)
        self.assertEqual(done.returncode, 2, done.stdout + done.stderr)
        return done.stderr

    def test_values_of_another_kind_are_refused(self):
        """With a sentence on the option, not an error of Python's own."""
        mesh = smg.mesh([[0, 0, 0], [1, 0, 0], [0, 1, 0]], [[0, 1, 2]])
        def check(job, option):
            name = options.name_of(option)
            if option["key"] == "text":  # where results are saved
                return
            for value in OTHERS[option["kind"]]:
                with self.subTest(value=value), self.assertRaisesRegex(smg.InputError, r"\b%s\b" % name):
                    mesh.estimate(job, **{**NEEDED[job][1], name: value})
            for text in TEXTS.get(option["kind"], []):
                said = self.refusal(job, *NEEDED[job][0], option_tables.flag(option), text)
                self.assertIn(option_tables.flag(option), said)

        self.for_all(check)

    def test_what_is_without_effect_beside_another_option_is_refused(self):
        mesh = smg.mesh([[0, 0, 0], [1, 0, 0], [0, 1, 0]], [[0, 1, 2]])
        good = {"number": 0.5, "count": 7, "flag": True, "column": "c", "where": smg.boundary}
        pairs = []
        def check(job, option):
            for other in option.get("excludes", ()):
                rows = [option, next(row for row in JOBS[job] if row["key"] == other)]
                values = [good.get(row["kind"], row.get("choices", [None])[-1]) for row in rows]
                names = [options.name_of(row) for row in rows]
                arguments = {**NEEDED[job][1], **dict(zip(names, values))}
                with self.assertRaisesRegex(smg.InputError, "%s: does not go with %s" % tuple(names)):
                    mesh.estimate(job, **arguments)
                flags = [
                    word
                    for row, value in zip(rows, values)
                    for word in [option_tables.flag(row)]
                    + ([] if value is True else ['{"boundary": true}' if row["kind"] == "where" else str(value)])
                ]
                said = self.refusal(job, *NEEDED[job][0], *flags)
                self.assertTrue(all(option_tables.flag(row) in said for row in rows), said)
                pairs.append(names)

        self.for_all(check)
        self.assertGreater(len(pairs), 8)

    def test_estimates_refuse_what_the_mesh_does_not_have(self):
        """On the command line as in Python, before anything is computed."""
        meshes = {
            "surface": smg.mesh([[0, 0, 0], [1, 0, 0], [0, 1, 0]], [[0, 1, 2]]),
            "solid": smg.mesh([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]], [[0, 1, 2, 3]]),
        }
        tag = '{"tag": ["x", 1]}'
        write_json("p.json", {"source": "x"})
        write_json("h.json", {"handles": [{"region": {"tag": ["x", 1]}, "fixed": True}]})
        for kind, job, arguments, flags in (
            ("surface", "solve", {"source": "x"}, ["--problem", "p.json"]),
            ("surface", "deform", {"handles": smg.handle(smg.tag("x", 1), fixed=True)}, ["--handles", "h.json"]),
            ("surface", "smooth", {"column": "x"}, ["--column", "x"]),
            ("surface", "smooth", {"hold": smg.tag("x", 1)}, ["--hold", tag]),
            ("surface", "blend", {"columns": "x", "patch": "x"}, ["--columns", "x", "--patch", "x"]),
            ("surface", "distance", {"sources": smg.tag("x", 1)}, ["--from", tag]),
            ("surface", "area", {"tag": "x"}, ["--tag", "x"]),
            ("surface", "distance", {"wall": True}, ["--wall"]),
            ("solid", "smooth", {}, []),
            ("solid", "area", {"share": "voronoi"}, ["--share", "voronoi"]),
        ):
            with self.subTest(job=job, flags=flags):
                with self.assertRaises(smg.InputError) as raised:
                    meshes[kind].estimate(job, **arguments)
                self.assertRegex(str(raised.exception), "'x'|tetrahedr")
                meshes[kind].save(kind + ".vsm")
                done = subprocess.run([SMG, job, kind + ".vsm", "b.vsm", *flags, "--dry-run"], capture_output=True, text=True)
                self.assertEqual(done.returncode, 1, done.stdout + done.stderr)
                self.assertRegex(done.stderr, "'x'|tetrahedr")

    def test_python_has_them(self):
        def check(job, option):
            if option["key"] == "text":  # where results are saved
                return
            name = options.name_of(option)
            parameters = inspect.signature(getattr(smg.Mesh, job)).parameters
            self.assertIn(name, parameters)
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
        self.assertEqual(set(option_tables.MEMBERS), set(options.entries_of("report")), "ReportFields.h lists them")

    def test_paraview_has_them(self):
        found = {("simplify", "checkpoint")}  # a simplification in ParaView has none
        with open(os.path.join(SOURCE, "ParaViewPlugin", "Tables", "Parts.xml"), encoding="utf-8") as file:
            parts = file.read()
        texts = [parts]
        for path in glob.glob(os.path.join(SOURCE, "ParaViewPlugin", "StreamingMultigrid", "*.xml")):
            with open(path, encoding="utf-8") as file:
                texts.append(file.read())
        of_parts = re.findall(r'<Option job="\{job\}" key="(\w+)"', parts)
        for text in texts:
            found.update(re.findall(r'<Option job="(\w+)" key="(\w+)"', text))
            found.update((job, key) for job in re.findall(r'<Part name="\w+" job="(\w+)"', text) for key in of_parts)

        def check(job, option):
            key = option["key"]
            is_of_all = option.get("common") and ("solve", key) in found
            self.assertTrue((job, key) in found or is_of_all or key in WITHOUT_PROPERTY)

        self.for_all(check)

    def test_contributing_lists_the_files_of_a_job(self):
        def text(path):
            with open(os.path.join(SOURCE, path), encoding="utf-8") as file:
                return file.read()

        section = re.search(r"\n## Adding a job\n.*?\n6\. [^\n]*", text("CONTRIBUTING.md"), re.S)[0]
        listed = {path for path in re.findall(r"`([\w/.]+\.\w+)`", section) if re.search(r"area|Report|Jobs\.cpp|_jobs", path, re.I)}
        self.assertEqual(len(listed), 12)
        knows = re.compile(r"AreaJob|Report::Areas?\b|struct Areas|MeshArea\b|smg/Area\.h|AreaDescription|\b_area\b")
        found = {"docs/area.md"}
        for folder in ("Solver", "IO", "Filters", "ParaViewPlugin", "Python", "Examples/smg"):
            for parent, _, names in os.walk(os.path.join(SOURCE, folder)):
                for name in names:
                    path = os.path.relpath(os.path.join(parent, name), SOURCE)
                    if name.endswith((".h", ".cpp", ".cxx", ".py", ".xml")) and knows.search(text(path)):
                        found.add(path)
        self.assertEqual(found, listed)


if __name__ == "__main__":
    unittest.main()
