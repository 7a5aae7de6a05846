"""The rows of runs and sessions, as structured arrays."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

_REALS = "t gx gy gz px py pz fx fy fz cx cy cz".split()
_TOUCH_FIELDS = [(name, "f8") for name in _REALS] + [("contact", "?"), ("primitive", "U8")]
_TOUCH_FIELDS += [(name, "i8") for name in ("i", "j", "moves", "ns")]
_TICK_FIELDS = [
    *(("tick", "i8"), ("utc_s", "f8"), ("video_s", "f8"), ("blend", "f8")),
    *((name, "i8") for name in ("frame", "to_frame", "pair", "source", "settings")),
    *(("dt_s", "f8"), ("lateness_us", "f8"), ("buttons", "i8"), ("cut", "i8")),
    *((name, "?") for name in ("surface", "ready", "stand_in", "restart", "lets_go", "refused")),
    *((name, "f8") for name in ("ox", "oy", "oz")),
]
#: A row of Renderer.run: the columns of `dibhr touch`.
TOUCH_ROW: np.dtype[np.void] = np.dtype(_TOUCH_FIELDS, align=True)
#: A row of Session.ticks: the columns of `dibhr export`.
TICK_ROW: np.dtype[np.void] = np.dtype(_TOUCH_FIELDS + _TICK_FIELDS, align=True)


def vectors(rows: NDArray[np.void], name: str) -> NDArray[np.float64]:
    """The three columns of a vector as N x 3.

    rows  of Renderer.run or Session.ticks
    name  "g" goal and "p" proxy [px], "f" spring force and "c" force sent [N]
    """
    return np.stack([rows[name + axis] for axis in "xyz"], axis=-1)
