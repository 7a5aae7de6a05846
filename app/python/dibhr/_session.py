"""Recorded sessions as arrays."""

from __future__ import annotations

import math
import os
from typing import Any

import numpy as np
from numpy.typing import NDArray

from . import _dibhr
from ._rows import TICK_ROW
from ._values import InputError, MissingFileError


class Session:
    """A recorded session (.dibhr), also during its recording; the file is not changed.

    Opening reads all but the ticks. Raises MissingFileError, or InputError if the file is no session
    of this version.
    """

    #: Names and values that describe the session.
    facts: dict[str, str]
    #: The versions of the parameters, by the first tick that used each. Dictionaries: `version` (the
    #: ticks' column `settings`), `first_tick`, `touch` (keywords for a Renderer), `force_enabled`,
    #: `bump` (a path or None).
    parameters: list[dict[str, Any]]
    #: The touched files. Dictionaries: `first_tick`, `colour` and `depth` (paths), and
    #: how the depth was cleaned: `fill_holes`, `remove_spikes`, `smooth_steps`,
    #: `sharpen_silhouettes`, `colour_edges`, `steady`, `smooth_noise`, `densify`, `smooth_outlines`,
    #: `in_betweens`, `motion`, `finger_px`, `finger_relief_px`.
    sources: list[dict[str, Any]]
    #: The marks, by time. Dictionaries: `t` [s], `tag`, `text`.
    marks: list[dict[str, Any]]
    #: t of the first and the last tick [s].
    begin: float
    end: float
    #: The number of ticks missing between them.
    missing: int
    #: What may be missing from the session, as a sentence; empty: nothing.
    warning: str

    def __init__(self, path: str | os.PathLike[str]) -> None:
        try:
            self._core = _dibhr.Session(os.fsencode(path))
        except InputError as error:
            if os.path.exists(path):
                raise
            raise MissingFileError(str(error)) from None
        self.facts = self._core.facts()
        self.parameters = self._core.parameters()
        self.sources = self._core.sources()
        self.marks = self._core.marks()
        self._count, self.missing, self.begin, self.end = self._core.extent()
        self.warning = self._core.warning()

    def __len__(self) -> int:
        return self._count

    def ticks(self, begin: float = -math.inf, end: float = math.inf) -> NDArray[np.void]:
        """The ticks whose time t is in begin to end [s], both included.

        Returns N rows (TICK_ROW) with the columns of `dibhr export`; the first ones are those of
        Renderer.run. For a missing value a real is nan, an integer -1. Other Python threads run
        meanwhile.
        """
        for t in (begin, end):
            if math.isnan(t):
                raise InputError("begin and end are times; one of them is nan")
        rows = np.empty(self._core.count_ticks(begin, end), TICK_ROW)
        places: Any = TICK_ROW.fields
        fields = [(name, place[0].kind, place[1]) for name, place in places.items()]
        return rows[: self._core.read_ticks(begin, end, fields, rows)]

    def check(self) -> None:
        """Checks the whole file; raises InputError if it is damaged."""
        self._core.check()
