#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""The progress of smg: a bar on a terminal, lines in a file, by a clock that each look advances."""

import os
import pty
import re
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


def main():
    if not os.environ.get("SMG_CLOCK_LIBRARY"):
        sys.exit(77)
    write_torus("torus.obj", 60, 30)
    test_lines_in_a_file()
    test_bar_on_a_terminal()


if __name__ == "__main__":
    main()
