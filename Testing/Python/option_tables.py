#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""The tables of options in the documents, from the tables of the jobs in the library, and that of the entries of
a report, from the comments in Report.h.

    PYTHONPATH=build/lib/python3/dist-packages python3 Testing/Python/option_tables.py

writes them between the lines <!-- options JOB -->, or <!-- report -->, and <!-- end -->.
"""

import os
import re

from streamingmultigrid import _options as options

TREE = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
DOCUMENTS = {job: os.path.join(TREE, "docs", job + ".md") for job in options.described()}
_TABLE = re.compile(r"(<!-- (?:options (\w+)|report) -->\n).*?(<!-- end -->)", re.S)
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


def _comments(text, indent):
    """What the comments of C++ say of the members at an indentation: {name: (type, text)}."""
    member = re.compile(
        r"^ {%d}(?:/\*\* (?P<before>(?:(?!\*/).)*?) \*/\n {%d})?(?P<type>[A-Za-z][\w:<>, ]*?) (?P<name>\w+)(?: = [^;\n]+|\{\})?;"
        r"(?: +///< (?P<after>[^\n]*))?$" % (indent, indent), re.M | re.S
    )  # fmt: skip
    found = {}
    for match in member.finditer(text):
        words = re.sub(r"\s*\n\s*\* ", " ", match["before"] or match["after"] or "").strip()
        words = re.sub(r"(?<!\.)\.$", "", words).replace("; see AccelerationKind", "")
        found[match["name"]] = (match["type"], re.sub(r"Report::|\b\w+Options::", "", words).replace("|", r"\|"))
    return found


with open(os.path.join(TREE, "Solver", "include", "smg", "Report.h"), encoding="utf-8") as _file:
    _REPORT = _file.read()
#: What Report.h says of the members of a report.
MEMBERS = _comments(_REPORT, 2)
#: Of those that are structures, which are shown with the same entries.
_STRUCTURES = {
    name: _comments(text, 4)
    for name, text in re.findall(r"^  struct (\w+)\n  \{\n(.*?)^  \};", _REPORT, re.M | re.S)
    if name not in ("Areas", "Inverted")
}


def report_table():
    """The table of the entries of a report, in their order."""
    rows = []
    for entry in options.entries_of("report"):
        kind, meaning = MEMBERS[entry]
        inner = _STRUCTURES.get(re.sub(r".*<|>.*", "", kind), {})
        parts = ["`%s`" % name + (", " + words if words else "") for name, (_, words) in inner.items()]
        rows.append("| `%s` | %s |" % (entry, ": ".join([meaning] + ["; ".join(parts)] * bool(parts))))
    return "\n".join(["| entry | meaning |", "|---|---|", *rows]) + "\n"


def completed(text):
    """A document with its tables as they are to be."""
    return _TABLE.sub(lambda match: match[1] + (table(match[2]) if match[2] else report_table()) + match[3], text)


if __name__ == "__main__":
    for path in DOCUMENTS.values():
        with open(path, encoding="utf-8") as file:
            text = completed(file.read())
        with open(path, "w", encoding="utf-8") as file:
            file.write(text)
