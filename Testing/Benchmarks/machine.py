# SPDX-License-Identifier: BSD-3-Clause
"""The machine of a measurement."""
import os


def machine():
    with open("/proc/cpuinfo", encoding="utf-8") as lines:
        models = [line.split(":")[1].strip() for line in lines if line.startswith("model name")]
    pages = os.sysconf("SC_PHYS_PAGES") * os.sysconf("SC_PAGE_SIZE")
    return {"processor": models[0] if models else "", "cores": os.cpu_count(),
            "memory_gib": round(pages / (1 << 30))}


if __name__ == "__main__":
    print("{processor}, {cores} cores, {memory_gib} GiB of memory".format(**machine()))
