#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""The tables of options in the documents, from the tables of the jobs in the library.

    PYTHONPATH=build/lib/python3/dist-packages python3 Testing/Python/option_tables.py

writes them between the lines <!-- options JOB --> and <!-- end -->.
"""

import os
import re

from streamingmultigrid import _options as options

TREE = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
DOCUMENTS = {job: os.path.join(TREE, "docs", job + ".md") for job in options.described()}
_TABLE = re.compile(r"(<!-- options (\w+) -->\n).*?(<!-- end -->)", re.S)
_VALUES = {
    "number": "X", "count": "N", "column": "COLUMN", "columns": "COLUMN,...", "where": "WHERE", "size": "SIZE",
    "description": "FILE",
}  # fmt: skip


def flag(option):
    """The option of the command line."""
    return "--" + option["key"].replace("_", "-")


def _row(option):
    name = flag(option)
    if option["kind"] == "choice":
        name += " " + r"\|".join(option["choices"])
    elif option["kind"] != "flag":
        name += " " + _VALUES[option["kind"]] + "".join(r"\|" + each for each in option.get("choices", ()))
    notes = ["in " + option["unit"]] if "unit" in option else []
    notes += [option["allowed"]] if "allowed" in option and option["kind"] != "choice" else []
    meaning = option["help"] + (" (%s)" % "; ".join(notes) if notes else "")
    default = option.get("default", "required" if option.get("required") else "")
    if option["kind"] == "flag":
        default = "on; `--no-%s`" % option["key"].replace("_", "-") if default else ""
    return "| `%s` | %s | %s |" % (name, meaning, default)


def table(job):
    """The table of the options of a job that not all commands have."""
    rows = [_row(option) for option in options.described()[job] if not option.get("common")]
    return "\n".join(["| option | meaning | default |", "|---|---|---|", *rows]) + "\n"


def completed(text):
    """A document with its tables as they are to be."""
    return _TABLE.sub(lambda match: match[1] + table(match[2]) + match[3], text)


if __name__ == "__main__":
    for path in DOCUMENTS.values():
        with open(path, encoding="utf-8") as file:
            text = completed(file.read())
        with open(path, "w", encoding="utf-8") as file:
            file.write(text)
