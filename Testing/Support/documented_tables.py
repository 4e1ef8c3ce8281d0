# SPDX-License-Identifier: BSD-3-Clause
"""Tables in documents that programs write: those between the lines `<!-- NAME -->` and `<!-- end -->`."""
import re


def markdown(head, rows):
    """A table in Markdown."""
    lines = [head, ["---"] * len(head), *rows]
    return "".join("| " + " | ".join(map(str, line)) + " |\n" for line in lines)


def replace_tables(page, tables):
    """Replaces the tables of a document by `tables`, Markdown by name; those of other names stay. Returns its text
    before and after, and writes nothing."""
    before = after = page.read_text(encoding="utf-8")
    for name, table in tables.items():
        after = re.sub(f"(<!-- {re.escape(name)} -->\n).*?(<!-- end -->)",
                       lambda found: found[1] + table.strip("\n") + "\n" + found[2], after, flags=re.DOTALL)
    return before, after
