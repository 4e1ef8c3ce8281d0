#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""The progress of smg: a bar on a terminal, lines in a file, by a clock that each look advances."""

import fcntl
import os
import pty
import re
import signal
import subprocess
import sys

from program import PROGRESS, SMG, write_torus


def convert(step, stderr, *options):
    """Converts with a clock that advances by `step` seconds with each look at it."""
    environment = dict(os.environ, LD_PRELOAD=os.environ["SMG_CLOCK_LIBRARY"],
                       SMG_CLOCK_STEP=str(step))
    return subprocess.Popen([SMG, "convert", "torus.obj", "torus.vsm", "--no-sync", *options],
                            stdout=subprocess.DEVNULL, stderr=stderr, env=environment)


def in_file(step, *options):
    with open("log", "w+", encoding="utf-8") as log:
        assert convert(step, log, *options).wait() == 0
        log.seek(0)
        return log.read().splitlines(keepends=True)


def test_lines_in_a_file():
    lines = in_file(10)
    assert len(lines) > 10 and all(re.fullmatch(PROGRESS, line) for line in lines), lines
    assert not any("\r" in line or "\033" in line for line in lines)
    done = [float(line.split()[2]) for line in lines]
    assert done == sorted(done) and 0 <= done[0] < 50 < done[-1] <= 100, done
    assert " s left" in lines[-1], lines[-1]
    assert 0 < len(in_file(1)) < len(lines) / 2, "not at each look"
    assert in_file(0) == [], "nothing in the first ten seconds"
    assert in_file(10, "--quiet") == []


def test_bar_on_a_terminal():
    master, terminal = pty.openpty()
    program = convert(10, terminal)
    os.close(terminal)
    shown = b""
    try:
        while part := os.read(master, 65536):
            shown += part
    except OSError:  # the end of a terminal
        pass
    os.close(master)
    assert program.wait() == 0
    assert shown.startswith(b"\rconverting [") and shown.endswith(b"\r\033[K"), shown
    assert b"\n" not in shown


def test_interrupts_while_drawing():
    """Of a report as a page: each command ends, and says whether its result is there."""
    write_torus("large.obj", 500, 200)
    subprocess.run([SMG, "convert", "large.obj", "large.vsm", "--no-sync", "--quiet"], check=True)
    environment = dict(os.environ, LD_PRELOAD=os.environ["SMG_CLOCK_LIBRARY"], SMG_CLOCK_STEP="10")
    for out, *command in ((None, "info", "large.vsm"),
                          ("out.vsm", "convert", "large.obj", "out.vsm"),
                          ("out.ply", "simplify", "large.vsm", "out.ply", "--vertices", "50000"),
                          ("out.ply", "preview", "large.vsm", "out.ply", "--points", "50000")):
        for old in {"page.html", out or "page.html"} & set(os.listdir()):
            os.remove(old)
        read, write = os.pipe()
        # The program waits for the reader, so that it is still drawing when it is interrupted.
        fcntl.fcntl(write, fcntl.F_SETPIPE_SZ, 4096)
        program = subprocess.Popen([SMG, *command, "--report", "page.html"], stdout=subprocess.DEVNULL,
                                   stderr=write, env=environment)
        os.close(write)
        with open(read, encoding="utf-8") as log:
            line = next(line for line in log if line.startswith("smg: drawing"))
            program.send_signal(signal.SIGINT)
            rest = log.read()
        assert program.wait() == 130 and rest.endswith("smg: cancelled\n"), (command, line, rest[-300:])
        assert not os.path.exists("page.html"), command
        assert (out is not None) == (f"smg: {out} is written, its report is not\n" in rest), (command, rest[-300:])
        assert out is None or os.path.exists(out), command


def main():
    if not os.environ.get("SMG_CLOCK_LIBRARY"):
        sys.exit(77)
    write_torus("torus.obj", 60, 30)
    test_lines_in_a_file()
    test_bar_on_a_terminal()
    test_interrupts_while_drawing()


if __name__ == "__main__":
    main()
