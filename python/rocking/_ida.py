"""Incremental dynamic analysis of a suite."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import Any, Literal

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _draw, _rocking
from ._analyses import Progress, physics
from ._inputs import (
    STANDARD_GRAVITY,
    Block,
    Floats,
    Frozen,
    Record,
    floats,
    given,
)

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
        found = physics(self.eta, self.model, self.overturn)
        block = self.block
        uplift = _rocking.uplift_threshold(block.alpha, block.p, found)
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
        physics(eta, model, overturn),
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
