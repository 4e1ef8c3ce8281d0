#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Writes __init__.pyi of the package streamingmultigrid, its public interface with the types of all arguments.

The jobs get their signatures from the library when the package is loaded (_jobs.py), which type checkers and
editors do not do. A build runs this, with the folder that has the package:

    python3 make_stubs.py build/lib/python3/dist-packages
"""

import inspect
import os
import re
import sys
import textwrap
from typing import Generic

FOLDER = sys.argv[1]
sys.path.insert(0, FOLDER)
sys.dont_write_bytecode = True
import streamingmultigrid as smg  # noqa: E402
from streamingmultigrid._jobs import JOBS  # noqa: E402

HEAD = """# SPDX-License-Identifier: BSD-3-Clause
# Written by Python/make_stubs.py, of the signatures of the package.
from typing import Any, Callable, Dict, Iterable, Iterator, List, Literal, Mapping, Optional
from typing import Sequence, Tuple, Union

import numpy as np
import numpy.typing as npt

from . import _types as types
from . import progress as progress

__version__: str
"""

_SPECIAL = {
    "__getitem__", "__setitem__", "__contains__", "__len__", "__enter__", "__exit__", "__array__",
    "__array_ufunc__", "__matmul__", "__rshift__", "__and__", "__or__", "__sub__", "__rand__", "__ror__",
    "__invert__",
}  # fmt: skip
#: What the parts of the package have for each other.
_INTERNAL = {
    "check_output", "defaults", "description", "lines", "merged", "of_datum", "preview_svg", "saving", "select_vertices",
    "selected", "where", "with_columns",
}  # fmt: skip


def _type(annotation):
    text = annotation if isinstance(annotation, str) else getattr(annotation, "__name__", str(annotation))
    text = text.replace("types.Job", "Literal[%s]" % ", ".join(map(repr, JOBS)))
    return text.strip("\"'").replace("\"Placed\"", "Placed")


def _parameter(parameter):
    text = {parameter.VAR_POSITIONAL: "*", parameter.VAR_KEYWORD: "**"}.get(parameter.kind, "")
    text += parameter.name
    if parameter.annotation is not parameter.empty and parameter.name != "self":
        text += ": " + _type(parameter.annotation)
    if parameter.default is not parameter.empty:
        text += " = %r" % (parameter.default,)
    return text


def _function(name, function, indent=""):
    signature = inspect.signature(function)
    texts, keyword_only = [], False
    for parameter in signature.parameters.values():
        keyword_only = keyword_only or parameter.kind is parameter.VAR_POSITIONAL
        if parameter.kind is parameter.KEYWORD_ONLY and not keyword_only:
            texts.append("*")
            keyword_only = True
        texts.append(_parameter(parameter))
    empty = signature.return_annotation is signature.empty
    result = "Any" if empty else _type(signature.return_annotation)
    line = "%sdef %s(%s) -> %s: ..." % (indent, name, ", ".join(texts), result)
    if len(line) <= 110:
        return [line]
    inner = textwrap.wrap(
        ", ".join(text.replace(" ", "~") for text in texts), 106 - len(indent), break_long_words=False
    )
    inner = ["%s    %s" % (indent, text.replace("~", " ")) for text in inner]
    return ["%sdef %s(" % (indent, name), *inner, "%s) -> %s: ..." % (indent, result)]


def _bases(cls):
    """The public bases, through those that are private."""
    for base in cls.__bases__:
        if base.__module__.startswith("streamingmultigrid") and base.__name__.startswith("_"):
            yield from _bases(base)
        elif base is dict:
            yield "Dict[str, Any]"
        elif base is Generic:
            continue
        elif base.__name__ == "NDArrayOperatorsMixin":
            yield "np.lib.mixins.NDArrayOperatorsMixin"
        elif base is not object:
            yield base.__name__


def _members(cls):
    found = {}
    for each in reversed(cls.__mro__):
        if each is cls or each.__module__.startswith("streamingmultigrid") and each.__name__.startswith("_"):
            found.update(vars(each))
    return found


def _class(name, cls):
    bases = list(_bases(cls))
    lines = ["class %s%s:" % (name, "(%s)" % ", ".join(bases) if bases else "")]
    members = _members(cls)
    for attribute, annotation in vars(cls).get("__annotations__", {}).items():
        lines.append("    %s: %s" % (attribute, _type(annotation)))
    for member, value in members.items():
        if member in _INTERNAL or member.startswith("_") and member not in _SPECIAL:
            continue
        if isinstance(value, property):
            result = inspect.signature(value.fget).return_annotation
            lines += ["    @property", "    def %s(self) -> %s: ..." % (member, _type(result))]
        # What is there to raise an error is one for checkers of types, too.
        elif inspect.isfunction(value) and value.__annotations__.get("return") != "NoReturn":
            lines += _function(member, value, "    ")
    return lines if len(lines) > 1 else [lines[0] + " ..."]


def stubs():
    """The text of the stub."""
    lines = []
    names = sorted([*smg.__all__, "open"], key=lambda name: (not inspect.isclass(getattr(smg, name)), name))
    private = {"Placed": type(smg.boundary >> 0)}
    classes = {name: getattr(smg, name) for name in names if inspect.isclass(getattr(smg, name))}
    order = sorted({**private, **classes}.items(), key=lambda item: (len(item[1].__mro__), item[0]))
    for name, cls in order:
        lines += ["", *_class(name, cls)]
    for name in names:
        value = getattr(smg, name)
        if inspect.isfunction(value):
            lines += ["", *_function(name, value)]
        elif not inspect.isclass(value):
            lines += ["", "%s: %s" % (name, "Region")]
    listed = ["", "__all__ = [", *("    %r," % name for name in smg.__all__), "]"]
    text = "\n".join([*lines, *listed]).replace("'", '"')
    return HEAD + re.sub(r"\bnp\.ndarray\b", "npt.NDArray[Any]", text) + "\n"


with open(os.path.join(FOLDER, "streamingmultigrid", "__init__.pyi"), "w", encoding="utf-8") as file:
    file.write(stubs())
