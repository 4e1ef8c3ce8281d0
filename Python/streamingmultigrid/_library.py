# SPDX-License-Identifier: BSD-3-Clause
"""The C interface (streamingmultigrid.h): loaded at its first use, and called."""

from __future__ import annotations

import ctypes
import functools
import glob
import json
import math
import os
import re
import sysconfig
from ctypes import POINTER, byref, c_char_p, c_double, c_int, c_int64, c_void_p
from typing import Any, Callable, Dict, List, Mapping, Optional, Tuple

from . import progress as _progress
from . import _process as process
from ._arrays import Array, plain
from ._errors import Error, InputError, MemoryLimitError
from ._version import VERSION

PROGRESS = ctypes.CFUNCTYPE(c_int, c_double, c_void_p)
_INVALID, _MEMORY = 2, 3
_NAME = "libstreamingmultigrid.so"

_REPORTED = [PROGRESS, c_void_p]  # progress and its data
_FUNCTIONS = {  # their arguments; they return a status
    "smg_open": [c_char_p, c_char_p, *_REPORTED, POINTER(c_void_p)],
    "smg_open_arrays": [POINTER(Array), POINTER(Array), c_char_p, *_REPORTED, POINTER(c_void_p)],
    "smg_triangulate": [POINTER(Array)] * 3 + [*_REPORTED, c_void_p],
    "smg_add_column": [c_void_p, c_char_p, c_int, POINTER(Array), *_REPORTED],
    "smg_add_argument": [c_void_p, c_char_p, c_int, POINTER(Array), *_REPORTED],
    "smg_remove_column": [c_void_p, c_char_p, c_int],
    "smg_select": [c_void_p, c_char_p, *_REPORTED, c_void_p],
    "smg_info": [c_void_p, c_int, *_REPORTED, POINTER(c_char_p)],
    "smg_counts": [c_void_p, POINTER(c_int64), POINTER(c_int64)],
    "smg_conversion": [c_void_p, POINTER(c_char_p)],
    "smg_elements": [c_void_p, *_REPORTED, POINTER(c_int64)],
    "smg_merged": [c_void_p, *_REPORTED, POINTER(c_int64), c_void_p, c_void_p],
    "smg_describe": [POINTER(c_char_p)],
    "smg_files": [c_char_p, POINTER(c_char_p)],
    "smg_estimate": [c_void_p, c_char_p, c_char_p, c_char_p, POINTER(c_char_p)],
    "smg_estimate_file": [c_char_p] * 5 + [POINTER(c_char_p)],
    "smg_run": [c_void_p, c_char_p, c_char_p, *_REPORTED, POINTER(c_void_p)],
    "smg_open_field": [c_void_p, *_REPORTED, POINTER(c_void_p)],
    "smg_simplify": [c_void_p, c_char_p, c_char_p, *_REPORTED, POINTER(c_char_p)],
    "smg_convert": [c_char_p, c_char_p, c_char_p, *_REPORTED, POINTER(c_char_p)],
    "smg_report": [c_void_p, c_int, *_REPORTED, POINTER(c_char_p)],
    "smg_shape": [c_void_p, POINTER(c_int64), POINTER(c_int64)],
    "smg_save": [c_void_p, c_char_p, c_char_p, *_REPORTED, POINTER(c_char_p)],
    "smg_save_mesh": [c_void_p, c_char_p, c_char_p, *_REPORTED, POINTER(c_char_p)],
    "smg_columns": [c_void_p, c_void_p, POINTER(c_char_p)],
    "smg_read": [c_void_p, c_void_p, c_char_p, c_int, *_REPORTED, c_void_p],
    "smg_open_blocks": [c_void_p, c_void_p, c_char_p, *_REPORTED, POINTER(c_void_p)],
    "smg_next_block": [c_void_p, POINTER(c_int64), POINTER(c_int64)],
    "smg_block_array": [c_void_p, c_char_p, c_int, POINTER(Array)],
    "smg_block_rows": [c_void_p, c_int, POINTER(Array)],
    "smg_block_ghosts": [c_void_p, POINTER(Array)],
    "smg_open_solver": [c_void_p, c_char_p, *_REPORTED, POINTER(c_void_p)],
    "smg_solver_solve": [
        c_void_p, POINTER(Array), c_void_p, c_char_p, *_REPORTED, POINTER(c_char_p),
    ],
    "smg_solver_precondition": [c_void_p, c_void_p, c_void_p],
    "smg_solver_multiply": [c_void_p, c_void_p, c_void_p],
}  # fmt: skip


