"""Incremental dynamic analysis of a suite, and cloud analysis."""

from __future__ import annotations

import os
from collections.abc import Sequence
from dataclasses import dataclass, field
from functools import cached_property
from pathlib import Path
from typing import Any, Literal

import numpy as np
from numpy.typing import ArrayLike

from . import _rocking
from ._analyses import Progress, peak, physics
from ._inputs import (
    STANDARD_GRAVITY,
    Block,
    Eta,
    Floats,
    Given,
    Model,
    Overturn,
    Record,
    floats,
    frozen,
    given,
    number,
    numbers,
    pair_of,
)
from ._outputs import replace
from ._results import (
    IdaSummary,
    LevelCapacities,
    LevelCrossings,
    PivotForces,
    Ranking,
    StripeResponses,
    axes,
)
from ._statistics import (
    CloudFragility,
    CountsFragility,
    Dispersion,
    LevelFit,
    Method,
    Sample,
    Shift,
    given_sample,
    options,
    seed,
)

By = Literal["record-scaling", "slenderness-adjustment"]
Rule = Literal["median", "first", "last", "monotone"]
Members = Sequence[tuple[Given, dict[str, str]]]

# Numbers of each analysis that differ by level.
_UNITS = {
    "alpha_rad": "rad",
    "pga_g": "g",
    "pgv_m_s": "m s-1",
    "intensity_pga": "1",
    "intensity_pgv": "1",
    "edp": "1",
    "margin": "1",
}


def _members(suite: Sequence[Record] | None) -> Members | None:
    if suite is None:
        return None
    return [(given(record), dict(record.attributes)) for record in suite]


