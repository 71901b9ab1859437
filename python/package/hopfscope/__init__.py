"""How dry friction turns a Hopf bifurcation into a basin that one must know.

The oscillator ``q'' + 2 D q' + D2 q'^2 + D3 q'^3 + q = friction, within -r .. r`` is without units; a machine, a mass on
its belt, is in SI units. Every function takes what it is about first: ``Parameters``, a ``Machine``, or the name of a
scene or a machine; or its numbers alone, as in ``cycles(D=-0.3, D3=0.5, r=0.1)``. Options have the names and forms that
they have on the command line, numbers also as numbers: ``over="D=-1:0:50"`` or ``over=("D", -1, 0, 50)``.

An answer has the fields of the program's JSON document (``docs/command-line.md``), digit for digit: rows as a ``Table`` of
numpy arrays with ``to_dataframe()`` and ``to_xarray()``, and ``provenance``. What does not exist is None, in arrays NaN.
"""

from __future__ import annotations

import os
import warnings
from typing import TYPE_CHECKING, Any, ClassVar, Dict, List, Optional, Sequence, Tuple, Type, TypeVar, Union

from . import _hopfscope
from ._answers import Answer, Error, IncompleteWarning, InputError, Record, Table
from ._hopfscope import Machine, Parameters

if TYPE_CHECKING:
    import numpy as np
    import xarray as xr

__all__ = [
    "Answer", "Error", "IncompleteWarning", "InputError", "Machine", "Parameters", "Record", "Table",
    "basin", "border", "branch", "cycles", "fit", "kicks", "level", "margin", "scan", "trajectory",
]  # fmt: skip

#: What a question is about.
Source = Union[Parameters, Machine, str, None]
#: A value, one with a unit or a tolerance as text, or in ``margin`` both ends of an interval.
Number = Union[float, str, Tuple[float, float]]
#: ``"NAME=FROM:TO:COUNT"`` or ``(name, from, to, count)``.
Over = Union[str, Tuple[Any, ...]]
_A = TypeVar("_A", bound=Answer)


class Events(Table):
    """Arrivals at v = 0 after the start: time and displacement, arrays over all of them."""

    tau: "np.ndarray"
    q: "np.ndarray"


class Samples(Table):
    """A motion at times: time, displacement and velocity."""

    tau: "np.ndarray"
    q: "np.ndarray"
    v: "np.ndarray"


class Motion(Answer):
    """One motion: ``outcome`` (its ``kind`` and where), ``events``, and the ledger of ``energy``; ``samples`` if asked for."""

    outcome: Record
    events: Events
    samples: Samples
    energy: Record
    _kinds: ClassVar = {"events": Events, "samples": Samples}


class CycleTable(Table):
    """Limit cycles by amplitude: extremes, period, Floquet multiplier, and clearance, the distance to the sticking set."""

    stable: "np.ndarray"
    q_min: "np.ndarray"
    q_max: "np.ndarray"
    v_min: "np.ndarray"
    v_max: "np.ndarray"
    period: "np.ndarray"
    multiplier: "np.ndarray"


class Cycles(Answer):
    """Every limit cycle, and in ``basin.edge`` what borders the basin of rest: none, cycle or separatrix."""

    cycles: CycleTable
    basin: Record
    _kinds: ClassVar = {"cycles": CycleTable}


class Points(CycleTable):
    """Cycles along a number: its ``value``, and the numbers of ``CycleTable``."""

    value: "np.ndarray"


class Special(Table):
    """Special points: their ``kind`` (fold, escape, hopf, zero-crossing ..), and where they are."""

    kind: "np.ndarray"
    value: "np.ndarray"
    q_max: "np.ndarray"


class Branch(Answer):
    """The cycles along ``parameter``, and the special points between them."""

    parameter: str
    points: Points
    special: Special
    _kinds: ClassVar = {"points": Points, "special": Special}


class Basin(Answer):
    """How many starts end where (``counts``), and the ``margin``: the smallest kick that is not survived."""

    counts: Record
    margin: Record


class Margin(Answer):
    """The smallest kick that is not survived: ``nominal``, and ``guaranteed`` whatever is not known and whatever disturbs.

    Each has ``displacement``, ``impulse`` and ``from_rest``; None where every kick is survived, or, of ``guaranteed``, where
    nothing is, for the ``reason`` there.
    """

    nominal: Record
    guaranteed: Record


class Scan(Table):
    """A row for each point, the last number of ``over`` varying fastest: what it depends on, what was measured, why not."""

    over: Dict[str, "np.ndarray"]
    provenance: Record

    def __init__(self, columns: Any, inputs: Sequence[str] = (), over: Any = None, provenance: Any = None) -> None:
        super().__init__(columns)
        self.inputs, self.over, self.provenance = inputs, over or {}, provenance

    def to_xarray(self) -> "xr.Dataset":
        """As an xarray Dataset over the numbers of ``over``; what else it depends on, and its command, as attributes."""
        import xarray

        shape = [len(values) for values in self.over.values()]
        if not shape:
            return super().to_xarray()
        measured = {name: (tuple(self.over), self[name].reshape(shape)) for name in self.keys() if name not in self.inputs}
        same = {name: self[name][0] for name in self.inputs if name not in self.over}
        return xarray.Dataset(measured, self.over, {**same, "command": self.provenance.command})


