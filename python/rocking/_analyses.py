"""What blocks do: single responses, peaks of many, IDA."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from typing import Any, Literal

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _draw, _rocking
from ._inputs import (
    STANDARD_GRAVITY,
    Block,
    Floats,
    Frozen,
    Pulse,
    Record,
    floats,
    frozen,
    given,
)

Progress = Callable[[int, int], object]

OUTCOMES = (
    "no-uplift",
    "rocked",
    "overturned",
    "unresolved",
    "overturned-refined",
)

# Numbers of each analysis that differ by level.
_UNITS = {
    "alpha_rad": "rad",
    "pga_g": "g",
    "pgv_m_s": "m s-1",
    "im_pga": "1",
    "im_pgv": "1",
    "edp": "1",
    "margin": "1",
}


def _physics(
    eta: float | Literal["housner"], model: str, overturn: str
) -> _rocking.Physics:
    if isinstance(eta, str):
        if eta != "housner":
            raise ValueError(f"eta {eta!r}: expected a number, or 'housner'")
        number = None
    else:
        number = float(eta)
    return {"eta": number, "model": model, "overturn": overturn}


@dataclass(frozen=True, eq=False)
class Response(Frozen):
    """What one block did under one excitation.

    Times are in s. `repr` leaves the arrays out.
    """

    outcome: str
    """"no-uplift", "rocked" or "overturned"."""
    peak_ratio: float
    """Peak |theta|/alpha, infinite where it overturned."""
    resolved: bool
    """False where rounding may have changed outcome or peak; `certify=True`
    then tells them in wider arithmetic."""
    fate_margin: float
    """Distance from the other fate, in units of alpha."""
    error_estimate: float | None
    """Bound on the error of the peak; None where a decision is not clear."""
    peak_time: float | None
    uplift_time: float | None
    rest_time: float | None
    overturning_time: float | None
    overturning_side: float | None
    """Sign of theta at overturning."""
    certified_by: str | None
    """Arithmetic that decided, with `certify=True`."""
    impacts: Floats = field(repr=False)
    """(n, 2): time, and angular velocity before it in rad/s."""
    history: Floats = field(repr=False)
    """(n, 3): time, theta in rad, angular velocity in rad/s; empty unless
    `history_dt` was given."""

    @property
    def overturned(self) -> bool:
        """Whether it overturned."""
        return self.outcome == "overturned"

    def to_pandas(self) -> Any:
        """The history as a `pandas.DataFrame`, its index the time."""
        import pandas

        index = pandas.Index(self.history[:, 0], name="t")
        columns = ["theta", "omega"]
        return pandas.DataFrame(self.history[:, 1:], index, columns)

    def to_xarray(self) -> Any:
        """The history as an `xarray.Dataset` over t, with the impacts over
        impact_time."""
        import xarray

        t, theta, omega = self.history.T
        time, before = self.impacts.T
        speed = {"units": "rad s-1"}
        return xarray.Dataset(
            {
                "theta": ("t", theta, {"units": "rad"}),
                "omega": ("t", omega, speed),
                "impact_omega": ("impact_time", before, speed),
            },
            {
                "t": ("t", t, {"units": "s"}),
                "impact_time": ("impact_time", time, {"units": "s"}),
            },
            {"outcome": self.outcome, "peak_ratio": self.peak_ratio},
        )

    def _repr_html_(self) -> str:
        words = f"{self.outcome}, peak |theta|/alpha {self.peak_ratio:.6g}"
        if not self.resolved:
            words += " (unresolved)"
        curve = (self.history[:, 0], self.history[:, 1])
        return _draw.lines([curve], "t, s", "theta, rad", words)


def respond(
    block: Block,
    excitation: Record | Pulse,
    *,
    eta: float | Literal["housner"] = 0.92,
    model: str = "nonlinear",
    overturn: str = "alpha",
    im: float | None = None,
    pga_g: float | None = None,
    scale: float | None = None,
    history_dt: float | None = None,
    certify: bool = False,
) -> Response:
    """What a block does under a record or a pulse.

    Parameters
    ----------
    eta : float or "housner"
        Coefficient of restitution, a ratio of angular velocities.
    model : "nonlinear" (Eq. 1) or "linearized" (Eq. 2)
    overturn : "alpha" (|theta| reaches alpha) or "half-pi"
    im, pga_g, scale : float, at most one of them
        Scale the excitation to PGA/(g tan alpha), to a PGA in g, or by a
        factor.
    history_dt : float
        Record the rotation every so many seconds.
    certify : bool
        Tell outcome and peak in the precision that they need.

    >>> sine = Pulse("one-sine", amplitude_g=0.15, omega=12.0)
    >>> respond(Block(alpha=0.1, p=3.0), sine, im=0.99).outcome
    'no-uplift'
    """
    asked = [
        (name, value)
        for name, value in (("im", im), ("pga_g", pga_g), ("scale", scale))
        if value is not None
    ]
    if len(asked) > 1:
        names = " and ".join(name for name, _ in asked)
        raise ValueError(f"{names}: expected at most one of im, pga_g, scale")
    by, level = asked[0] if asked else ("scale", 1.0)
    found = _rocking.respond(
        (block.alpha, block.p),
        given(excitation),
        _physics(eta, model, overturn),
        by,
        float(level),
        history_dt,
        certify,
    )
    frozen(found["impacts"])
    frozen(found["history"])
    return Response(**found)


def peak(
    blocks: Block | Sequence[Block],
    excitations: Record | Pulse | Sequence[Record | Pulse],
    *,
    levels: ArrayLike,
    by: str = "im",
    eta: float | Literal["housner"] = 0.92,
    model: str = "nonlinear",
    overturn: str = "alpha",
    threads: int | None = None,
    progress: Progress | None = None,
) -> Floats:
    """Peak |theta|/alpha of each block under each excitation at each level.

    Parameters
    ----------
    levels : float or array_like
        PGA/(g tan alpha) for `by="im"`, PGA in g for `by="pga_g"`, factors
        for `by="scale"`.
    threads : int
        All processors unless given.
    progress : callable
        Called now and then with (done, total), in the calling thread.

    Returns
    -------
    ndarray of shape (block, excitation, level)
        Infinite where the block overturned. As with a ufunc, an axis is
        missing where a single block, excitation or level was given. Peaks
        that rounding may have changed are not marked: `respond` says so.

    Notes
    -----
    Records at `by="im"` and `by="pga_g"` run in the lanes of `ida`, about
    three times as fast as alone. Pulses, and factors, run alone. The bits are
    the same.

    >>> sine = Pulse("one-sine", amplitude_g=0.15, omega=12.0)
    >>> peak(Block(alpha=0.1, p=3.0), sine, levels=[1.2, 1.4]).shape
    (2,)
    """
    one_block = isinstance(blocks, Block)
    one_motion = isinstance(excitations, (Record, Pulse))
    all_blocks = [blocks] if isinstance(blocks, Block) else list(blocks)
    motions = (
        [excitations]
        if isinstance(excitations, (Record, Pulse))
        else list(excitations)
    )
    all_levels = np.asarray(levels, dtype=np.float64)
    found = _rocking.peak(
        [(block.alpha, block.p) for block in all_blocks],
        [given(motion) for motion in motions],
        np.ravel(all_levels).tolist(),
        by,
        _physics(eta, model, overturn),
        threads,
        progress,
    )
    shape = (
        *(() if one_block else (len(all_blocks),)),
        *(() if one_motion else (len(motions),)),
        *all_levels.shape,
    )
    return found.reshape(shape)


def spectrum(
    record: Record | Pulse,
    *,
    alpha: float,
    p: ArrayLike,
    level: float = 1.0,
    eta: float | Literal["housner"] = 0.92,
    model: str = "nonlinear",
    threads: int | None = None,
) -> Floats:
    """Rocking spectrum: peak |theta|/alpha of blocks of one slenderness and
    frequency parameters `p` (rad/s) under `level` times the record.

    Makris and Konstantinidis (2003) draw it against 2 pi/p.

    >>> sine = Pulse("one-sine", amplitude_g=1.5 / 9.81, omega=12.0)
    >>> spectrum(sine, alpha=0.1, p=[3.0]).round(6)
    array([0.493882])
    """
    values = floats(p, "frequency parameters").tolist()
    return peak(
        [Block(alpha=alpha, p=value) for value in values],
        record,
        levels=level,
        by="scale",
        eta=eta,
        model=model,
        threads=threads,
    )


@dataclass(frozen=True, eq=False)
class Ida(Frozen):
    """Incremental dynamic analysis of one block over a suite.

    `im[i]` and `edp[i]` are the curve of record i: PGA/(g tan alpha) from the
    onset of rocking (1, 0) to the first overturned level, whose EDP is
    infinite. `to_pandas` has one row an analysis.
    """

    block: Block
    records: tuple[str, ...] = field(repr=False)
    eta: float | Literal["housner"]
    model: str
    overturn: str
    by: str
    gravity: float = field(repr=False)
    analyses: int
    record_pga_g: Floats = field(repr=False)
    """PGA of each record as given, g."""
    velocity_ratio_s: Floats = field(repr=False)
    """PGV/PGA of each record, s."""
    sizes: NDArray[np.int64] = field(repr=False)
    """Rows of each record in the columns below."""
    row_im: Floats = field(repr=False)
    row_pga_g: Floats = field(repr=False)
    row_alpha: Floats = field(repr=False)
    row_edp: Floats = field(repr=False)
    row_fate_margin: Floats = field(repr=False)
    row_outcome: NDArray[np.uint8] = field(repr=False)

    def _scanned(self, rows: Floats) -> tuple[Floats, ...]:
        ends = np.cumsum(self.sizes)
        starts = ends - self.sizes
        refined = OUTCOMES.index("overturned-refined")
        return tuple(
            rows[a:b][self.row_outcome[a:b] != refined]
            for a, b in zip(starts, ends)
        )

    @property
    def im(self) -> tuple[Floats, ...]:
        """PGA/(g tan alpha) of each record's curve."""
        return self._scanned(self.row_im)

    @property
    def edp(self) -> tuple[Floats, ...]:
        """Peak |theta|/alpha of each record's curve."""
        return self._scanned(self.row_edp)

    @property
    def unresolved(self) -> int:
        """Analyses whose peak or fate rounding may have changed."""
        code = OUTCOMES.index("unresolved")
        return int(np.count_nonzero(self.row_outcome == code))

    def _factor(self, im: str | ArrayLike) -> Floats:
        if isinstance(im, str):
            if im == "pga":
                return np.ones(len(self.records))
            if im == "pgv":
                return self.block.p * self.velocity_ratio_s
            raise ValueError(
                f"im {im!r}: expected 'pga', 'pgv', or an array of each "
                "record's own intensity"
            )
        own = floats(im, "intensities")
        if len(own) != len(self.records):
            raise ValueError(
                f"{len(own)} intensities: expected {len(self.records)}, one "
                "a record"
            )
        if self.by != "record-scaling":
            raise ValueError(f"by {self.by!r}: the records are not scaled")
        physics = _physics(self.eta, self.model, self.overturn)
        block = self.block
        uplift = _rocking.uplift_threshold(block.alpha, block.p, physics)
        return own * uplift / self.record_pga_g

    def _rows(self, im: str | ArrayLike) -> _rocking.Rows:
        return {
            "sizes": self.sizes,
            "im": self.row_im,
            "edp": self.row_edp,
            "outcome": self.row_outcome,
            "factor": np.ascontiguousarray(self._factor(im)),
        }

    def capacities(
        self,
        edp: ArrayLike,
        *,
        im: str | ArrayLike = "pga",
        rule: str = "median",
    ) -> Floats:
        """Intensity at which each record reaches a response.

        Parameters
        ----------
        edp : float or array_like
            Peak |theta|/alpha; infinite for the first overturning.
        im : "pga", "pgv" or array_like
            PGA/(g tan alpha), p PGV/(g tan alpha), or any intensity that
            scales with the record, given for each record as recorded.
        rule : "median", "first", "last" or "monotone"
            Which of several crossings counts.

        Returns
        -------
        ndarray of shape (edp, record), or (record,) for a single edp
            Infinite (censored) where the record never got there.

        >>> lobe = Record([0.0, 0.2, 0.0], 0.25, units="g", name="lobe")
        >>> found = ida(Block(alpha=0.1, p=3.0), lobe)
        >>> found.capacities(np.inf).round(4)
        array([2.299])
        >>> found.capacities([0.2, 0.5, np.inf]).shape
        (3, 1)
        """
        levels = np.asarray(edp, dtype=np.float64)
        flat = np.ravel(levels).tolist()
        found = _rocking.capacities(self._rows(im), flat, rule)
        return found.reshape(*levels.shape, len(self.records))

    def demands(self, im: ArrayLike, *, kind: str = "pga") -> Floats:
        """Response of each record at an intensity, a stripe.

        Linear between the levels that stand, infinite from the first
        overturning on. Between the last level that stands and overturning a
        curve says nothing, which is refused: ask at the levels, which
        `step_im` makes the same for every record. `kind` is "pga" or "pgv" as
        in `capacities`.

        Returns
        -------
        ndarray of shape (im, record), or (record,) for a single im

        >>> lobe = Record([0.0, 0.2, 0.0], 0.25, units="g", name="lobe")
        >>> found = ida(Block(alpha=0.1, p=3.0), lobe, step_im=0.5)
        >>> found.demands([1.5, 2.5]).round(4).tolist()
        [[0.066], [inf]]
        """
        levels = np.asarray(im, dtype=np.float64)
        flat = np.ravel(levels).tolist()
        found = _rocking.demands(self._rows(kind), flat)
        return found.reshape(*levels.shape, len(self.records))

    def _columns(self) -> dict[str, Any]:
        """The columns that the command line writes, one row an analysis."""

        def each(values: Any) -> Any:
            return np.repeat(np.asarray(values), self.sizes)

        ratio = each(self.velocity_ratio_s)
        names = np.asarray(OUTCOMES, dtype=object)
        return {
            "record": each(np.asarray(self.records, dtype=object)),
            "alpha_rad": self.row_alpha,
            "p_rad_s": self.block.p,
            "pga_g": self.row_pga_g,
            "pgv_m_s": self.row_pga_g * ratio * self.gravity,
            "im_pga": self.row_im,
            "im_pgv": self.row_im * (self.block.p * ratio),
            "edp": self.row_edp,
            "outcome": names[self.row_outcome],
            "margin": self.row_fate_margin,
        }

    def to_pandas(self) -> Any:
        """One row an analysis, as a `pandas.DataFrame` with the columns that
        the command line writes."""
        import pandas

        return pandas.DataFrame(self._columns())

    def to_xarray(self) -> Any:
        """The curves as an `xarray.Dataset` over (record, level).

        Level 0 is the onset of rocking, the last level of a record its first
        overturned one. Curves end at different levels: beyond its end a row
        holds NaN, and the outcome "". The variables are the columns of
        `to_pandas`. `overturning_im_pga` has the first overturning of each
        record as `capacities` gives it, refined, and infinite where the
        record never overturned the block.
        """
        import xarray

        columns = self._columns()
        scanned = self.row_outcome != OUTCOMES.index("overturned-refined")
        curve = np.repeat(np.arange(len(self.records)), self.sizes)[scanned]
        lengths = np.bincount(curve, minlength=len(self.records))
        starts = np.cumsum(lengths) - lengths
        level = np.arange(len(curve)) - np.repeat(starts, lengths)
        shape = len(self.records), int(lengths.max())
        variables: dict[str, Any] = {}
        for name, unit in _UNITS.items():
            table = np.full(shape, np.nan)
            table[curve, level] = columns[name][scanned]
            known = {"units": unit}
            variables[name] = ("record", "level"), table, known
        words = np.full(shape, "", dtype=f"<U{max(map(len, OUTCOMES))}")
        words[curve, level] = columns["outcome"][scanned]
        variables["outcome"] = ("record", "level"), words
        overturning = self.capacities(np.inf)
        known = {"units": "1"}
        variables["overturning_im_pga"] = "record", overturning, known
        places = {
            "record": np.asarray(self.records),
            "level": np.arange(shape[1]),
        }
        about = {
            "block_alpha_rad": self.block.alpha,
            "block_p_rad_s": self.block.p,
            "eta": self.eta,
            "model": self.model,
            "overturn": self.overturn,
            "by": self.by,
        }
        return xarray.Dataset(variables, places, about)

    def _repr_html_(self) -> str:
        words = (
            f"IDA of {self.block!r} under {len(self.records)} records: "
            f"{self.analyses} analyses, {self.unresolved} unresolved"
        )
        curves = list(zip(self.edp, self.im))
        names = ("peak |theta|/alpha", "PGA/(g tan alpha)")
        return _draw.lines(curves, *names, words)


