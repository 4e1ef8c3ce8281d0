# SPDX-License-Identifier: BSD-3-Clause
"""What becomes of calls and handles when the process forks, and when the interpreter ends.

A forked child has copies of the handles, but not the threads that use them. When the interpreter ends,
a thread that still computes could not report to it any more: such calls are cancelled before.
"""

from __future__ import annotations

import atexit
import contextlib
import functools
import operator
import os
import threading
import weakref
from typing import Any, Callable, Dict, Iterable, Iterator, List, Set

from ._errors import Error

#: Seconds that the interpreter waits at its end for calls of other threads, which end when they report
#: their progress the next time: usually within a second.
_PATIENCE = 30.0

_changed = threading.Condition()  # guards what follows
_calls: Set[int] = set()  # the threads that are in a call of the library that reports progress
_is_ending = False


class _Alive:
    """Objects as long as they live; like a WeakSet, without any step of Python when one goes."""

    def __init__(self) -> None:
        self._references: Dict[Any, None] = {}

    def add(self, one: Any) -> None:
        self._references[weakref.ref(one, self._references.pop)] = None

    def objects(self) -> List[Any]:
        found = (reference() for reference in list(self._references))
        return [one for one in found if one is not None]


class HandleLock:
    """A lock for the calls with one handle; a thread may take it twice.

    ``is_lost``: the process was forked in the middle of a call, whose handle the child cannot use.
    """

    def __init__(self) -> None:
        self._lock = threading.RLock()
        self.is_lost = False
        _locks.add(self)

    # Functions of C: no step of Python, at which an interrupt could end the call, is in them. One just
    # after the lock was taken and before the body of `with` begins is still possible, as of any lock.
    @property
    def __enter__(self) -> Callable[[], bool]:
        return self._lock.__enter__

    @property
    def __exit__(self) -> Callable[..., None]:
        return self._lock.__exit__

    def is_free(self) -> bool:
        """Whether no other thread has it."""
        if self._lock.acquire(blocking=False):
            self._lock.release()
            return True
        return False

    def inherit(self, in_call: bool) -> None:
        """In a forked child, where other threads that had the lock do not exist."""
        is_free = self.is_free()
        self.is_lost = self.is_lost or in_call or not is_free
        if not is_free:
            self._lock = threading.RLock()


class _Token:
    """What `closing` returns."""

    __slots__ = ("__weakref__",)


class _Closing(weakref.ref):
    """Of a token: what is called when it goes, and what lives until then."""

    __slots__ = ("close", "keep")
    close: Callable[[], Any]
    keep: List[Any]


_locks = _Alive()
_handles = _Alive()
_closings: Dict[Any, _Closing] = {}  # of every token that lives


def closing(function: Callable, *arguments: Any, keep: Iterable = ()) -> Any:
    """A token with whose last reference `function(*arguments)` is called, a function of C.

    There is no step of Python on the way to it: at each of them a signal can be handled, as Ctrl-C, whose
    exception would end a finalizer before its work is done, be printed and be lost. After the function has
    returned it is raised where the program is.
    """
    token = _Token()
    forgotten = weakref.ref(token, _closings.pop)  # the second to be called: the later one is the first
    reference = _Closing(token, operator.methodcaller("close"))
    reference.close = functools.partial(function, *arguments)
    reference.keep = list(keep)
    _closings[forgotten] = reference
    return token


def forget(token: Any) -> None:
    """Nothing is called any more when the token goes; None: it has gone."""
    if token is not None:
        _closings.pop(weakref.ref(token), None)


def close_at_exit(handle: Any) -> None:
    """Lets the end of the interpreter call `handle.finish()`, and a forked child `handle.inherit()`."""
    _handles.add(handle)


def require_no_call() -> None:
    """A progress function runs in the middle of a call, whose handles it would find half-done."""
    if threading.get_ident() in _calls:
        raise Error("A progress function cannot use meshes, fields or solvers: let the call end first.")


def require_interpreter() -> None:
    """Raises Error on a daemon thread while the interpreter ends."""
    if _is_ending and threading.current_thread() is not threading.main_thread():
        raise Error("The interpreter is ending: nothing can be computed any more.")


@contextlib.contextmanager
def calling() -> Iterator[None]:
    """While this is entered, the thread is in a call of the library that reports progress."""
    own = threading.get_ident()
    with _changed:
        require_interpreter()
        _calls.add(own)
    try:
        yield
    finally:
        with _changed:
            _calls.discard(own)
            _changed.notify_all()


def _end() -> None:
    """Before the interpreter ends: no thread computes any more, and scratch files are removed."""
    global _is_ending
    own = threading.get_ident()
    with _changed:
        _is_ending = True
        _changed.wait_for(lambda: not _calls - {own}, _PATIENCE)
    for handle in _handles.objects():
        handle.finish()


def _inherit() -> None:
    """In a forked child."""
    global _changed
    _changed = threading.Condition()
    in_call = bool(_calls)
    _calls.clear()
    for lock in _locks.objects():
        lock.inherit(in_call)
    for handle in _handles.objects():
        handle.inherit()


atexit.register(_end)
os.register_at_fork(after_in_child=_inherit)
