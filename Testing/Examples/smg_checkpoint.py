#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""smg solve, smg deform and smg convert with --checkpoint: killed at any moment and run again, they have
the bits of a run that was never killed; a checkpoint that does not fit is refused.

smg_checkpoint.py [all]: 20 kills at random times and 20 at calls of the system, or 200 and each."""

import json
import os
import random
import shutil
import signal
import subprocess
import sys

from kills import FOLDER, again, begin, calls_of, kill_after, kill_at, run_with_kills, steps
from odd_mesh import odd_solid
from program import SMG, load, run, write_medit, write_torus
from small_disk import SmallDisk, can_mount

RANDOM = random.Random(7)
# Small meshes whose levels are on disk all the same.
STREAMED = ("--core-nodes", 100, "--block-nodes", 200)


def write_problem(name, **problem):
    with open(name, "w", encoding="utf-8") as file:
        json.dump(problem, file)


def read(name):
    with open(name, "rb") as file:
        return file.read()


def prepare():
    write_torus("torus.obj", 120, 80)
    run("convert", "torus.obj", "torus.vsm", "--quiet")
    write_medit("solid.mesh", *odd_solid(20))
    run("convert", "solid.mesh", "solid.vsm", "--quiet")
    for mesh, low, high in (("torus", -2.5, 2.5), ("solid", 1, 18)):
        write_problem(mesh + "_held.json", columns=3, dirichlet=[
            {"halfspace": [1, 0, 0, high], "value": "position"},
            {"halfspace": [-1, 0, 0, -low], "value": [0, 1, 2]}])
        write_problem(mesh + "_free.json", columns=2, source=[
            {"value": [0, 0]}, {"halfspace": [0, 1, 0, high], "value": [1, -2]}])
    with open("handles.json", "w", encoding="utf-8") as file:
        json.dump({"handles": [
            {"region": {"halfspace": [-1, 0, 0, 2.5]}, "fixed": True},
            {"region": {"halfspace": [1, 0, 0, 2.5]}, "translate": [0, 0, 1],
             "rotate": {"axis": [0, 0, 1], "degrees": 40, "center": [3, 0, 0]}}]}, file)


def solve(mesh, problem, *options):
    return ("solve", mesh, "out.vsm", "--problem", problem, "--report", "report.json",
            "--tolerance", 1e-9, *STREAMED, *options)


def deform(mesh, *options):
    return ("deform", mesh, "out.vsm", "--handles", "handles.json", "--report", "report.json",
            *STREAMED, *options)


def convert(mesh, *options):
    return ("convert", mesh, "out.vsm", "--report", "report.json", *options)


CASES = (solve("torus.vsm", "torus_held.json"),
         solve("torus.vsm", "torus_free.json", "--acceleration", "cg"),
         solve("torus.obj", "torus_held.json", "--acceleration", "none", "--threads", 2),
         solve("solid.vsm", "solid_held.json", "--acceleration", "cg"),
         solve("solid.vsm", "solid_free.json", "--acceleration", "chebyshev", "--sweeps", 1),
         deform("torus.vsm", "--tolerance", 1e-9),
         deform("torus.obj", "--cycles", 4),
         convert("torus.obj", "--order", "spectral"),
         convert("solid.mesh", "--weld", 0))
HELD, FREE = CASES[:2]


def never_killed(arguments):
    """The result without a checkpoint: the bits of the mesh, and the report; and seconds."""
    run(*arguments)
    return read("out.vsm"), load("report.json")


def check_equal(arguments, bits, report):
    assert read("out.vsm") == bits, arguments
    told = load("report.json")
    for key in ("passes", "cycles", "steps", "residuals", "levels", "acceleration", "converged",
                "components", "free_components", "removed_source", "balance", "energy", "vertices",
                "cells", "width", "isolated_vertices", "merged_points"):
        ours, theirs = told.get(key), report.get(key)
        if key == "levels":  # a window that was loaded may have more room than one that grew
            ours, theirs = ([{**level, "window": 0} for level in levels] for levels in (ours or (), theirs or ()))
        assert ours == theirs, (arguments, key, ours, theirs)
    if told.get("resumed_passes", 0) > 0:
        assert any(note.startswith("continued after pass") for note in told["notes"])


def delays(seconds):
    """Random times in a run of so many seconds; they grow, since the machine may be slower now."""
    longest = 1.2 * seconds
    while True:
        yield RANDOM.uniform(0.0, longest)
        longest *= 1.1


def test_kills(least):
    """At random times until so many kills are done: the same bits, and no pass is lost."""
    expected = {case: never_killed(case) for case in CASES}
    kills = resumed = 0
    while kills < least:
        for case in CASES:
            bits, report = expected[case]
            assert case[0] == "convert" or (
                report["passes"] >= 7 and len(report["levels"]) >= 3), report
            more = run_with_kills(case, delays(report["seconds"]["total"]))
            kills += more[0]
            resumed += more[1]
            check_equal(case, bits, report)
    assert resumed > least / 4, (kills, resumed)
    print(kills, "kills,", resumed, "runs that continued")


def test_kills_at_calls(least):
    """At calls of the system from the first to the last, so many or all."""
    for case in (FREE, deform("torus.vsm", "--cycles", 2), CASES[-1]):
        bits, report = never_killed(case)
        calls = calls_of(case)
        step = max(1, 3 * calls // least)
        for number in range(1 + RANDOM.randrange(step), calls + 1, step):
            kill_at(case, number)
            code, error = again(case)
            assert code == 0, (number, error)
            check_equal(case, bits, report)
        print("killed at", calls // step, "of", calls, "calls")


def test_each_pass():
    """Killed after each pass; and once during the last run with the result almost written."""
    case = FREE
    bits, report = never_killed(case)
    for k in range(1, report["passes"] + 1):
        kill_after(case, k)
        code, error = again(case)
        assert code == 0 and "found a checkpoint after pass" in error, error
        check_equal(case, bits, report)
        assert load("report.json")["resumed_passes"] >= k


def test_others_are_refused():
    """Another mesh, problem or option: refused by name, and the checkpoint is as it was."""
    case = HELD
    bits, report = never_killed(case)
    kill_after(case, 3)
    write_problem("other.json", columns=3, dirichlet=[{"halfspace": [1, 0, 0, 0.8],
                                                       "value": "position"}])
    for word, other in (("mesh", solve("solid.vsm", "solid_held.json")),
                        ("problem", solve("torus.vsm", "other.json")),
                        ("sweeps", (*case, "--sweeps", 3)),
                        ("acceleration", (*case, "--acceleration", "chebyshev")),
                        ("V-cycles", (*case, "--max-cycles", 49)),
                        ("memory", (*case, "--memory", 200)),
                        ("tolerance", tuple(1e-8 if a == 1e-9 else a for a in case)),
                        ("core levels", tuple(101 if a == 100 else a for a in case))):
        before = steps()
        code, error = again((*other, "--quiet"))
        assert code == 1 and error.count("\n") == 1, error
        assert word in error and FOLDER in error and "remove the folder" in error, (word, error)
        assert steps() == before
    code, _ = again((*case, "--threads", 1))
    assert code == 0
    check_equal(case, bits, report)
    assert load("report.json")["resumed_passes"] >= 3


def damaged(name, place, change):
    path = os.path.join(FOLDER, name)
    size = os.path.getsize(path)
    with open(path, "r+b") as file:
        if change == "cut":
            file.truncate(int(place * size))
            return
        file.seek(min(size - 1, int(place * size)))
        byte = file.read(1)
        file.seek(-1, os.SEEK_CUR)
        file.write(bytes([byte[0] ^ 0x10]))


def test_damage():
    """Each file with a flipped bit or cut off, in several places: refused, or not needed."""
    case = FREE
    bits, report = never_killed(case)
    kill_after(case, 5)
    shutil.rmtree("kept", ignore_errors=True)
    shutil.copytree(FOLDER, "kept")
    states = ("state.0", "state.1")
    files = [(name,) for name in sorted(os.listdir("kept")) if os.path.getsize("kept/" + name) > 0]
    assert len(files) >= 10, files
    refused = 0
    for names in [states, *files]:
        for place, change in ((0, "flip"), (0.3, "flip"), (0.7, "flip"), (0.999, "flip"),
                              (0, "cut"), (0.5, "cut")):
            shutil.rmtree(FOLDER, ignore_errors=True)
            shutil.copytree("kept", FOLDER)
            for name in names:
                damaged(name, place, change)
            code, error = again((*case, "--quiet"))
            if code == 0:
                assert names != states and "rows" not in names[0], (names, place, change)
                check_equal(case, bits, report)
                continue
            refused += 1
            assert code == 1 and error.count("\n") == 1, (names, place, change, code, error)
            assert "damaged" in error and "remove its folder" in error, error
    assert refused >= 30, refused


def test_conversion():
    """A conversion to another order, or with a damaged file, is refused."""
    case = CASES[-1]
    bits, report = never_killed(case)
    number = calls_of(case)
    while steps() == 0 and number > 0:  # from the end back to where there is a checkpoint
        number -= max(1, number // 20)
        kill_at(case, number)
    code, error = again((*case, "--order", "axis", "--quiet"))
    assert code == 1 and "another mesh file or option" in error, error
    shutil.rmtree("kept", ignore_errors=True)
    shutil.copytree(FOLDER, "kept")
    stages = [name for name in os.listdir("kept")
              if name.startswith("scratch.stage.") and os.path.getsize("kept/" + name) > 0]
    assert len(stages) >= 2, stages
    for name in stages:
        for place, change in ((0.3, "flip"), (0.5, "cut")):
            shutil.rmtree(FOLDER)
            shutil.copytree("kept", FOLDER)
            damaged(name, place, change)
            code, error = again((*case, "--quiet"))
            assert code == 1 and "damaged" in error and error.count("\n") == 1, (name, error)
    shutil.rmtree(FOLDER)
    shutil.copytree("kept", FOLDER)
    code, error = again(case)
    assert code == 0 and "found a checkpoint after stage" in error, error
    check_equal(case, bits, report)


def test_only_its_own():
    """What is not of the command stays: other files in the folder, the checkpoint of another command
    that is refused or fails."""
    os.makedirs(FOLDER)
    for case in (HELD, convert("torus.obj")):
        for other in (("out.vsm", FOLDER + "/out.vsm"), ("report.json", FOLDER + "/report.json")):
            code, error = again(tuple(other[1] if a == other[0] else a for a in case))
            assert code == 1 and "folder of the checkpoint" in error, error
    bits, report = never_killed(HELD)
    kill_after(HELD, 3)
    before = sorted(os.listdir(FOLDER))
    with open("broken.obj", "w", encoding="utf-8") as file:
        file.write("v 0 0 0\nf 1 2 3\n")
    for word, other in (("another mesh file", solve("broken.obj", "torus_held.json")),
                        ("another mesh file", solve("torus.obj", "torus_held.json")),
                        ("kind of computation", convert("torus.obj")),
                        ("no stages", convert("torus.vsm", "--order", "keep")),
                        ("no stages", ("convert", "torus.vsm", "out.obj", "--restore-order"))):
        code, error = again((*other, "--quiet"))
        assert code == 1 and word in error and error.count("\n") == 1, error
        assert sorted(os.listdir(FOLDER)) == before, other
    with open(FOLDER + "/notes.txt", "w", encoding="utf-8") as file:
        file.write("keep me")
    code, error = again((*HELD, "--quiet"))
    assert code == 0 and os.listdir(FOLDER) == ["notes.txt"], error
    check_equal(HELD, bits, report)
    shutil.rmtree(FOLDER)
    # And of a conversion in a solve.
    case = solve("torus.obj", "torus_held.json")
    bits, report = never_killed(case)
    kill_after(case, 2)
    before = sorted(os.listdir(FOLDER))
    for other in (HELD, convert("torus.obj")):
        code, error = again((*other, "--quiet"))
        assert code == 1 and "another mesh file" in error, error
        assert sorted(os.listdir(FOLDER)) == before, other
    code, error = again((*case, "--quiet"))
    assert code == 0 and not os.path.exists(FOLDER), error
    check_equal(case, bits, report)


def test_interrupted():
    """After Ctrl-C it says how to continue; the problem may come from another file of the same content;
    the limit of scratch files holds for a folder with a slash at its end."""
    bits, report = never_killed(HELD)
    shutil.rmtree(FOLDER, ignore_errors=True)
    process = begin(HELD)
    while steps() < 2 and process.poll() is None:
        pass
    process.send_signal(signal.SIGINT)
    _, error = process.communicate(timeout=1200)
    assert process.returncode == 128 + signal.SIGINT and "the same command continues" in error, error
    shutil.copy("torus_held.json", "copy.json")
    process = begin(tuple("copy.json" if a == "torus_held.json" else a for a in HELD))
    _, error = process.communicate(timeout=1200)
    assert process.returncode == 0, error
    check_equal(HELD, bits, report)
    assert load("report.json")["resumed_passes"] >= 2
    program = [SMG, *map(str, HELD), "--checkpoint"]
    for folder, options, code, word in ((FOLDER + "/", ["--scratch-limit", "1"], 1, "their limit is"),
                                        ("", [], 2, "is not a folder")):
        done = subprocess.run([*program, folder, *options], capture_output=True, text=True, timeout=1200)
        assert done.returncode == code and word in done.stderr, done.stderr
    shutil.rmtree(FOLDER, ignore_errors=True)


def test_in_use():
    """A second program with the same checkpoint is refused."""
    case = HELD
    bits, report = never_killed(case)
    first = begin(case)
    while steps() < 1 and first.poll() is None:
        pass
    first.send_signal(signal.SIGSTOP)
    code, error = again((*case, "--quiet"))
    assert code == 1 and "another program" in error and FOLDER in error, error
    first.send_signal(signal.SIGCONT)
    first.communicate(timeout=1200)
    assert first.returncode == 0
    check_equal(case, bits, report)


def test_folders():
    """A folder with other files is refused and not touched; so is a solve in core."""
    os.makedirs(FOLDER)
    with open(FOLDER + "/notes.txt", "w", encoding="utf-8") as file:
        file.write("keep me")
    case = HELD
    code, error = again((*case, "--quiet"))
    assert code == 1 and "neither empty" in error and os.listdir(FOLDER) == ["notes.txt"], error
    shutil.rmtree(FOLDER)
    os.makedirs(FOLDER)
    code, error = again((*case, "--in-core"))
    assert code == 1 and "in core" in error, error
    code, _ = again(case)
    assert code == 0 and not os.path.exists(FOLDER)
    # An error before the first state leaves nothing.
    code, error = again((*case, "--memory", 1))
    assert code == 1 and "memory" in error and not os.path.exists(FOLDER), error


def test_full_disk():
    """One error when the disk is full; with more room the next run continues."""
    case = HELD
    bits, report = never_killed(case)
    passed = 0
    for least in (1, 3):
        with SmallDisk("disk", 32 << 20) as disk:
            kill_after(case, least)
            shutil.copytree(FOLDER, os.path.join(disk, "ck"))
            shutil.rmtree(FOLDER)
            os.symlink(os.path.join(disk, "ck"), FOLDER)
            with open(os.path.join(disk, "filler"), "wb", buffering=0) as file:
                try:
                    while True:
                        file.write(bytes(4096))
                except OSError:
                    pass
            code, error = again((*case, "--quiet"))
            # Refused before it begins if the rest certainly does not fit.
            full = "space" in error or "there is room for" in error
            assert code == 0 or (code == 1 and full and error.count("\n") == 1), error
            passed += code
            os.remove(os.path.join(disk, "filler"))
            if code == 1:
                code, error = again(case)
                assert code == 0 and "found a checkpoint after" in error, error
            check_equal(case, bits, report)
            os.remove(FOLDER)
    assert passed > 0


for folder in (FOLDER, "kept"):  # remains of an earlier failed run
    if os.path.islink(folder):
        os.remove(folder)
    shutil.rmtree(folder, ignore_errors=True)
prepare()
ALL = sys.argv[1:] == ["all"]
test_kills(200 if ALL else 20)
test_kills_at_calls(1 << 30 if ALL else 20)
for each in (test_each_pass, test_others_are_refused, test_damage, test_conversion, test_only_its_own,
             test_interrupted, test_in_use, test_folders):
    each()
    print("passed", each.__name__, flush=True)
if can_mount():
    test_full_disk()
    print("passed test_full_disk")
sys.exit(0)