class Curves:
    """The curves of an IDA against one intensity measure."""

    @property
    def _native(self) -> _rocking.IdaCurves:
        raise NotImplementedError

    @property
    def records(self) -> tuple[str, ...]:
        """The names of the records."""
        raise NotImplementedError

    @property
    def events(self) -> tuple[str, ...]:
        """The earthquake of each record; empty where they are not known."""
        raise NotImplementedError

    def sample(self, edp: float, *, rule: Rule = "median") -> Sample:
        """Capacities at one EDP level with the limits of censored ones."""
        levels = [number(edp, "EDP level")]
        found = self._native.capacities(levels, rule)
        values, limits = (table[0] for table in found)
        return Sample(values, limits, self.events, self.records)

    def capacities(self, edp: ArrayLike, *, rule: Rule = "median") -> Floats:
        """Intensity at which each record reaches a response.

        Parameters
        ----------
        edp : float or array_like
            Peak |theta|/alpha; infinite for the first overturning.
        rule : "median", "first", "last" or "monotone"
            Which of several crossings counts.

        Returns
        -------
        ndarray of shape (edp, record), or (record,) for a single edp
            Infinite (censored) if the record never reached it; `sample` has
            the intensity up to which it was run.

        >>> lobe = Record([0.0, 0.2, 0.0], 0.25, units="g", name="lobe")
        >>> found = ida(Block(alpha=0.1, p=3.0), lobe)
        >>> found.capacities(np.inf).round(4)
        array([2.299])
        >>> found.capacities([0.2, 0.5, np.inf]).shape
        (3, 1)
        """
        levels = numbers(edp, "EDP levels")
        flat = np.ravel(levels).tolist()
        found = self._native.capacities(flat, rule)[0]
        return found.reshape(*levels.shape, found.shape[1])

    def demands(self, im: ArrayLike) -> Floats:
        """Response of each record at an intensity.

        Linear between the levels at which the block stays up, infinite from
        the first overturning on. Between the last such level and overturning a
        curve gives no demand, and the call raises an error: use the levels,
        which `step_im` makes the same for every record. `stripes` counts such
        records instead.

        Returns
        -------
        ndarray of shape (im, record), or (record,) for a single im

        >>> lobe = Record([0.0, 0.2, 0.0], 0.25, units="g", name="lobe")
        >>> found = ida(Block(alpha=0.1, p=3.0), lobe, step_im=0.5)
        >>> found.demands([1.5, 2.5]).round(4).tolist()
        [[0.066], [inf]]
        """
        levels = numbers(im, "intensities")
        found = self._native.demands(np.ravel(levels).tolist())
        return found.reshape(*levels.shape, found.shape[1])

    def levels(
        self, edp: ArrayLike, *, rule: Rule = "median"
    ) -> tuple[LevelCapacities, ...]:
        """Quantiles over the records of the capacities at EDP levels."""
        levels = floats(edp, "EDP levels").tolist()
        found = self._native.levels(levels, rule)
        return LevelCapacities._all(found)

    def crossings(
        self, record: str, edp: ArrayLike
    ) -> tuple[LevelCrossings, ...]:
        """All crossings of EDP levels by the curve of one record."""
        levels = floats(edp, "EDP levels").tolist()
        found = self._native.crossings(record, levels)
        return LevelCrossings._all(found)

    def stripes(
        self, ims: ArrayLike, *, edp: float | None = None
    ) -> tuple[StripeResponses, ...]:
        """Responses of the records at given intensities; `edp` is the level
        whose exceedances are counted if every record was run up to the
        intensity."""
        levels = floats(ims, "intensities").tolist()
        return StripeResponses._all(self._native.stripes(levels, edp))

    def fit(
        self,
        edp: ArrayLike,
        *,
        rule: Rule = "median",
        shift: Shift = 0.0,
        method: Method = "mle",
        dispersion: Dispersion = "own",
        quantile_type: int = 5,
        c: float = 1.0,
        n_resamples: int = 0,
        rng: int = 0,
        band: ArrayLike = (),
    ) -> tuple[LevelFit, ...]:
        """Fits a fragility to the capacities at each EDP level, a record that
        does not reach it by the intensity up to which it was run.

        Parameters
        ----------
        edp : array_like
            Peak |theta|/alpha; infinite for overturning.
        rule
            As in `capacities`.
        dispersion : "own" or "common"
            "common" fits one dispersion to all levels, by maximum likelihood,
            so that their curves do not cross; `dispersion_loss` of each fit
            says what it costs.
        shift, method, quantile_type, c, n_resamples, rng, band
            As in `fit_fragility`.
        """
        asked = options(
            shift, method, quantile_type, c, n_resamples, rng, band, dispersion
        )
        levels = floats(edp, "EDP levels").tolist()
        found = LevelFit._all(self._native.fit(levels, rule, asked))
        samples = [
            given_sample(self.sample(level, rule=rule)) for level in levels
        ]
        return tuple(
            fit._remember(samples, place, asked)
            for place, fit in enumerate(found)
        )

    def fit_stripes(
        self,
        ims: ArrayLike,
        *,
        edp: float,
        shift: float = 0.0,
        n_resamples: int = 1000,
        rng: int = 0,
    ) -> CountsFragility:
        """Fits a fragility to the records that exceed `edp` at given
        intensities, by maximum likelihood: to their counts, and where records
        were not run to every intensity to the two analyses next to each
        record's capacity, as `fit` does to its capacity.

        The intervals are those of a bootstrap, which draws each record, or
        earthquake where they are known, in all its stripes.
        """
        levels = floats(ims, "intensities").tolist()
        found = self._native.fit_stripes(
            levels,
            number(edp, "EDP level"),
            number(shift, "shift"),
            n_resamples,
            seed(rng),
        )
        return CountsFragility._of(found)


