"""Goals in, proxy and forces out."""

from __future__ import annotations

import math
from typing import Any, NamedTuple, Sequence

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _dibhr
from ._rows import TOUCH_ROW
from ._surface import Surface
from ._values import InputError, finite_numbers, in_range


class Parameter(NamedTuple):
    """A tunable number, or a switch (0: off, else on): an entry of the table that also makes the
    program's options."""

    name: str  #: the keyword: "static_friction", for the option --static-friction
    label: str  #: "Static friction"
    unit: str  #: "N/mm"; empty for a ratio
    lowest: float
    highest: float
    default: float
    help: str


_WORDS = {name: tuple(words) for name, words, _ in _dibhr.CHOICES}
#: The algorithms by name.
ALGORITHMS: tuple[str, ...] = _WORDS["algorithm"]
#: The table of tunable numbers and switches.
PARAMETERS: tuple[Parameter, ...] = tuple(Parameter._make(entry) for entry in _dibhr.NUMBERS)


class Touch(NamedTuple):
    """The result of one update; (x, y, z) in grid space."""

    goal: tuple[float, float, float]  #: [px]
    proxy: tuple[float, float, float]  #: [px]
    spring_force: tuple[float, float, float]  #: [N], before the safety stage
    sent_force: tuple[float, float, float]  #: [N], after it: limited and ramped up
    contact: bool
    slipping: bool  #: the dynamic coefficient of friction is in effect
    primitive: str  #: under the proxy: "none", "triangle", "edge" or "vertex"
    i: int  #: its column, -1 for none
    j: int  #: its row, -1 for none
    moves: int  #: primitives visited in this update
    cut: str  #: why no force was sent: "late tick", "goal jumped", ...; or empty
    bound_met: bool  #: the update stopped at its bound: the proxy is still catching up


def _step(dt: float) -> float:
    if not 0 < dt < math.inf:
        raise InputError(f"dt: {dt} is not a time above 0")
    return dt


class Renderer:
    """A hand on a surface: goals in, proxy and forces out.

    The keywords are the parameters of `dibhr touch`: `algorithm`, one of ALGORITHMS; the names in PARAMETERS;
    `friction` for both coefficients, unless a coefficient is also given by itself. And `max_force` [N]:
    the limit of the safety stage.

    Only one thread at a time may use a renderer (else BusyError); several renderers run in parallel.
    """

    def __init__(
        self,
        surface: Surface,
        *,
        algorithm: str = "dibhr",
        max_force: float = _dibhr.MAX_FORCE,
        **others: float | str,
    ) -> None:
        self._core = _dibhr.Renderer()
        self._surface = surface
        self.surface = surface
        self._keywords: dict[str, Any] = {each.name: each.default for each in PARAMETERS}
        self._keywords.update({name: default for name, _, default in _dibhr.CHOICES})
        self.set(algorithm=algorithm, max_force=max_force, **others)

    def set(self, **parameters: Any) -> None:
        """Changes parameters, by keyword, for the next update on."""
        ranges = {each.name: (each.lowest, each.highest) for each in PARAMETERS}
        ranges["friction"] = ranges["static_friction"]
        ranges["max_force"] = (0.0, 1000.0)
        given: dict[str, Any] = {}
        for name, value in parameters.items():
            if name in _WORDS:
                if value not in _WORDS[name]:
                    known = ", ".join(_WORDS[name])
                    raise InputError(f"{name}: '{value}' is none of {known}")
                given[name] = value
            elif name in ranges:
                given[name] = in_range(name, value, *ranges[name])
            else:
                known = ", ".join([*_WORDS, *ranges])
                raise InputError(f"{name}: no such parameter; there are {known}")
        if "friction" in given:
            both = given.pop("friction")
            given = {"static_friction": both, "dynamic_friction": both, **given}
        chosen = {**self._keywords, **given}
        fixed, sliding = chosen["static_friction"], chosen["dynamic_friction"]
        if "dynamic_friction" in parameters and sliding > fixed:
            raise InputError(
                f"dynamic_friction {sliding:g} is above the static friction {fixed:g}: "
                "give static_friction of at least as much, or friction for both"
            )
        chosen["dynamic_friction"] = min(sliding, fixed)
        self._core.set(chosen)
        self._keywords = chosen

    @property
    def surface(self) -> Surface:
        """The touched surface. It may be replaced between updates: one of the same shape counts as
        the next frame of a video, another shape resets the renderer."""
        return self._surface

    @surface.setter
    def surface(self, surface: Surface) -> None:
        if not isinstance(surface, Surface):
            raise TypeError("surface: a dibhr.Surface is needed")
        if surface.shape != self._surface.shape:
            self.reset()
        self._surface = surface

    @property
    def parameters(self) -> dict[str, Any]:
        """All parameters, by keyword."""
        return dict(self._keywords)

    def update(self, goal: Sequence[float] | NDArray[Any], dt: float = 0.001) -> Touch:
        """One update of the haptic loop.

        goal  (x, y, z): column, row and elevation [px]
        dt    time since the previous update [s]; after more than 0.02 s no force is sent
        """
        point = finite_numbers(goal, "goal", (3,))
        images, blend = self.surface._images, self.surface._blend
        return Touch._make(self._core.update(images, blend, point, _step(dt)))

    def run(
        self,
        goals: ArrayLike,
        t: ArrayLike | None = None,
        *,
        dt: float = 0.001,
        blend: ArrayLike | None = None,
    ) -> NDArray[np.void]:
        """An update for each goal; other Python threads run meanwhile.

        goals  N x 3: column, row and elevation [px]
        t      N times that do not decrease [s]; None: dt apart
        dt     the length [s] of the first update, and of updates at equal times
        blend  N blends, 0 to 1: of the surface at each update; None: the surface's own

        Returns N rows (TOUCH_ROW) with the columns of `dibhr touch`: t [s]; goal gx, gy, gz and
        proxy px, py, pz [px]; force fx, fy, fz of the spring and cx, cy, cz as sent [N]; contact;
        primitive ("none", "triangle", "edge", "vertex") and its column i and row j; moves, the
        primitives visited; ns, the time of the computation. (Only `update` returns bound_met: the
        bound is far beyond a hand's steps.)
        """
        points = finite_numbers(goals, "goals", (None, 3))
        times = None if t is None else finite_numbers(t, "t", (len(points),))
        if times is not None and (np.diff(times) < 0).any():
            raise InputError("t: time falls; sort the goals by time")
        blends = np.array([self.surface._blend])
        if blend is not None:
            blends = finite_numbers(blend, "blend", (len(points),))
            for value in blends[(blends < 0) | (blends > 1)]:
                in_range("blend", value, 0, 1)
        rows = np.empty(len(points), TOUCH_ROW)
        self._core.run(self.surface._images, blends, points, times, _step(dt), rows)
        return rows

    def reset(self) -> None:
        """Resets all but the parameters: the next update is a first one."""
        self._core.reset()

    def elevation(self, x: ArrayLike, y: ArrayLike) -> NDArray[np.float64]:
        """How high the surface is [px] at N columns x and N rows y, clamped to the image."""
        columns = finite_numbers(x, "x", (None,))
        rows = finite_numbers(y, "y", (len(columns),))
        return self._core.elevation(self.surface._images, self.surface._blend, columns, rows)
