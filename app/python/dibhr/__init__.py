"""dibhr: depth image-based haptic rendering, from numpy arrays to forces.

    import dibhr, numpy as np
    surface = dibhr.Surface(depth)                   # rows x columns, uint8 or other levels
    renderer = dibhr.Renderer(surface, stiffness=0.8, friction=0.3)
    touch = renderer.update((120, 80, 90))           # one goal: touch.proxy, touch.sent_force
    rows = renderer.run(goals)                       # N x 3 goals: rows["px"], rows["fz"], ...
    ticks = dibhr.Session("mine.dibhr").ticks()      # recorded ticks, with the same column names

Grid space throughout: x = column, y = row (down), z = elevation towards the viewer, all in pixels
of the depth image. Forces are newtons along the same axes, times seconds.
"""

import importlib.util as _importing
import sys as _sys

if _importing.find_spec("._dibhr", __name__) is None:
    raise ImportError(
        f"the compiled part of dibhr is not beside {__file__} for Python "
        f"{_sys.version_info.major}.{_sys.version_info.minor}: build it with "
        "app/prepare release dibhr_python in dibhr's folder, and import dibhr with "
        "PYTHONPATH=build/release/python"
    )

from . import _dibhr
from ._renderer import ALGORITHMS, PARAMETERS, Parameter, Renderer, Touch
from ._rows import TICK_ROW, TOUCH_ROW, vectors
from ._session import Session
from ._surface import Surface
from ._values import BusyError, Error, InputError, MissingFileError

__all__ = [
    "ALGORITHMS",
    "PARAMETERS",
    "TICK_ROW",
    "TOUCH_ROW",
    "BusyError",
    "Error",
    "InputError",
    "MissingFileError",
    "Parameter",
    "Renderer",
    "Session",
    "Surface",
    "Touch",
    "vectors",
]

__version__ = _dibhr.VERSION

for _name in __all__:
    if callable(globals()[_name]):
        globals()[_name].__module__ = __name__  # the public name, for help() and pickle