@dataclass(frozen=True, eq=False, repr=False)
class Ida(Curves):
    """Incremental dynamic analysis of one block over a suite.

    `im[i]` and `edp[i]` are the curve of record i: PGA/(g tan alpha) from the
    onset of rocking (1, 0) to the first overturned level, whose EDP is
    infinite, and with `resurrections_to` beyond. `to_pandas` has one row an
    analysis, `to_csv` is the table of `rocking ida`. Capacities, fits and
    stripes are in PGA/(g tan alpha); `against` gives them in another intensity
    measure.
    """

    _table: _rocking.IdaTable
    _run: _rocking.Run | None = field(default=None, repr=False)
    """The arguments of the run; None for a table that was read."""

    @cached_property
    def setting(self) -> dict[str, Any]:
        """What was analysed, with the names of the table's columns;
        `alpha_rad` is None if slenderness was adjusted, and `order` always:
        the order of the Taylor polynomial is free."""
        return self._table.setting()

    @cached_property
    def _columns(self) -> dict[str, Any]:
        columns = self._table.columns()
        for values in columns.values():
            if isinstance(values, np.ndarray):
                frozen(values)
        return columns

    @cached_property
    def _curves(self) -> list[slice]:
        """Rows of each record."""
        starts = self._table.starts()
        return [slice(a, b) for a, b in zip(starts, [*starts[1:], None])]

    @cached_property
    def _scanned(self) -> Any:
        outcomes = np.asarray(self._columns["outcome"])
        return outcomes != "overturned-refined"

    def _each(self, column: str) -> tuple[Floats, ...]:
        values = self._columns[column]
        return tuple(values[c][self._scanned[c]] for c in self._curves)

    @property
    def records(self) -> tuple[str, ...]:
        """The names of the records."""
        names = self._columns["record"]
        return tuple(names[curve.start] for curve in self._curves)

    @property
    def block(self) -> Block | None:
        """The block; None if its slenderness was adjusted."""
        alpha, p = self.setting["alpha_rad"], self.setting["p_rad_s"]
        return None if alpha is None else Block(alpha=alpha, p=p)

    @property
    def im(self) -> tuple[Floats, ...]:
        """PGA/(g tan alpha) of each record's curve."""
        return self._each("intensity_pga")

    @property
    def edp(self) -> tuple[Floats, ...]:
        """Peak |theta|/alpha of each record's curve."""
        return self._each("edp")

    @property
    def unresolved(self) -> int:
        """Analyses whose peak or fate rounding may have changed."""
        return sum(o == "unresolved" for o in self._columns["outcome"])

    def __repr__(self) -> str:
        return (
            f"Ida(records={len(self.records)}, "
            f"analyses={len(self._columns['record'])}, {self.setting})"
        )

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, Ida):
            return NotImplemented
        return self._table.csv() == other._table.csv()

    def __hash__(self) -> int:
        return hash(self._table.csv())

    def __reduce__(self) -> tuple[Any, ...]:
        run = self._run
        whole = None if run is None else (*run, self._table.summary())
        return _unpickled, (self._table.csv(), run, whole)

    def against(
        self, im: str, suite: Sequence[Record] | None = None
    ) -> ImCurves:
        """The curves against an intensity measure.

        Its name is as on the command line: "pga", which is PGA/(g tan alpha),
        "pgv", which is p PGV/(g tan alpha); and with the records of the
        analysis in `suite` "pgd", "arias", "cav", "pgv-d575" (PGV
        D5-75^(1/4)), "sa:T", "avgsa:T1,T2,..", periods in s, or "column:NAME"
        of the records' attributes, proportional to the acceleration.
        """
        return ImCurves(self, im, None if suite is None else tuple(suite))

    @cached_property
    def events(self) -> tuple[str, ...]:
        """The earthquake of each record; empty where they are not known."""
        return tuple(self._table.events())

    @cached_property
    def _native(self) -> _rocking.IdaCurves:
        return self._table.against("pga", None)

    def summarise(self) -> IdaSummary:
        """The curves in a few numbers; of an analysis that was run here, not
        of a table that was read."""
        return IdaSummary._of(self._table.summary())

    def pivot_forces(
        self, suite: Sequence[Record], friction: ArrayLike
    ) -> PivotForces:
        """How many analyses need more friction |H|/N at the pivot than each
        coefficient; the model does not slide.

        Each analysis is run once more on the records of `suite`, so that it
        takes an IDA that was run here, not a table that was read.
        """
        records = [given(record) for record in suite]
        coefficients = floats(friction, "friction").tolist()
        found = self._table.pivot_forces(records, coefficients)
        return PivotForces._of(found)

    def to_csv(self, path: str | os.PathLike[str]) -> None:
        """Writes the table that `rocking ida` writes and other commands and
        `read_ida` read."""
        replace(Path(path), self._table.csv())

    def to_pandas(self) -> Any:
        """One row an analysis, as a `pandas.DataFrame` with all columns of
        `to_csv`."""
        import pandas

        own = self._columns
        rest = {k: v for k, v in self.setting.items() if k != "alpha_rad"}
        order = ["record", "alpha_rad", "p_rad_s"]
        frame = pandas.DataFrame({**own, **rest})
        return frame[order + [k for k in frame.columns if k not in order]]

    def to_xarray(self) -> Any:
        """The curves as an `xarray.Dataset` over (record, level).

        Level 0 is the onset of rocking, the last level of a record its first
        overturned one, unless resurrections were sought. Curves end at
        different levels: beyond its end a row holds NaN, and the outcome "".
        The variables are columns of `to_pandas`. `overturning_intensity_pga`
        has the first overturning of each record as `capacities` gives it,
        refined, and infinite if the record never overturned the block.
        """
        import xarray

        kept = [
            np.flatnonzero(self._scanned[c]) + c.start for c in self._curves
        ]
        shape = len(kept), max(map(len, kept))
        outcomes = np.asarray(self._columns["outcome"])
        words = np.full(shape, "", dtype=outcomes.dtype)
        tables = {name: np.full(shape, np.nan) for name in _UNITS}
        for i, rows in enumerate(kept):
            words[i, : len(rows)] = outcomes[rows]
            for name, table in tables.items():
                table[i, : len(rows)] = self._columns[name][rows]
        over = ("record", "level")
        variables: dict[str, Any] = {
            name: (over, table, {"units": _UNITS[name]})
            for name, table in tables.items()
        }
        variables["outcome"] = over, words
        overturning = self.capacities(np.inf)
        known = {"units": "1"}
        variables["overturning_intensity_pga"] = "record", overturning, known
        places = {
            "record": np.asarray(self.records),
            "level": np.arange(shape[1]),
        }
        about = {k: v for k, v in self.setting.items() if v is not None}
        return xarray.Dataset(variables, places, about)

    def plot(self, ax: Any = None) -> Any:
        """Draws the curves; gives the matplotlib axes."""
        ax = axes(ax)
        for im, edp in zip(self.im, self.edp):
            ax.plot(edp, im, color="tab:blue", alpha=0.4)
        ax.set(xlabel="peak |theta|/alpha", ylabel="PGA/(g tan alpha)")
        return ax


