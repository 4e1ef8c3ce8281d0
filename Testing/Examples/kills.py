# SPDX-License-Identifier: BSD-3-Clause
"""Kills smg with a checkpoint and runs it again, for the scripts of this folder."""

import os
import shutil
import signal
import struct
import subprocess
import time

from program import SMG

FOLDER = "checkpoint"


def begin(arguments):
    """Starts smg with the checkpoint."""
    return subprocess.Popen([SMG, *map(str, arguments), "--checkpoint", FOLDER],
                            stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)


def again(arguments):
    """Runs smg with the checkpoint; returns its exit code and its errors."""
    process = begin(arguments)
    _, error = process.communicate(timeout=1200)
    return process.returncode, error


def state_steps():
    """The steps of each state of the checkpoint."""
    found = []
    for name in ("state.0", "state.1"):
        try:
            with open(os.path.join(FOLDER, name), "rb") as file:
                front = file.read(48)
            found.append(struct.unpack_from("=q", front, 16)[0])
        except OSError:
            pass
    return found


def steps():
    """The steps of the last state of the checkpoint; 0 if there is none."""
    return max(state_steps(), default=0)


def kill_after(arguments, least):
    """Kills smg as soon as the checkpoint has so many steps."""
    shutil.rmtree(FOLDER, ignore_errors=True)
    process = begin(arguments)
    while steps() < least and process.poll() is None:
        time.sleep(0.0005)
    process.kill()
    process.communicate(timeout=1200)
    assert process.returncode == -signal.SIGKILL, "it was faster than the kill"
    states = state_steps()
    assert len(states) == 1 or abs(states[0] - states[1]) == 1, "a pass was not saved"
    return steps()


def with_fault(arguments, fault):
    """Runs smg with the checkpoint and a fault; see Testing/Faults."""
    shutil.rmtree(FOLDER, ignore_errors=True)
    environment = dict(os.environ, ASAN_OPTIONS="verify_asan_link_order=0",
                       LD_PRELOAD=os.environ["SMG_FAULT_LIBRARY"], SMG_FAULT=fault,
                       SMG_FAULT_COUNT="count")
    return subprocess.run([SMG, *map(str, arguments), "--checkpoint", FOLDER], env=environment,
                          capture_output=True, text=True, timeout=1200)


def calls_of(arguments):
    """The number of calls to the system for files."""
    done = with_fault(arguments, "files 0 once kill")
    assert done.returncode == 0, done.stderr
    with open("count", encoding="ascii") as file:
        return int(file.read())


def kill_at(arguments, number):
    """Kills smg before such a call; threads make the number that of another call now and then."""
    done = with_fault(arguments, "files %d once kill" % number)
    assert done.returncode in (0, -signal.SIGKILL), done.stderr


def run_with_kills(arguments, delays):
    """Runs smg until it ends by itself, and kills it after the next of the delays, in seconds, each
    time. Returns the number of kills, and that of runs that continued from a state."""
    shutil.rmtree(FOLDER, ignore_errors=True)
    kills = resumed = 0
    while True:
        before = steps()
        for name in ("report.json", arguments[2]):
            if os.path.exists(name):
                os.remove(name)
        process = begin(arguments)
        try:
            _, error = process.communicate(timeout=next(delays))
        except subprocess.TimeoutExpired:
            process.kill()
            _, error = process.communicate(timeout=1200)
        said = any("found a checkpoint after %s %d in" % (step, before) in error for step in ("pass", "stage"))
        assert said == (before > 0 and error != ""), (before, error)
        resumed += said
        if process.returncode == 0:
            assert not os.path.exists(FOLDER), os.listdir(FOLDER)
            left = [name for name in os.listdir(".") if ".part-" in name]
            assert not left, left
            return kills, resumed
        assert process.returncode == -signal.SIGKILL, (process.returncode, error)
        # The checkpoint goes when the result and its report are complete, that of a conversion with
        # the result.
        complete = arguments[2] if arguments[0] == "convert" else "report.json"
        assert steps() >= before or os.path.exists(complete), "a pass was lost"
        kills += 1