def _places() -> list:
    """Where the library may be: in a wheel, in the folder of a build, where CMake installs it."""
    here = os.path.dirname(os.path.abspath(__file__))
    prefix_lib = os.path.normpath(os.path.join(here, "..", "..", ".."))
    multiarch = sysconfig.get_config_var("MULTIARCH") or ""
    return [os.path.join(here, "lib"), prefix_lib, os.path.join(prefix_lib, multiarch)]


def _path() -> str:
    for folder in _places():
        for path in sorted(glob.glob(os.path.join(folder, _NAME + ".*")), key=len):
            return path
    return _NAME  # where the loader looks


@functools.lru_cache(maxsize=None)
def library() -> ctypes.CDLL:
    """The library, whose functions run without the global interpreter lock."""
    try:
        loaded = ctypes.CDLL(_path())
    except OSError as error:
        raise ImportError(
            "streamingmultigrid: the library %s cannot be loaded: %s. It is beside the package in a "
            "wheel, and in the Debian package streaming-multigrid." % (_NAME, error)
        ) from None
    declared: Dict[str, tuple] = {name: (types, c_int) for name, types in _FUNCTIONS.items()}
    declared.update((name, ([], c_char_p)) for name in ("smg_version", "smg_error"))
    declared.update(
        ("smg_close_" + name, ([c_void_p], None)) for name in ("mesh", "field", "blocks", "solver")
    )
    declared["smg_remove_folder"] = ([c_char_p], None)
    missing = [name for name in declared if not hasattr(loaded, name)]
    for name in set(declared).difference(missing):
        function = getattr(loaded, name)
        function.argtypes, function.restype = declared[name]
    found = loaded.smg_version().decode() if "smg_version" not in missing else "unknown"
    if missing or found != VERSION:
        raise ImportError(
            "streamingmultigrid: the package is of version %s, but the library %s of version %s%s: "
            "install both from one build."
            % (VERSION, _path(), found, ", without " + missing[0] if missing else "")
        )
    return loaded


def version() -> str:
    """The version of the library, for example "0.2.0"."""
    return library().smg_version().decode()


def encoded(value: Any) -> Optional[bytes]:
    """A path or name as the C interface takes it. Raises InputError if it contains a zero byte."""
    if value is None:
        return None
    name = os.fsencode(value)
    if b"\0" in name:
        raise InputError("%r: a name cannot contain the character 0." % (value,))
    return name


def _not_finite(value: Any, place: str = "") -> Tuple[str, float]:
    """Where in a description the first number is that is infinite or NaN, and the number; none: ("", 0)."""
    value = plain(value) if not isinstance(value, (dict, list, tuple, str, int, float, type(None))) else value
    if isinstance(value, float) and not math.isfinite(value):
        return place, value
    parts: List[Tuple[str, Any]] = []
    if isinstance(value, dict):
        parts = [("%s.%s" % (place, key) if place else str(key), part) for key, part in value.items()]
    elif isinstance(value, (list, tuple)):
        parts = [("%s[%d]" % (place, k), part) for k, part in enumerate(value)]
    found = (_not_finite(part, at) for at, part in parts)
    return next((one for one in found if one[0]), ("", 0.0))


def json_text(description: Mapping[str, Any]) -> bytes:
    """The JSON of a description, without the keys whose value is None."""
    given = {key: value for key, value in description.items() if value is not None}
    for key in ("memory", "scratch_limit"):
        if key in given and isinstance(given[key], float) and given[key].is_integer():
            given[key] = int(given[key])  # 2e9
    try:
        encoded = json.dumps(given, default=plain, allow_nan=False)
    except ValueError as error:
        if isinstance(error, Error):
            raise
        if "Circular" in str(error):
            raise InputError("A list or dict contains itself: %s." % ", ".join(given)) from None
        raise InputError("%s is %s: give a finite number there." % _not_finite(given)) from None
    if re.search(r"(?<!\\)(\\\\)*\\u0000", encoded):
        raise InputError("A name cannot contain the character 0: %s." % ", ".join(given))
    return encoded.encode()