@dataclass(frozen=True)
class ImCurves(Curves):
    """The curves of an IDA against the intensity measure `im`."""

    ida: Ida
    im: str
    suite: tuple[Record, ...] | None

    def __post_init__(self) -> None:
        # What is refused is refused here.
        _ = self._native

    @property
    def records(self) -> tuple[str, ...]:
        """The names of the records."""
        return self.ida.records

    @property
    def events(self) -> tuple[str, ...]:
        """The earthquake of each record; empty where they are not known."""
        return self.ida.events

    @cached_property
    def _native(self) -> _rocking.IdaCurves:
        return self.ida._table.against(self.im, _members(self.suite))

    def __reduce__(self) -> tuple[Any, ...]:
        return ImCurves, (self.ida, self.im, self.suite)


def _events(records: Sequence[Record]) -> list[str]:
    """The attribute `event` of all records; empty if none has it."""
    found = [record.attributes.get("event", "") for record in records]
    if not any(found):
        return []
    if not all(found):
        name = records[found.index("")].name
        raise ValueError(
            f"record {name}: no attribute event: expected the earthquake of "
            "every record, or of none"
        )
    return found


def _codes(record: Record) -> str:
    """The codes of the remarks, each once, as `rocking ida` writes them."""
    codes = dict.fromkeys(text.partition(":")[0] for text in record.remarks)
    return " ".join(codes)


def _unpickled(
    csv: str, run: _rocking.Run | None, whole: _rocking.WholeRun | None
) -> Ida:
    return Ida(_rocking.ida_of_csv(csv, whole), run)


