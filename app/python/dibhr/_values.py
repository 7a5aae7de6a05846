"""The errors, and the checks of arguments."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray


class Error(Exception):
    """An error of dibhr, as one plain line; the base class of the other errors."""


class InputError(Error, ValueError):
    """A value, an array or a file that cannot be used."""


class MissingFileError(InputError, FileNotFoundError):
    """There is no such file."""


class BusyError(Error, RuntimeError):
    """Another thread is using the renderer."""


def in_range(what: str, value: float, lowest: float, highest: float) -> float:
    try:
        number = float(value)
    except (TypeError, ValueError):
        number = math.nan
    if not math.isfinite(number):
        raise InputError(f"{what}: '{value}' is not a number")
    if not lowest <= number <= highest:
        raise InputError(f"{what}: {value} is not in {lowest:g} to {highest:g}")
    return number


def as_array(given: Any, what: str) -> NDArray[Any]:
    """numpy's array; rows of different lengths give an empty one, refused later."""
    if isinstance(given, np.ma.MaskedArray) and given.mask.any():
        raise InputError(f"{what}: some of its values are masked; fill them")
    try:
        return np.asarray(given)
    except ValueError:
        return np.empty(0, object)


def finite_numbers(
    given: ArrayLike, what: str, shape: tuple[int | None, ...]
) -> NDArray[np.float64]:
    """Finite numbers of this shape, in which None is any length."""
    array = as_array(given, what)
    if array.dtype.kind not in "fiu":
        raise InputError(f"{what}: real numbers are needed")
    fits = [want in (None, have) for want, have in zip(shape, array.shape)]
    if array.ndim != len(shape) or not all(fits):
        wanted = str(shape).replace("None", "N")
        raise InputError(f"{what}: its shape is {array.shape}; {wanted} is needed")
    numbers = np.ascontiguousarray(array, np.float64)
    right = np.isfinite(numbers)
    if not right.all():
        place = np.argwhere(~right)[0]
        raise InputError(f"{what}{place.tolist()}: {numbers[tuple(place)]} is not a finite number")
    return numbers