def ida(
    block: Block,
    suite: Record | Sequence[Record],
    *,
    step_g: float | None = None,
    step_im: float | None = None,
    refine: float | None = 1e-4,
    by: str = "scaling",
    eta: float | Literal["housner"] = 0.92,
    model: str = "nonlinear",
    overturn: str = "alpha",
    certify: bool = False,
    highest_im: float = 100.0,
    gravity: float = STANDARD_GRAVITY,
    threads: int | None = None,
    progress: Progress | None = None,
) -> Ida:
    """Raises the intensity of every record until the block overturns.

    Parameters
    ----------
    step_g, step_im : float, at most one of them
        Step of the levels: in PGA (g; 0.01 unless given), or in
        PGA/(g tan alpha) from 1.
    refine : float or None
        Width in PGA/(g tan alpha) to which the first overturning is bisected.
    by : "scaling" or "slenderness"
        Scale the record, or keep it and adjust alpha.
    certify : bool
        Tell each analysis in the precision that it needs, instead of
        counting it as unresolved.
    highest_im : float
        Where curves end that never overturn.
    gravity : float
        In m/s2, for the column `pgv_m_s` of `Ida.to_pandas`.
    threads : int
        All processors unless given. The result does not depend on it.
    progress : callable
        Called now and then with (curves done, curves), in the calling
        thread. What it raises ends the analysis; so does Ctrl-C.

    eta, model and overturn are as in `respond`.

    >>> lobe = Record([0.0, 0.2, 0.0], 0.25, units="g", name="lobe")
    >>> found = ida(Block(alpha=0.1, p=3.0), lobe)
    >>> float(found.im[0][0]), float(found.edp[0][-1])
    (1.0, inf)
    """
    if step_g is not None and step_im is not None:
        raise ValueError("step_g and step_im: expected at most one of them")
    if step_g is None and step_im is None:
        step_g = 0.01
    names = {
        "scaling": "record-scaling",
        "slenderness": "slenderness-adjustment",
    }
    if by not in names:
        raise ValueError(f"by {by!r}: expected one of {', '.join(names)}")
    records = [suite] if isinstance(suite, Record) else list(suite)
    if not records:
        raise ValueError("no record: expected at least one")
    scan: _rocking.Scan = {
        "step_g": step_g,
        "step_im": step_im,
        "refine": refine,
        "by": names[by],
        "certify": certify,
        "highest_im": float(highest_im),
    }
    found = _rocking.ida(
        (block.alpha, block.p),
        [given(record) for record in records],
        _physics(eta, model, overturn),
        scan,
        threads,
        progress,
    )
    for value in found.values():
        if isinstance(value, np.ndarray):
            value.setflags(write=False)
    return Ida(
        block=block,
        records=tuple(record.name for record in records),
        eta=eta,
        model=model,
        overturn=overturn,
        by=names[by],
        gravity=gravity,
        analyses=found["analyses"],
        record_pga_g=found["record_pga_g"],
        velocity_ratio_s=found["velocity_ratio_s"],
        sizes=found["sizes"],
        row_im=found["im"],
        row_pga_g=found["pga_g"],
        row_alpha=found["alpha"],
        row_edp=found["edp"],
        row_fate_margin=found["fate_margin"],
        row_outcome=found["outcome"],
    )
