#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""A power cut after each call of a command that changes files: what may be on the disk then
(power_cut.py) is made anew, and the command is run again. The result must be the file that was there
before or the whole new one, before and after; the checkpoint is continued from the last state that was
durable; nothing remains. Prints a row of the table of docs/reliability.md for each command.

usage: smg_power_cut.py [all | COMMAND ...]
  without an argument: a sample of the cuts of each command; all: each cut, with more states of each
"""

import json
import multiprocessing
import os
import random
import re
import shutil
import struct
import subprocess
import sys

import smg_faults
from power_cut import Disk, digest, flat, read_record, write_tree
from program import SMG, write_torus

OLD = smg_faults.OLD
NONE = smg_faults.NONE
DISK = "disk"
CHECKPOINT = DISK + "/checkpoint"
OUT = DISK + "/out.vsm"
REPORT = DISK + "/report.json"
SCRATCH = DISK + "/scratch"
CUTS = 45  # of a command in each build
FOUND = re.compile(r"found a checkpoint after (?:pass|stage) (\d+) in")
# Of a complete state, see Solver/Checkpoint/Checkpoint.h: its steps are at byte 16.
STATE = struct.Struct("=16xq")


def commands():
    streamed = ("--core-nodes", "100", "--block-nodes", "200", "--threads", "1")
    solve = ("solve", "torus.vsm", OUT, "--problem", "problem.json", *streamed)
    return {
        "convert": ("convert", "torus.obj", OUT, "--order", "spectral"),
        "solve": (*solve, "--report", REPORT, "--max-cycles", "3", "--tolerance", "1e-2"),
        "solve of .obj": ("solve", "torus.obj", *solve[2:], "--tolerance", "1e-1"),
        "deform": ("deform", "torus.vsm", OUT, "--handles", "handles.json", "--cycles", "2", *streamed),
    }


class Case:
    """A command, the record of its calls, and its result."""

    def __init__(self, name, continues):
        self.name = name + (", continued" if continues else "")
        self.arguments = [*commands()[name], "--checkpoint", CHECKPOINT]
        self.begins_from(continues)
        before = flat(DISK)
        self.record("record")
        self.calls = list(read_record("record"))
        self.disk = Disk(DISK)
        self.wanted = smg_faults.read(OUT)
        self.check_record(before)
        write_tree(DISK, before)
        self.disk = Disk(DISK)
        self.failed = []  # the numbers of states, and why
        self.counts = dict.fromkeys(("old", "new", "anew", "continued", "refused"), 0)

    def record(self, name):
        environment = dict(os.environ, LD_PRELOAD=os.environ["SMG_RECORDER_LIBRARY"], SMG_RECORD=name)
        done = subprocess.run([SMG, *self.arguments, "--scratch", SCRATCH], env=environment,
                              capture_output=True, text=True, timeout=1200)
        assert done.returncode == 0, (self.name, done.stderr)

    def begins_from(self, continues):
        """Files without a result and without a checkpoint, or with an old result and a checkpoint that a
        kill has left."""
        shutil.rmtree(DISK, ignore_errors=True)
        os.makedirs(SCRATCH)
        if not continues:
            return
        with smg_faults.Program([*self.arguments, "--no-sync"], SCRATCH, ()) as program:
            _, _, calls = program.run(NONE)
            program.run("files %d once kill" % (calls * 3 // 5))
        assert os.path.exists(CHECKPOINT), self.name
        shutil.rmtree(SCRATCH)
        os.mkdir(SCRATCH)
        for name in (OUT, REPORT):
            with open(name, "wb") as file:
                file.write(OLD)

    def check_record(self, before):
        """Replaying the whole record makes the folders exactly: no call is missing."""
        after = flat(DISK)
        write_tree(DISK, before)
        replayed = Disk(DISK)
        for words, data in self.calls:
            replayed.call(words, data)
        assert digest(replayed.tree(list, lambda file: file.now())) == digest(after), (
            self.name, "the record is incomplete")

    def fail(self, place, *why):
        """Keeps the first state that fails, and its story."""
        folder = os.path.abspath("../failed-" + re.sub(r"\W+", "-", self.name))
        if not self.failed:
            os.makedirs(folder)
            write_tree(folder, self.tree)
        raise AssertionError("cut after call %d (%s), state %s: %s" % (
            place, self.calls[place - 1][0] if place else "none", folder, why))

    def walk(self, cuts, samples):
        """Cuts after so many calls at regular distances, the first and the last among them."""
        rng = random.Random(self.name)
        count = len(self.calls)
        places = {count - count * k // cuts for k in range(cuts + 1)}
        seen = set()
        with smg_faults.Program([*self.arguments, "--no-sync"], SCRATCH, ()) as program:
            for place in range(count + 1):
                if place > 0:
                    self.disk.call(*self.calls[place - 1])
                for tree in self.disk.states(rng, samples) if place in places else ():
                    key = digest(tree)
                    if key not in seen:
                        seen.add(key)
                        self.tree = tree
                        self.try_again(program, place, len(seen))
        assert not self.failed, "%s, %d of %d states, the first as number %d: %s" % (
            self.name, len(self.failed), len(seen), *self.failed[0])
        return "| `%s` | %d | %d | %s |" % (
            self.name, count, len(seen), " | ".join(str(n) for n in self.counts.values()))

    def try_again(self, program, place, number):
        try:
            self.run_again(program, place)
        except AssertionError as error:
            self.failed.append((number, error))

    def durable_steps(self):
        """Those of the last state that no power cut takes."""
        tree = self.disk.tree(lambda changes: [], lambda file: file.durable)
        kept = self.disk.tree(list, lambda file: file.durable)
        steps = 0
        for slot in "01":
            name = "checkpoint/state." + slot
            if kept.get(name) and tree.get(name) == kept[name]:
                steps = max(steps, STATE.unpack_from(tree[name])[0])
        return steps

    def run_again(self, program, place):
        write_tree(DISK, self.tree)
        os.makedirs(SCRATCH, exist_ok=True)  # the user's, and made before
        found = smg_faults.read(OUT) if os.path.exists(OUT) else None
        is_done = place == len(self.calls)
        if found not in ((self.wanted,) if is_done else (None, OLD, self.wanted)):
            self.fail(place, "the result is old or lost" if is_done else "the result is torn")
        self.check_report(place, is_done)
        self.counts["new" if found == self.wanted else "old"] += 1
        code, said, _ = program.run(NONE)
        steps = max(map(int, FOUND.findall(said)), default=0)
        if code == 1 and len(said.splitlines()) == 1 and "remove" in said:
            self.counts["refused"] += 1
            self.fail(place, "refused", said)
        if code != 0:
            self.fail(place, code, said)
        self.counts["continued" if steps else "anew"] += 1
        if steps < self.durable_steps():
            self.fail(place, "a durable state was lost", said)
        if smg_faults.read(OUT) != self.wanted:
            self.fail(place, "another result", said)
        self.check_report(place, True)
        left = set(flat(DISK)) - {"out.vsm", "scratch", "report.json"}
        if left:
            self.fail(place, "left", left)

    def check_report(self, place, is_done):
        """Reports have times: they are whole, or as before."""
        if REPORT not in self.arguments:
            if os.path.exists(REPORT):
                os.remove(REPORT)
            return
        try:
            text = smg_faults.read(REPORT)
            if is_done or text != OLD:
                json.loads(text)
        except (OSError, ValueError) as error:
            if is_done or not isinstance(error, FileNotFoundError):
                self.fail(place, "report", error)


def begin_worker():
    folder = "worker-%d" % os.getpid()
    os.mkdir(folder)
    os.chdir(folder)
    write_torus("torus.obj", 40, 25)
    smg_faults.convert("torus.obj", "torus.vsm")
    for name, content in (
            ("problem", {"dirichlet": [{"vertices": [0], "value": 0}, {"vertices": [999], "value": 1}]}),
            ("handles", {"handles": [
                {"region": {"vertices": [0, 1, 2]}, "fixed": True},
                {"region": {"vertices": [500, 501, 502]}, "translate": [0, 0, 0.5]}]})):
        with open(name + ".json", "w", encoding="utf-8") as file:
            json.dump(content, file)


def walk_case(case):
    """Returns a line, and whether it went as it must."""
    name, continues, cuts, samples = case
    try:
        return True, Case(name, continues).walk(cuts, samples)
    except AssertionError as error:
        return False, "FAILED: %s" % error


def main(arguments):
    for name in os.listdir("."):
        if name.startswith(("worker-", "failed-")):
            shutil.rmtree(name)
    is_all = arguments == ["all"]
    cuts, samples = (10 ** 6, 12) if is_all else (CUTS, 2)
    chosen = [(name, continues, cuts, samples) for name in commands() for continues in (False, True)
              if is_all or not arguments or name in arguments]
    with multiprocessing.Pool(os.cpu_count(), begin_worker) as pool:
        right = True
        for is_right, line in pool.imap(walk_case, chosen, 1):
            print(line, flush=True)
            right = right and is_right
    sys.exit(0 if right else 1)


if __name__ == "__main__":
    main(sys.argv[1:])
