#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""smg convert leaves no files when the disk is full, or when it is stopped or killed."""

import gzip
import os
import resource
import shutil
import signal
import subprocess
import sys
import time

from odd_mesh import odd_solid
from program import SMG, load, run, write_medit, write_torus
from small_disk import SmallDisk, can_mount, peak_of

ORDERS = ("bfs", "spectral", "axis", "keep")
MIB = 1 << 20


def listing(folder):
    return sorted(os.path.relpath(os.path.join(place, name), folder)
                  for place, folders, files in os.walk(folder) for name in folders + files)


def write_large():
    if not os.path.exists("large.obj"):
        write_torus("large.obj", 600, 400)


def read(name):
    with open(name, "rb") as file:
        return file.read()


def write_binary_ply(name, vertices, cells):
    """The header of a PLY file with these counts of vertices and cells, and zeros."""
    with open(name, "wb") as file:
        file.write(b"ply\nformat binary_little_endian 1.0\nelement vertex %d\nproperty float x\n"
                   b"property float y\nproperty float z\nelement face %d\n"
                   b"property list uchar int vertex_indices\nend_header\n" % (vertices, cells))
        file.truncate(file.tell() + 12 * vertices + 13 * cells)


def test_estimates():
    """Scratch files, output and memory are about as large as --dry-run predicts."""
    write_medit("solid.mesh", *odd_solid(14))
    write_large()
    run("convert", "large.obj", "large.vsm", "--quiet")
    run("convert", "large.vsm", "large.ply", "--restore-order", "--quiet")
    with open("large.ply", "rb") as plain, gzip.open("large.ply.gz", "wb", 1) as packed:
        packed.write(plain.read())
    for name, factor in (("large.ply", 2), ("large.vsm", 4), ("large.obj", 4), ("large.ply.gz", 4),
                         ("solid.mesh", 4)):
        shown = run("convert", name, "o.vsm", "--dry-run", "--report", "dry.json").stdout
        assert not os.path.exists("o.vsm")
        dry = load("dry.json")
        assert all(word in shown for word in ("vertices", "memory", "scratch", "output", "time"))
        with SmallDisk("disk", 256 * MIB) as disk:
            peak = peak_of(disk, lambda: run(
                "convert", name, "o.vsm", "--scratch", disk, "--quiet", "--report", "report.json"))
        report = load("report.json")
        assert dry["counted"] == (name in ("large.ply", "large.vsm")) and dry["memory_bytes"] == 256 * MIB
        assert report["pool_bytes_peak"] <= dry["memory_bytes"]
        for estimate, truth in (
                (dry["scratch_bytes"], peak), (dry["output_bytes"], os.path.getsize("o.vsm")),
                (dry["cells"], report["cells"])):
            # Polygons are counted before they become triangles.
            assert 1 / factor <= estimate / truth <= factor, (name, estimate, truth)
        os.remove("o.vsm")


def test_counts_of_off():
    """An OFF file begins with its counts, too."""
    with open("small.off", "w", encoding="utf-8") as file:
        file.write("OFF\n# a comment\n4 2 0\n0 0 0\n1 0 0\n0 1 0\n1 1 0\n3 0 1 2\n3 1 3 2\n")
    run("convert", "small.off", "o.vsm", "--dry-run", "--report", "dry.json")
    dry = load("dry.json")
    assert (dry["vertices"], dry["cells"], dry["counted"]) == (4, 2, True), dry


def test_full_scratch():
    """Refused before it begins if the file states its counts, otherwise as soon as they are known."""
    write_binary_ply("huge.ply", 1 << 20, 1 << 21)
    with SmallDisk("full", 4 * MIB) as disk:
        for name in ("large.obj", "large.vsm", "huge.ply"):
            for order in ORDERS[:3]:
                begin = time.monotonic()
                error = run("convert", name, "o.vsm", "--order", order, "--scratch", disk,
                            code=1).stderr
                assert disk in error, error
                if name != "large.obj":
                    assert "--scratch" in error and "MiB" in error, error
                    # A moment on an idle machine.
                    assert time.monotonic() - begin < 20
                else:
                    assert "space" in error or "room" in error, error
                assert os.listdir(disk) == [] and not os.path.exists("o.vsm")


def test_full_output():
    """One error that names the file, for every format, and nothing on the disk."""
    with SmallDisk("full", 2 * MIB) as disk:
        for out in ("o.vsm", "o.ply", "o.smb", "o.vtp"):
            path = os.path.join(disk, out)
            done = run("convert", "large.vsm", path, "--order", "keep", code=1)
            assert path in done.stderr and "space" in done.stderr, done.stderr
            assert os.listdir(disk) == [], os.listdir(disk)
        path = os.path.join(disk, "o.obj")
        done = run("convert", "large.vsm", path, "--restore-order", code=1)
        assert path in done.stderr and "space" in done.stderr, done.stderr
        assert os.listdir(disk) == [], os.listdir(disk)


