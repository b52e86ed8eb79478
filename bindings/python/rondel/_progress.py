# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
"""A bar for long calls, in notebooks and terminals, with the time that is left."""

from __future__ import annotations

import contextlib
import html
import sys
import time
from collections.abc import Callable, Iterator
from types import TracebackType
from typing import Any, TextIO

from ._types import Listener, Progress

FIRST = 0.3  # seconds before anything is shown: short calls show nothing
STEP = 0.1  # seconds between two pictures of the bar
CELLS = 24  # of a bar in a terminal


class ProgressBar:
    """Shows how far a call is: pass it as `progress`, or True for one that is made for the call.

    In a notebook it is a bar, in a terminal a line, and nothing where output goes to a file. It
    names the stage of the work, how much of it is done, and how long the rest of the stage will
    take if it goes on as before.

    Parameters
    ----------
    tqdm : callable, optional
        A class like `tqdm.auto.tqdm`, whose bars are used: one for each stage, made by
        ``tqdm(total=100, desc=stage)``, moved by ``update`` and ended by ``close``. By default bars
        of this module, which need no other library.
    file : file object, optional
        Where a line is written if there is no notebook; by default standard error, if that is a
        terminal.

    See Also
    --------
    rondel.delaunay : one of the calls that take `progress`.

    Notes
    -----
    What is passed as `progress` may be any function of a text and a number; an exception that it
    raises ends the call.

    Examples
    --------
    >>> import rondel.mesh
    >>> with rondel.ProgressBar() as bar:
    ...     mesh = rondel.mesh.scvt(642, progress=bar)
    >>> mesh
    <Mesh: 642 cells, 1920 edges, 1280 vertices>

    """

    def __init__(
        self, tqdm: Callable[..., Any] | None = None, *, file: TextIO | None = None
    ) -> None:
        self._tqdm = tqdm
        self._bar: Any = None  # of tqdm
        self._shown = 0  # percent that the bar of tqdm has
        self._file = file
        self._display = None if file is not None or tqdm is not None else _notebook()
        self._handle: Any = None
        self._stage = ""
        self._is_dirty = False
        self._start = self._next = time.monotonic()
        self._next += FIRST

    def __call__(self, stage: str, fraction: float) -> None:
        """Shows a stage and the fraction of it that is done, from 0 to 1."""
        now = time.monotonic()
        fraction = min(max(fraction, 0.0), 1.0)
        if stage != self._stage:
            self._end_stage()
            self._stage, self._start = stage, now
        if self._tqdm is not None:
            self._update(fraction)
        elif now >= self._next:
            self._next = now + STEP
            self._show(fraction, now - self._start)

    def close(self) -> None:
        """Removes the bar, as the call has ended."""
        self._end_stage()
        if self._is_dirty and self._handle is not None:
            self._handle.update(_markup(""))
        elif self._is_dirty:
            print("\r\x1b[K", end="", file=self._stream, flush=True)
        self._is_dirty = False
        self._stage = ""

    def __enter__(self) -> ProgressBar:
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        self.close()

    @property
    def _stream(self) -> TextIO:
        return sys.stderr if self._file is None else self._file

    def _update(self, fraction: float) -> None:
        if self._bar is None and self._tqdm is not None:
            self._bar, self._shown = self._tqdm(total=100, desc=self._stage), 0
        percent = int(100 * fraction)
        if percent > self._shown:
            self._bar.update(percent - self._shown)
            self._shown = percent

    def _end_stage(self) -> None:
        if self._bar is not None:
            self._bar.close()
            self._bar = None

    def _show(self, fraction: float, seconds: float) -> None:
        words = f"{self._stage} {100 * fraction:.0f} %{_time_left(seconds, fraction)}"
        if self._display is not None:
            picture = _markup(words, fraction)
            if self._handle is None:
                self._handle = self._display(picture, display_id=True)
            else:
                self._handle.update(picture)
        elif self._file is not None or self._stream.isatty():
            done = round(CELLS * fraction)
            bar = "#" * done + "." * (CELLS - done)
            print(f"\r\x1b[K[{bar}] {words}", end="", file=self._stream, flush=True)
        else:
            return
        self._is_dirty = True


@contextlib.contextmanager
def listening(progress: Progress) -> Iterator[Listener | None]:
    """What is told how far the work is; a bar for True is removed at the end."""
    if not isinstance(progress, bool):
        yield progress
    elif progress:
        with ProgressBar() as bar:
            yield bar
    else:
        yield None


def _time_left(seconds: float, fraction: float) -> str:
    """The time that the rest takes, as the tool says it; nothing while it would be a guess."""
    if seconds < 1 or fraction < 0.01 or fraction >= 1:
        return ""
    left = int(min(seconds * (1 - fraction) / fraction, 359_999)) + 1
    if left < 60:
        return f", {left} s left"
    if left < 3600:
        return f", {left // 60} min {left % 60:02} s left"
    return f", {left // 3600} h {left // 60 % 60:02} min left"


class _Markup:
    """What a notebook shows."""

    def __init__(self, text: str) -> None:
        self._text = text

    def _repr_html_(self) -> str:
        return self._text


def _markup(words: str, fraction: float = 0.0) -> _Markup:
    if not words:
        return _Markup("")
    said = html.escape(words)
    return _Markup(
        f'<progress max="1" value="{fraction:.3f}" aria-label="{said}"></progress> {said}'
    )


def _notebook() -> Any:
    """The function `display` of IPython, if this is the kernel of a notebook."""
    ipython = sys.modules.get("IPython")
    shell = None if ipython is None else ipython.get_ipython()
    if shell is None or not hasattr(shell, "kernel"):
        return None
    from IPython.display import display

    return display