def _text(value: Any, between: str = "=::") -> str:
    """A value as the command line has it."""
    if isinstance(value, str):
        return value
    if isinstance(value, os.PathLike):
        return str(os.fspath(value))
    if isinstance(value, (tuple, list)):
        parts = [_text(part) for part in value]
        ends = [*between[: len(parts) - 1], *":" * len(parts)]
        return parts[0] + "".join(end + part for end, part in zip(ends, parts[1:]))
    if hasattr(value, "__index__"):
        return str(int(value))
    return repr(float(value))


#: What stands between the parts of these options.
_BETWEEN = {"window": ":,:", "grid": "x"}


def _words(command: str, source: Source, numbers: Dict[str, Any], options: Dict[str, Any]) -> List[str]:
    words = [command]
    if isinstance(source, Parameters):
        numbers = {**source.to_dict(), **numbers}
    elif isinstance(source, Machine):
        words += source.words
    elif source is not None:
        words.append(source)
    for name, value in numbers.items():
        ends = isinstance(value, (tuple, list))
        words += ["--set", f"{name}={'..'.join(map(_text, value)) if ends else _text(value)}"]
    for name, given in options.items():
        option = "--" + name.replace("_", "-")
        if given is True:
            words.append(option)
        elif given is not None and given is not False:
            many = given if isinstance(given, list) else [given]
            words += [word for one in many for word in (option, _text(one, _BETWEEN.get(name, "=::")))]
    return words


def _ask(kind: Type[_A], command: str, source: Source, numbers: Dict[str, Any], **options: Any) -> _A:
    machine = source if isinstance(source, Machine) else None
    words = _words(command, source, numbers, options)
    return _answered(kind, *_hopfscope.ask(words, machine))


def _answered(kind: Type[_A], found: Any, trouble: Optional[str]) -> _A:
    if trouble is not None:
        warnings.warn(trouble, IncompleteWarning, stacklevel=4)
    return kind(found)


def _named(numbers: Dict[str, Any]) -> Tuple[Source, Dict[str, Any]]:
    """Parameters of these numbers; what is not a plain number is left to the program."""
    if any(isinstance(number, (str, tuple, list)) for number in numbers.values()):
        return None, numbers
    return Parameters(**numbers), {}


def trajectory(
    source: Source = None,
    /,
    *,
    q0: Optional[float] = None,
    v0: Optional[float] = None,
    until: Optional[float] = None,
    method: Optional[str] = None,
    tol: Optional[float] = None,
    times: Optional[Sequence[float]] = None,
    sample: Optional[float] = None,
    certify: bool = False,
    **numbers: Number,
) -> Motion:
    """One motion from displacement ``q0`` and velocity ``v0`` (of a machine ``x`` in m, ``v`` in m/s) until a time.

    ``times`` up to ``until``, an array in any order, or every ``sample`` gives ``samples``, the exact motion at these times:
    NaN after an escape. The command in ``provenance`` reads ``times`` from its standard input. ``method`` and ``tol``, the relative error of a step, choose the integrator; ``certify`` encloses the answer.
    """
    if source is None:
        source, numbers = _named(numbers)
    of_machine = isinstance(source, Machine)
    if isinstance(source, str) or certify or sample is not None or (of_machine and (method or tol)):
        if times is not None:
            raise InputError("times go with Parameters or a Machine followed by its own method, without certify or sample")
        start = {name: value for name, value in [("q0", q0), ("v0", v0)] if value is not None}
        options = dict(until=until, method=method, tol=tol, sample=sample, certify=certify)
        return _ask(Motion, "trajectory", source, {**numbers, **start}, **options)
    at = None
    if times is not None:
        import numpy

        at = numpy.asarray(times, dtype=float).ravel()
    source = source.replace(**numbers) if numbers else source  # type: ignore[union-attr,arg-type]
    found = _hopfscope.trajectory(source, q0=q0, v0=v0, until=until, method=method, tol=tol, times=at)  # type: ignore[arg-type]
    return _answered(Motion, *found)


def cycles(
    source: Source = None,
    /,
    *,
    certify: bool = False,
    harmonics: Optional[int] = None,
    orbit: Optional[int] = None,
    **numbers: Number,
) -> Cycles:
    """Every limit cycle; with ``certify`` the proof that there are no others, and bounds of each number.

    ``orbit`` adds the column ``orbit``: a table of so many points (tau, q, v) of one period for each cycle. ``harmonics``
    adds the harmonic balance with 1, 3, 5, .. harmonics as ``balance``. Intervals of numbers are proved.
    """
    plain = not certify and harmonics is None and orbit is None
    if source is None and plain:
        source, numbers = _named(numbers)
    if isinstance(source, Parameters) and plain and not numbers:
        return Cycles(_hopfscope.cycles(source))
    return _ask(Cycles, "cycles", source, numbers, harmonics=harmonics, orbit=orbit)