def json_file(path: Any, what: str) -> Any:
    """The contents of a JSON file that is an argument; `what` is its name."""
    try:
        name = os.fspath(path)
    except TypeError:
        raise InputError("%s: %r is neither a dict nor the name of a file." % (what, path)) from None
    try:
        with open(name, encoding="utf-8") as file:
            return json.load(file)
    except OSError as error:
        raise Error("%s: cannot be opened: %s." % (name, error.strerror)) from None
    except ValueError as error:  # no JSON, no UTF-8, or a zero byte in the name
        raise Error("%s: this is not valid JSON: %s." % (name, error)) from None


#: How places of the descriptions of jobs, and what to write there, are called in this package.
_PLACES = tuple(
    (re.compile(pattern), words)
    for pattern, words in (
        (r"\bregion: dirichlet\[0\](?:: |\.)", "region: "),
        (r"\bdistance: from\b", "distance: sources"),
        (r"\bhandles\.handles\[", "handles["),
        (r'add "center": \[x, y, z\]', "give center=[x, y, z]"),
    )
)


def readable(text: str) -> str:
    """A sentence of the library, with the arguments that it knows as columns called so, and those that it
    knows as options of the command line, without what it says to users of others: "(argument weld=0)" for
    "(option --weld 0; in ParaView ...)"; places of descriptions are called by their arguments."""

    def argument(option: "re.Match[str]") -> str:
        value = "=" + option[3] if option[3] else ""
        return "(%s %s%s)" % ("argument" if option[1] == "option" else "without", option[2].replace("-", "_"), value)

    text = re.sub(r"\((option|without) --([a-z-]+)(?: ([^ ;,)]+))?(?:[;,][^)]*)?\)", argument, text)
    for pattern, words in _PLACES:
        text = pattern.sub(words, text)
    return re.sub(r"(?:the column )?'#([^'\"\n]+)'+", r"the array given as \1", text)


def _check(status: int) -> None:
    if status:
        error = {_INVALID: InputError, _MEMORY: MemoryLimitError}.get(status, Error)
        raise error(readable(library().smg_error().decode(errors="replace")))


def call(name: str, *arguments: Any) -> None:
    """Calls a function that takes no progress function; raises its error."""
    _check(getattr(library(), name)(*arguments))


def call_reporting(name: str, arguments: tuple, report: Any, *results: Any) -> None:
    """Calls a function that may take long.

    `arguments` are those before the progress function, `results` those after it, `report` a function
    of the part that is done, or None. What that raises is raised, KeyboardInterrupt at Ctrl-C.
    """
    with _progress.Cancellation(report) as cancellation:
        function = PROGRESS(cancellation)
        with process.calling():
            status = getattr(library(), name)(*arguments, function, None, *results)
    cancellation.raise_exception()
    _check(status)


class NativeHandle:
    """A handle of the C interface, closed with this object, and used by one thread at a time.

    `keep` holds what must live as long as the handle, as arrays that the library reads. A forked child
    may use its copy unless the handle was in use when the process forked.
    """

    def __init__(self, kind: str, *keep: Any) -> None:
        self.pointer = c_void_p()
        self.lock = process.HandleLock()
        self.keep = list(keep)
        self._token = process.closing(getattr(library(), "smg_close_" + kind), self.pointer, keep=keep)
        process.close_at_exit(self)

    def __enter__(self) -> c_void_p:
        """Reserves the handle for this thread."""
        process.require_no_call()
        with self.lock:
            if self.lock.is_lost or self.is_closed:
                raise Error(
                    "The process was forked in the middle of a call: in the child, open what it needs again."
                    if self.lock.is_lost
                    else "This object has been closed: open it again."
                )
            self.lock.__enter__()
            return self.pointer

    @property
    def __exit__(self) -> Callable[..., None]:
        return self.lock.__exit__

    @property
    def is_closed(self) -> bool:
        return self._token is None

    def close(self) -> None:
        """Closes it and removes its scratch files; twice is nothing."""
        process.require_no_call()
        with self.lock:
            self._token = None
            self.keep.clear()

    def __reduce__(self) -> Any:
        raise Error("What only this process has cannot be pickled: save it to a file, and open that.")

    def finish(self) -> None:
        """Closes it at the end of the interpreter, unless a thread still computes with it."""
        if self.lock.is_free():
            self._token = None
        else:
            process.forget(self._token)

    def inherit(self) -> None:
        """In a forked child: leaves what was in use alone."""
        if self.lock.is_lost:
            process.forget(self._token)


def parse(result: c_char_p) -> Dict[str, Any]:
    """The JSON that a function has returned."""
    return json.loads(readable((result.value or b"{}").decode()))

