# SPDX-License-Identifier: BSD-3-Clause
"""How a call of the library says how far it is, and how it is interrupted.

``progress=`` of every function that may take long is one of

* a callable that takes the part that is done, from 0.0 to 1.0;
* a ``tqdm`` bar, or the class ``tqdm`` itself;
* a ``rich.progress.Progress``, to which a task is added;
* ``True``: a plain bar on the standard error output;
* ``None`` (default): nothing.

An exception that a progress function raises cancels the call and is raised from it; so is Ctrl-C, and what
the handler of any other signal raises.
"""

from __future__ import annotations

import contextlib
import os
import signal
import sys
import threading
from typing import Any, Callable, Dict, Iterator, List, Optional

from ._errors import Error, InputError
from ._process import require_interpreter

Report = Callable[[float], Any]


def _plain_bar(label: str) -> Iterator[Report]:
    shown = -1

    def show(done: float) -> None:
        nonlocal shown
        percent = int(100 * done)
        if percent != shown:
            shown = percent
            sys.stderr.write("\r%s [%-40s] %3d %%" % (label, "#" * (percent * 2 // 5), percent))
            sys.stderr.flush()

    try:
        yield show
    finally:
        if shown >= 0:
            sys.stderr.write("\n")


def _tqdm_bar(bar: Any) -> Report:
    if bar.total is None:
        bar.total = 1.0
    first = bar.n  # a bar may go on after another job

    def show(done: float) -> None:
        step = first + done * (bar.total - first) - bar.n
        if step > 0:
            bar.update(step)

    return show


@contextlib.contextmanager
def reporting(progress: Any, label: str) -> Iterator[Optional[Report]]:
    """The function to be told the part that is done, for any of the forms above."""
    if progress is None or progress is False:
        yield None
    elif progress is True:
        yield from _plain_bar(label)
    elif hasattr(progress, "add_task"):  # rich.progress.Progress
        task = progress.add_task(label, total=1.0)
        yield lambda done: progress.update(task, completed=done)
    elif isinstance(progress, type) and hasattr(progress, "update"):  # the class tqdm
        bar = progress(total=1.0, desc=label, bar_format="{l_bar}{bar}| {elapsed}<{remaining}")
        try:
            yield _tqdm_bar(bar)
        finally:
            bar.close()
    elif hasattr(progress, "update") and hasattr(progress, "n"):  # a tqdm
        yield _tqdm_bar(progress)
    elif callable(progress):
        yield progress
    else:
        raise InputError(
            "progress: %r is neither a function, nor a bar of tqdm or rich, nor True."
            % type(progress).__name__
        )


def part(report: Optional[Report], begin: float, end: float) -> Optional[Report]:
    """Of a step that takes the part of a job from `begin` to `end`."""
    if report is None:
        return None
    whole = report
    return lambda done: whole(begin + done * (end - begin))


class Cancellation:
    """The function that the library calls, and the exception that ended a call.

    No exception can pass through the library: what the progress function raises is kept, the library
    told to cancel, and the exception raised again after the call. Handlers of signals, as of Ctrl-C and
    of `signal.alarm`, could raise anywhere in this class; therefore a signal only leaves a note here, for
    which the handler that was there is called where an exception is caught.
    """

    def __init__(self, report: Optional[Report]) -> None:
        self._report = report
        self._signals: List[tuple] = []
        self._handlers: Dict[int, Any] = {}
        self._process = os.getpid()
        self.exception: Optional[BaseException] = None

    def __call__(self, done: float, _user: Any = None) -> int:
        try:
            require_interpreter()
            self._handle_signals()
            if self._report is not None and self.exception is None:
                self._report(min(1.0, max(0.0, done)))
            if os.getpid() != self._process:
                raise Error("A progress function has forked the process: the child cannot go on.")
        except BaseException as exception:  # raised again by raise_exception()
            self.exception = exception
        return 0 if self.exception is None else 1

    def __enter__(self) -> "Cancellation":
        if threading.current_thread() is threading.main_thread():
            for number in signal.valid_signals():
                handler = signal.getsignal(number)
                if callable(handler):
                    self._handlers[number] = handler
                    signal.signal(number, self._note_signal)
        return self

    def __exit__(self, *_: Any) -> None:
        for number, handler in self._handlers.items():
            signal.signal(number, handler)

    def raise_exception(self) -> None:
        """After the call: raises what ended it; of signals that came too late for it as well."""
        if self.exception is not None:
            raise self.exception
        self._handle_signals()

    def _note_signal(self, *arguments: Any) -> None:
        self._signals.append(arguments)

    def _handle_signals(self) -> None:
        while self._signals:
            number, frame = self._signals.pop(0)
            self._handlers[number](number, frame)