def branch(
    source: Source = None, /, *, over: Over, certify: bool = False, orbit: Optional[int] = None, **numbers: Number
) -> Branch:
    """The limit cycles along a number, ``over=("D", -1, 0, 200)``, with folds and other special points.

    The number of points is approximate for D, D2, D3 and r. ``orbit`` adds so many points of each cycle, as in ``cycles``.
    """
    return _ask(Branch, "branch", source, numbers, over=over, certify=certify, orbit=orbit)


def border(
    source: Source = None, /, *, over: Over, along: Optional[Over] = None, certify: bool = False, **numbers: Number
) -> Answer:
    """The fold and the escape point in D along a second parameter; of a machine, the changes ``along`` a number of it."""
    return _ask(Answer, "border", source, numbers, over=over, along=along, certify=certify)


def basin(
    source: Source = None,
    /,
    *,
    window: Union[str, Sequence[float], None] = None,
    grid: Union[str, Tuple[int, int], None] = None,
    certify: bool = False,
    labels: bool = False,
    curves: bool = False,
    **numbers: Number,
) -> Basin:
    """Where the starts of a ``window`` (q_min, q_max, v_min, v_max) end, on a ``grid`` (across q, across v), and the margin.

    ``labels`` adds where each start ends: ``labels``, an array (len(v), len(q)) of indices into ``legend``, and the axes ``q``
    and ``v``. ``curves`` adds the border and the return map as points ``x``, ``y``.
    """
    options = dict(window=window, grid=grid, certify=certify, labels=labels, curves=curves)
    return _ask(Basin, "basin", source, numbers, **options)


def margin(
    source: Source = None, /, *, disturbance: Union[float, str, None] = None, **numbers: Number
) -> Margin:
    """How large a kick is survived, and how large for certain under every disturbing force of at most ``disturbance``.

    Numbers may be intervals, ``r=(0.09, 0.11)``, within which the guaranteed margin holds.
    """
    if source is None:
        source, numbers = _named(numbers)
    if isinstance(source, Parameters) and not isinstance(disturbance, str) and not numbers:
        return Margin(_hopfscope.margin(source, disturbance or 0.0))
    return _ask(Margin, "margin", source, numbers, disturbance=disturbance)


def kicks(source: Source = None, /, *, kicks: str, **numbers: Number) -> Answer:
    """The share of random kicks that is lost, and how many in a row are survived: ``kicks="q=0+-0.1,v=0+-0.05"``."""
    return _ask(Answer, "kicks", source, numbers, kicks=kicks)


def level(
    source: Source = None,
    /,
    *,
    of: Union[str, Tuple[str, float]],
    over: List[Over],
    window: Union[str, Sequence[float], None] = None,
    until: Optional[float] = None,
    kicks: Optional[str] = None,
    disturbance: Union[float, str, None] = None,
    half_width: Union[List[Tuple[str, float]], Tuple[str, float], None] = None,
    design: Union[str, Tuple[str, float], None] = None,
    **numbers: Number,
) -> Answer:
    """The ``curves`` over two numbers along which a column of ``scan`` has a value: ``of=("impulse", 0.2)``.

    ``over=[("D", -1, 0), ("r", 0, 1)]``, the first to the right; ``points`` of a curve are an array (N, 2). What a column
    depends on is given as in ``scan``.
    """
    options = dict(of=of, over=over, window=window, until=until, kicks=kicks, disturbance=disturbance)
    return _ask(Answer, "level", source, numbers, **options, half_width=half_width, design=design)


def scan(
    source: Source = None,
    /,
    *,
    over: Union[Over, List[Over], None] = None,
    measure: Union[str, Sequence[str]],
    points: Union[str, os.PathLike[str], None] = None,
    jobs: Optional[int] = None,
    window: Union[str, Sequence[float], None] = None,
    until: Optional[float] = None,
    kicks: Optional[str] = None,
    disturbance: Union[float, str, None] = None,
    half_width: Union[List[Tuple[str, float]], Tuple[str, float], None] = None,
    design: Union[str, Tuple[str, float], None] = None,
    certify: bool = False,
    **numbers: Number,
) -> Scan:
    """Measures (``margin``, ``cycles``, .. as ``hopfscope scan --help`` lists them) at every point of a line or grid.

    ``points`` is a file of comma-separated values with the numbers of each point, in place of ``over``. On all cores, or as
    many as ``jobs``.
    """
    options: Dict[str, Any] = dict(over=over, points=points, jobs=jobs, window=window, until=until, kicks=kicks)
    options.update(disturbance=disturbance, half_width=half_width, design=design, certify=certify)
    options["measure"] = measure if isinstance(measure, str) else ",".join(measure)
    words = _words("scan", source, numbers, options)
    found = _hopfscope.scan(words, source if isinstance(source, Machine) else None)
    return Scan(**found)


def fit(file: Union[str, os.PathLike[str]], /, **options: Any) -> Answer:
    """Estimates D, D2, D3, r and more of a recorded motion, with errors, and the margin that follows.

    ``file`` has a column of times and one of displacements; options are those of ``hopfscope fit``.
    """
    return _ask(Answer, "fit", os.fspath(file), {}, **options)