def read_ida(path: str | os.PathLike[str]) -> Ida:
    """Reads the table of `rocking ida`, or of `Ida.to_csv`.

    Parameters
    ----------
    path : str or path-like

    >>> from pathlib import Path
    >>> from tempfile import TemporaryDirectory
    >>> lobe = Record([0.0, 0.2, 0.0], 0.25, units="g", name="lobe")
    >>> found = ida(Block(alpha=0.1, p=3.0), lobe)
    >>> with TemporaryDirectory() as folder:
    ...     found.to_csv(Path(folder, "ida.csv"))
    ...     read_ida(Path(folder, "ida.csv")) == found
    True
    """
    return Ida(_rocking.read_ida(path))


def ida(
    block: Block,
    suite: Record | Sequence[Record],
    *,
    step_g: float | None = None,
    step_im: float | None = None,
    refine: float | None = 1e-4,
    by: By = "record-scaling",
    eta: Eta = 0.92,
    model: Model = "nonlinear",
    overturn: Overturn = "alpha",
    certify: bool = False,
    highest_im: float = 100.0,
    resurrections_to: float | Literal[True] | None = None,
    gravity: float = STANDARD_GRAVITY,
    threads: int | None = None,
    progress: Progress | None = None,
) -> Ida:
    """Raises the intensity of every record until the block overturns.

    Results refer to records by their names. If no record has a name, they are
    numbered from 1.

    Parameters
    ----------
    block : Block
    suite : Record or sequence of Record
    step_g, step_im : float, at most one of them
        Step of the levels: in PGA (g; 0.01 unless given), or in
        PGA/(g tan alpha) from 1.
    refine : float or None
        Width in PGA/(g tan alpha) to which the first overturning is bisected.
    by : "record-scaling" or "slenderness-adjustment"
        Scale the record, or keep it and adjust alpha.
    certify : bool
        Decide each analysis in the precision that it needs, instead of
        counting it as unresolved.
    eta, model, overturn
        As in `respond`.
    highest_im : float
        The intensity at which curves end that never overturn.
    resurrections_to : float or True, optional
        Go on above the first overturning and find where the block stays up
        again: to this PGA/(g tan alpha), or to 3 times the first overturning.
        `Ida.summarise` counts these levels; capacities do not change.
    gravity : float
        In m/s2, for velocities and for intensity measures.
    threads : int
        All processors unless given; at most eight a processor are started.
        The result does not depend on it.
    progress : callable
        Called now and then with (curves done, curves), in the calling thread.
        An exception in it ends the analysis; so does Ctrl-C.

    >>> lobe = Record([0.0, 0.2, 0.0], 0.25, units="g", name="lobe")
    >>> found = ida(Block(alpha=0.1, p=3.0), lobe)
    >>> float(found.im[0][0]), float(found.edp[0][-1])
    (1.0, inf)
    """
    if step_g is not None and step_im is not None:
        raise ValueError("step_g and step_im: expected at most one of them")
    if step_g is None and step_im is None:
        step_g = 0.01
    records = [suite] if isinstance(suite, Record) else list(suite)
    if not records:
        raise ValueError("no record: expected at least one")
    upward = None
    if resurrections_to is True:
        upward = True, 3.0
    elif resurrections_to is not None:
        upward = False, number(resurrections_to, "resurrections_to")
    scan: _rocking.Scan = {
        "step_g": step_g,
        "step_im": step_im,
        "refine": refine,
        "by": by,
        "certify": certify,
        "highest_im": number(highest_im, "highest_im"),
        "resurrections": upward,
    }
    run = pair_of(block), physics(eta, model, overturn), scan
    events = _events(records) or [""] * len(records)
    found = _rocking.ida(
        run[0],
        [given(record) for record in records],
        [*zip(map(_codes, records), events)],
        *run[1:],
        number(gravity, "gravity"),
        threads,
        progress,
    )
    return Ida(found, run)


