# SPDX-License-Identifier: BSD-3-Clause
"""The options of jobs as arguments in Python: signatures and docstrings from what the library says of them.

The library has a table of the options of each job (smg_describe()). An argument is what such an option is,
and where that is a column or a part of the mesh an array as well.
"""

from __future__ import annotations

import functools
import inspect
import json
import textwrap
from ctypes import byref, c_char_p
from typing import Any, Dict, List, Mapping

from ._library import call

#: Options whose keys are words of Python, or say less than their arguments.
_NAMES = {"from": "sources"}

#: The types of arguments by the kinds of options.
_TYPES = {
    "number": "float", "count": "int", "bytes": "types.Size", "flag": "bool", "column": "Union[str, npt.ArrayLike]",
    "columns": "types.Columns", "where": "types.Places", "size": "Union[float, str]", "folder": "types.Path",
}  # fmt: skip

#: What else an argument may be than its option.
_FORMS = {
    "where": "a region, a mask (booleans, (n,)), numbers of vertices, or a list of these",
    "column": "its name, or an array with a row for each",
    "columns": "a name, a list of names, an array (n,) or (n, k), which becomes the column Values, or {name: array}",
    "size": 'a number, or a text as "1%" or "6edges"',
}
#: What descriptions are, of which the command line has files.
_DESCRIPTIONS = {
    "handles": "`smg.handle(...)` or a list of these, of which the last one counts where several hold a vertex; or a "
    "handle file (docs/deform.md), or its dict",
    "problem": "A problem file (docs/problem.md), or its dict, which the other arguments complete",
}
_OF_MESH = ("memory", "threads", "scratch", "scratch_limit")  # by default


#: The types of the entries of reports by their kinds.
_ENTRIES = {"count": "int", "number": "float", "flag": "bool", "text": "str", "entries": "Dict[str, Any]"}


@functools.lru_cache(maxsize=None)
def _library_says() -> Dict[str, Any]:
    result = c_char_p()
    call("smg_describe", byref(result))
    return json.loads(result.value or b"{}")


def described() -> Dict[str, List[Dict[str, Any]]]:
    """The options of all jobs, as the library describes them."""
    return _library_says()["jobs"]


def entries_of(*reports: str) -> Dict[str, str]:
    """The entries that these reports of the library may have, with their types."""
    types: Dict[str, str] = {}
    for entry in (entry for name in reports for entry in _library_says()[name]):
        kind = _ENTRIES[entry["kind"]]
        types.setdefault(entry["key"], "List[%s]" % kind if entry.get("list") else kind)
    return types


def name_of(option: Mapping[str, Any]) -> str:
    """The argument that is this option."""
    return _NAMES.get(option["key"], option["key"])


def parameter(option: Mapping[str, Any], positional: bool = False) -> inspect.Parameter:
    """The argument with its type; None is what it is by default."""
    choices = "Literal[%s]" % ", ".join('"%s"' % choice for choice in option.get("choices", ()))
    if option["kind"] == "choice":
        types = choices
    elif option["kind"] == "description":
        types = "types." + option["key"].capitalize()
    else:
        # Smoothing takes an array by its name as well.
        types = "types.Columns" if option["key"] == "column" else _TYPES[option["kind"]]
        types = "Union[%s, %s]" % (types, choices) if "choices" in option else types
    required = option.get("required", False)
    kind = inspect.Parameter.POSITIONAL_OR_KEYWORD if positional else inspect.Parameter.KEYWORD_ONLY
    return inspect.Parameter(
        name_of(option),
        kind,
        default=inspect.Parameter.empty if required else None,
        annotation=types if required else "Optional[%s]" % types,
    )


def documentation(option: Mapping[str, Any]) -> str:
    """What a docstring says of the argument."""
    text = _DESCRIPTIONS.get(option["key"], option["help"])
    if option["kind"] in _FORMS:
        text += ": " + _FORMS[option["kind"]]
    notes = []
    if "unit" in option:
        notes.append("in " + option["unit"])
    if option["kind"] != "choice" and "allowed" in option:
        notes.append(option["allowed"])
    if option["key"] in _OF_MESH:
        notes.append("default that of the mesh")
    elif "default" in option:
        notes.append("default %s" % (option["default"],))
    line = "%s: %s%s." % (name_of(option), text, " (%s)" % "; ".join(notes) if notes else "")
    return textwrap.fill(line, 108, initial_indent=" " * 8, subsequent_indent=" " * 12)
