# SPDX-License-Identifier: BSD-3-Clause
"""A disk of a given size in memory, for the scripts of this folder."""

import os
import subprocess
import threading
import time


class SmallDisk:
    """A folder with its own file system; `allowed` is false if mounting is not permitted."""

    def __init__(self, folder, size):
        self.folder = os.path.abspath(folder)
        os.makedirs(self.folder, exist_ok=True)
        self.size = size

    def __enter__(self):
        subprocess.run(["mount", "-t", "tmpfs", "-o", "size=%d" % self.size, "smg", self.folder],
                       check=True, capture_output=True)
        return self.folder

    def __exit__(self, *_):
        subprocess.run(["umount", self.folder], check=True)


def can_mount():
    """Whether a disk can be created."""
    try:
        with SmallDisk("probe", 1 << 20):
            return True
    except (OSError, subprocess.CalledProcessError):
        return False


def peak_of(folder, work):
    """The peak number of bytes used on the disk of the folder during `work()`."""
    peak, done = 0, threading.Event()

    def watch():
        nonlocal peak
        while not done.is_set():
            state = os.statvfs(folder)
            peak = max(peak, (state.f_blocks - state.f_bfree) * state.f_frsize)
            time.sleep(0.001)

    watcher = threading.Thread(target=watch)
    watcher.start()
    try:
        work()
    finally:
        done.set()
        watcher.join()
    return peak