def rank_ims(
    ida: Ida,
    suite: Sequence[Record],
    *,
    ims: Sequence[str] = (),
    edp: float = float("inf"),
    rule: Rule = "median",
    magnitude: str | None = None,
    distance: str | None = None,
    n_resamples: int = 1000,
    rng: int = 0,
) -> Ranking:
    """Intensity measures by their efficiency and their sufficiency.

    Efficiency is the dispersion of the capacities in a measure, by maximum
    likelihood, records that do not reach the response by the intensity up to
    which they were run. Sufficiency is the slope of ln(capacity) on magnitude
    and on the logarithm of distance, with a random intercept for each
    earthquake where they are known.

    Parameters
    ----------
    ida : Ida
        Of the records of `suite`, in their order.
    suite : sequence of Record
    ims : sequence of str
        Names as in `Ida`; those of `rocking rank` unless given. Ratios are
        to the first one.
    edp : float
        Response whose capacities are compared; infinite for overturning.
    rule
        As in `Ida.capacities`.
    magnitude, distance : str
        Names of the records' attributes.
    n_resamples, rng : int
        Bootstrap samples of records, of earthquakes where they are known,
        and their repetition.

    >>> from rocking import Block, ida
    >>> suite = [
    ...     Record([0.0, 0.2, 0.0], dt, units="g", name=f"{dt} s")
    ...     for dt in (0.2, 0.25, 0.3, 0.4)
    ... ]
    >>> analysed = ida(Block(alpha=0.1, p=3.0), suite)
    >>> found = rank_ims(analysed, suite, ims=["pga", "sa:1"], n_resamples=99)
    >>> [measure.im for measure in found.measures]
    ['PGA/(g tan alpha)', 'SA(1 s) (g)']
    """
    members = _members(suite) or []
    found = ida._table.rank(
        members,
        list(ims),
        float(edp),
        rule,
        magnitude,
        distance,
        n_resamples,
        seed(rng),
    )
    return Ranking._of(found)


def cloud(
    block: Block,
    suite: Sequence[Record],
    edp: ArrayLike,
    *,
    im: str = "pga",
    shift: float = 0.0,
    eta: Eta = 0.92,
    model: Model = "nonlinear",
    gravity: float = STANDARD_GRAVITY,
    n_resamples: int = 1000,
    rng: int = 0,
) -> CloudFragility:
    """Cloud analysis: fragilities from the responses to unscaled records.

    ln EDP = a + b ln(IM - shift) + sigma eps over the records as they are, EDP
    the peak |theta|/alpha. If the block overturns, EDP is known only to be at
    least 1 (Tobit regression). Records that do not rock the block, or whose
    intensity is not above the shift, are left out and counted. The fragility
    of a level is lognormal above the shift, with median shift + exp((ln edp -
    a)/b) and dispersion sigma/b.

    Parameters
    ----------
    block : Block
    suite : sequence of Record
    edp : array_like
        Levels of EDP up to 1; 1 and infinity are overturning, |theta| = alpha.
    im : str
        Intensity measure by its name as in `Ida.against`; "pga" is
        PGA/(g tan alpha).
    shift : float
        Intensity up to which nothing rocks, such as 1 of "pga".
    eta, model
        As in `peak`.
    gravity : float
        In m/s2, for intensity measures.
    n_resamples, rng : int
        Bootstrap samples of records, of earthquakes where they are known,
        and their repetition.

    >>> from rocking import embedded_suite
    >>> suite = embedded_suite("ordinary")
    >>> block = Block(alpha=0.2, p=3.0)
    >>> found = cloud(block, suite, [0.5, 1.0], shift=1.0, n_resamples=99)
    >>> found.n, found.not_rocking, found.overturned
    (86, 15, 27)
    >>> [round(level.fitted.median, 2) for level in found.levels]
    [1.96, 2.23]
    """
    records = list(suite)
    as_they_are: Any = {"levels": 1.0, "by": "scale"}
    peaks = peak(block, records, **as_they_are, eta=eta, model=model)
    found = _rocking.cloud(
        pair_of(block),
        _members(records) or [],
        peaks.tolist(),
        _events(records),
        model,
        number(gravity, "gravity"),
        im,
        floats(edp, "EDP levels").tolist(),
        number(shift, "shift"),
        n_resamples,
        seed(rng),
    )
    return CloudFragility._of(found)
