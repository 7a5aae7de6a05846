"""The touched surface, from arrays."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
from numpy.typing import NDArray

from . import _dibhr
from ._values import InputError, as_array, in_range


def _picture(given: Any, what: str, smallest: int) -> NDArray[Any]:
    picture = as_array(given, what)
    if picture.dtype.newbyteorder("=") not in (np.uint8, np.uint16, np.float32, np.float64):
        raise InputError(
            f"{what}: uint8, uint16, float32 or float64 is needed, not {picture.dtype}"
        )
    if picture.ndim != 2 or min(picture.shape) < smallest:
        raise InputError(
            f"{what}: its shape is {picture.shape}; "
            f"(rows, columns) of at least ({smallest}, {smallest}) is needed"
        )
    return picture


def _levels(picture: NDArray[Any], what: str, highest: float) -> NDArray[np.float32]:
    with np.errstate(over="ignore"):
        levels = np.ascontiguousarray(picture, np.float32)
    right = (levels >= 0) & (levels <= highest)
    if not right.all():
        row, column = np.argwhere(~right)[0]
        level = float(picture[row, column])
        raise InputError(f"{what}[{row}, {column}]: {level:g} is not in 0 to {highest:g}")
    return levels


def _bump(given: Any) -> NDArray[np.float32]:
    heights = np.ascontiguousarray(_picture(given, "bump", 1), np.float32)
    if not np.isfinite(heights).all():
        raise InputError("bump: a height is not a finite number")
    stretched: NDArray[np.float32] = heights - heights.min()
    highest = stretched.max()
    if highest > 0:
        stretched /= highest
    return stretched


def _usual_highest(picture: NDArray[Any]) -> float:
    return float(np.iinfo(picture.dtype).max) if picture.dtype.kind == "u" else 1.0


class Surface:
    """The touched surface: one depth image, or two depth images and a blend between them.

    The arrays are copied, in any memory order. A surface never changes, so renderers and threads
    can share it.

    depth          rows x columns, at least 2 x 2; uint8, uint16, float32 or float64 levels,
                   brighter = nearer = higher; held as float32
    to             the next depth image, of the same shape; None: the surface does not move
    blend          0: depth, 1: to
    highest_level  the level of depth 1.0, whose elevation is the parameter `relief`; None: 255 for
                   uint8, 65535 for uint16, 1 for floats
    bump           fine relief added to the whole image: rows x columns of any size, of the same
                   types; its lowest value is 0, its highest the parameter `roughness` [px];
                   None: none
    """

    def __init__(
        self,
        depth: NDArray[Any],
        to: NDArray[Any] | None = None,
        *,
        blend: float = 0.0,
        highest_level: float | None = None,
        bump: NDArray[Any] | None = None,
    ) -> None:
        first = _picture(depth, "depth", 2)
        # As float32, like the levels: no level may be above it by rounding.
        highest = float(np.float32(highest_level or 0.0))
        if highest_level is None:
            highest = _usual_highest(first)
        if not 0 < highest < math.inf:
            raise InputError(f"highest_level: {highest_level} is not a level above 0")
        second = None
        if to is not None:
            second = _picture(to, "to", 2)
            if second.shape != first.shape:
                raise InputError(
                    f"to: its shape is {second.shape}, that of depth is {first.shape}"
                )
            if highest_level is None and _usual_highest(second) != highest:
                raise InputError(
                    f"to: is {second.dtype}, depth is {first.dtype}; "
                    "give highest_level, which both share"
                )
        self._blend = in_range("blend", blend, 0, 1)
        self._shape = first.shape
        self._highest = highest
        self._images = _dibhr.Images(
            _levels(first, "depth", highest),
            None if second is None else _levels(second, "to", highest),
            highest,
            None if bump is None else _bump(bump),
        )

    def blended(self, blend: float) -> Surface:
        """The same images at another blend, 0 to 1; nothing is copied."""
        other = object.__new__(Surface)
        other.__dict__.update(self.__dict__, _blend=in_range("blend", blend, 0, 1))
        return other

    @property
    def shape(self) -> tuple[int, int]:
        """(rows, columns)"""
        return self._shape[0], self._shape[1]

    @property
    def blend(self) -> float:
        """0: depth, 1: to"""
        return self._blend

    @property
    def highest_level(self) -> float:
        """The level of depth 1.0."""
        return self._highest