def stopped(kind, delay, *arguments):
    """The exit code and the errors of a conversion that receives the signal `delay` seconds after creating
    its scratch folder."""
    before = listing("scratch")
    process = subprocess.Popen([SMG, "convert", *arguments], stdout=subprocess.PIPE,
                               stderr=subprocess.PIPE, text=True)
    while (not any(name.startswith("smg-scratch-") for name in set(listing("scratch")) - set(before))
           and process.poll() is None):
        time.sleep(0.001)
    time.sleep(delay)
    process.send_signal(kind)
    _, error = process.communicate(timeout=600)
    return process.returncode, error


def test_signals():
    """Nothing remains, whenever it is stopped, with every order and signal."""
    write_large()
    run("convert", "large.obj", "large.vsm", "--quiet")
    os.makedirs("scratch", exist_ok=True)
    os.makedirs("out", exist_ok=True)
    stops = 0
    for order in ORDERS:
        for kind, delay in ((signal.SIGINT, 0), (signal.SIGTERM, 0.05), (signal.SIGINT, 0.2)):
            code, error = stopped(kind, delay, "large.obj", "out/o.vsm", "--order", order,
                                  "--scratch", "scratch")
            stops += code != 0
            assert code in (0, 128 + kind), (code, error)
            assert code == 0 or error == "smg: cancelled\n", error
            assert listing("out") == (["o.vsm"] if code == 0 else []), (order, delay)
            assert not listing("scratch"), (order, delay)
            if code == 0:
                os.remove("out/o.vsm")
    code, error = stopped(signal.SIGTERM, 0, "large.vsm", "out/o.obj", "--restore-order",
                          "--scratch", "scratch")
    stops += code == 128 + signal.SIGTERM
    assert (listing("out") == []) == (code != 0) and not listing("scratch"), (code, error)
    assert stops >= 6, stops


def test_few_descriptors():
    """Nothing remains, however few files the process may have open."""
    write_torus("small.obj", 60, 40)
    run("convert", "small.obj", "small.vsm", "--quiet")
    os.makedirs("scratch", exist_ok=True)
    os.makedirs("out", exist_ok=True)
    successes = 0
    for arguments in (("convert", "small.obj", "out/o.vsm"), ("smooth", "small.vsm", "out/o.ply"),
                      ("simplify", "small.obj", "out/o.ply", "--vertices", "100")):
        for files in range(3, 30):
            done = subprocess.run(
                [SMG, *arguments, "--scratch", "scratch", "--quiet"], capture_output=True, text=True,
                preexec_fn=lambda limit=files: resource.setrlimit(resource.RLIMIT_NOFILE, (limit, limit)),
                timeout=600, check=False)
            assert not listing("scratch"), (arguments, files, done.stderr)
            assert listing("out") == ([arguments[2][4:]] if done.returncode == 0 else []), (arguments, files)
            if done.returncode == 0:
                os.remove(arguments[2])
                successes += 1
    assert successes > 3, successes


def test_kill():
    """The next run removes the remains of a killed program, and nothing else."""
    os.makedirs("scratch", exist_ok=True)
    os.makedirs("scratch/smg-scratch-mine", exist_ok=True)
    for name in ("scratch/smg-scratch-mine/notes.txt", "scratch/smg-scratch-file", "scratch/other"):
        with open(name, "w", encoding="utf-8") as file:
            file.write("keep me")
    mine = listing("scratch")
    run("convert", "large.obj", "out/kept.vsm", "--quiet")
    kept = read("out/kept.vsm")
    left = 0
    for delay in (0, 0.05):
        code, _ = stopped(signal.SIGKILL, delay, "large.obj", "out/kept.vsm", "--scratch", "scratch")
        assert code == -signal.SIGKILL
        left += listing("scratch") != mine
        assert read("out/kept.vsm") == kept
    assert left > 0
    run("convert", "large.obj", "out/kept.vsm", "--scratch", "scratch", "--quiet")
    assert listing("scratch") == mine, listing("scratch")
    assert read("out/kept.vsm") == kept


for folder in ("out", "scratch"):  # remains of an earlier failed run
    shutil.rmtree(folder, ignore_errors=True)
NEED_NO_DISK = (test_counts_of_off, test_signals, test_few_descriptors, test_kill)
for each in (test_estimates, test_full_scratch, test_full_output) + NEED_NO_DISK:
    if can_mount() or each in NEED_NO_DISK:
        each()
        print("passed", each.__name__)
    else:
        print("skipped", each.__name__, ": no disk can be mounted here")
sys.exit(0)
