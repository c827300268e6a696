"""Fits, tests and quantiles of samples."""

from __future__ import annotations

import os
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, Literal, NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from . import _draw, _rocking
from ._inputs import (
    STANDARD_GRAVITY,
    Block,
    Floats,
    Frozen,
    floats,
    frozen,
)
from ._outputs import replace


def _sample(values: Any) -> Floats:
    """A sample; the right-censored values of SciPy's CensoredData are
    infinite."""
    parts = ("_uncensored", "_left", "_right", "_interval")
    if all(hasattr(values, part) for part in parts):
        if len(values._left) > 0 or len(values._interval) > 0:
            raise ValueError(
                "CensoredData with left- or interval-censored values: "
                "expected right-censored ones alone"
            )
        censored = np.full(len(values._right), np.inf)
        values = np.concatenate([values._uncensored, censored])
    return floats(values, "sample")


def _seed(rng: int) -> int:
    if isinstance(rng, bool) or not isinstance(rng, int) or rng < 0:
        raise ValueError(
            f"rng {rng!r}: expected a whole number, not negative; streams "
            "are the project's own, so that results are the same everywhere"
        )
    return rng


class ConfidenceInterval(NamedTuple):
    """Ends of an interval."""

    low: float
    high: float


@dataclass(frozen=True, eq=False)
class Fragility(Frozen):
    """A lognormal fragility, with or without a shift.

    F(x) = Phi((ln(x - shift) - log_mean)/beta) above the shift, 0 up to it.
    """

    median: float
    """shift + exp(log_mean)."""
    beta: float
    """Dispersion of ln(x - shift)."""
    shift: float
    """Nothing rocks below it; 0 for the ordinary lognormal. It is given,
    never fitted by likelihood."""
    log_mean: float
    n: int
    """Size of the sample, censored values included."""
    n_kept: int
    """Values that entered as such."""
    log_likelihood: float | None
    ks_distance: float
    """Kolmogorov distance to the sample."""
    method: str
    shift_is_smallest: bool
    replicates: Floats = field(repr=False)
    jackknife: Floats = field(repr=False)

    @property
    def _law(self) -> tuple[float, float, float]:
        return self.shift, self.log_mean, self.beta

    def cdf(self, x: ArrayLike) -> Floats:
        """Probability of exceedance at intensity x.

        >>> fit = fit_fragility([1.5, 2.0, 3.0], shift=1.0)
        >>> fit.cdf([1.0, 2.0])
        array([0. , 0.5])
        """
        values = np.asarray(x, dtype=np.float64)
        flat = np.ascontiguousarray(values.ravel())
        return _rocking.cdf(self._law, flat).reshape(values.shape)

    def ppf(self, q: ArrayLike) -> Floats:
        """Intensity at probability q."""
        values = np.asarray(q, dtype=np.float64)
        flat = np.ascontiguousarray(values.ravel())
        return _rocking.ppf(self._law, flat).reshape(values.shape)

    @property
    def aic(self) -> float:
        """Akaike's criterion, 2 k - 2 ln L: k = 2, and 3 where the shift is
        the smallest value. NaN without a likelihood."""
        if self.log_likelihood is None:
            return float("nan")
        k = 3 if self.shift_is_smallest else 2
        return 2.0 * k - 2.0 * self.log_likelihood

    def confidence_interval(
        self,
        quantity: Literal["median", "beta", "log_mean"] = "median",
        *,
        confidence_level: float = 0.95,
        method: Literal["BCa", "percentile"] = "BCa",
    ) -> ConfidenceInterval:
        """Bootstrap interval of `median`, `beta` or `log_mean`; records are
        drawn with replacement.

        >>> fit = fit_fragility([1.5, 2.0, 3.0, 4.0], n_resamples=200)
        >>> low, high = fit.confidence_interval("median")
        >>> low < fit.median < high
        True
        """
        columns = ("log_mean", "beta", "median")
        if quantity not in columns:
            raise ValueError(
                f"quantity {quantity!r}: expected one of {', '.join(columns)}"
            )
        if method not in ("BCa", "percentile"):
            raise ValueError(
                f"method {method!r}: expected one of BCa, percentile"
            )
        if len(self.replicates) == 0:
            raise ValueError(
                "no bootstrap: fit with n_resamples, such as 2000"
            )
        column = columns.index(quantity)
        without = self.jackknife[:, column].tolist()
        _, low, high = _rocking.interval(
            getattr(self, quantity),
            self.replicates[:, column].tolist(),
            without if method == "BCa" else None,
            confidence_level,
        )
        return ConfidenceInterval(low, high)

    def to_nrml(
        self,
        block: Block,
        path: str | os.PathLike[str] | None = None,
        *,
        im: str,
        id: str | None = None,
        limit_state: str = "exceeded",
        model: str = "nonlinear",
        gravity: float = STANDARD_GRAVITY,
        origin: str | None = None,
    ) -> str:
        """The fragility of one block as OpenQuake's NRML 0.5.

        A fit is dimensionless. The file has the block's own PGA in g, or its
        PGV in cm/s. OpenQuake has no lognormal with a shift: such a fit is
        written as points, which are off by at most 5e-4 in probability.

        Parameters
        ----------
        block : Block
            The block whose fragility it is.
        path : path-like
            Where to write the text, too.
        im : "pga" or "pgv"
            What the sample was: PGA/(g tan alpha), or p PGV/(g tan alpha).
        id : str
            Name of the block in the file; from alpha and p unless given.
            ASCII letters, digits, `_` and `:`.
        limit_state : str
            Name of the damage in the file.
        model : "nonlinear" or "linearized"
            The linearized equation has alpha in place of tan alpha.
        gravity : float
            In m/s2, for PGV.
        origin : str
            Where the fragility comes from, in words.

        Returns
        -------
        str
            The text, with the bytes of `rocking fragility export
            --format nrml`.

        >>> fit = fit_fragility([1.5, 2.0, 3.0], shift=1.0)
        >>> text = fit.to_nrml(Block(alpha=0.2, p=3.0), im="pga")
        >>> print(text.splitlines()[5])
        <fragilityFunction id="block_a0_2_p3" format="discrete">
        """
        wanted = _wanted(block, im, id, limit_state, model, gravity, origin)
        text, _ = _rocking.exchange("nrml", self._law, self.n, wanted)
        if path is not None:
            replace(Path(path), text)
        return text

    def to_pelicun(
        self,
        block: Block,
        path: str | os.PathLike[str] | None = None,
        *,
        im: str,
        id: str | None = None,
        limit_state: str = "exceeded",
        model: str = "nonlinear",
        gravity: float = STANDARD_GRAVITY,
        origin: str | None = None,
    ) -> tuple[str, str]:
        """The fragility of one block as a library of pelicun.

        PGA is in g, PGV in m/s. A fit with a shift is written as points.
        `path` is that of the CSV; the JSON is written beside it, with the
        extension .json. Parameters are as in `to_nrml`.

        Returns
        -------
        tuple of str
            The CSV with the parameters, and the JSON that describes them.

        >>> fit = fit_fragility([1.5, 2.0, 3.0])
        >>> table, _ = fit.to_pelicun(Block(alpha=0.2, p=3.0), im="pga")
        >>> table.splitlines()[1].split(",")[2:7]
        ['Peak Ground Acceleration', 'g', '0', '1', 'lognormal']
        """
        wanted = _wanted(block, im, id, limit_state, model, gravity, origin)
        table, about = _rocking.exchange(
            "pelicun", self._law, self.n, wanted
        )
        assert about is not None
        if path is not None:
            beside = Path(path).with_suffix(".json")
            if beside == Path(path):
                raise ValueError(
                    f"{path}: expected a file .csv, beside which a file "
                    ".json is written"
                )
            replace(Path(path), table)
            replace(beside, about)
        return table, about

    def _repr_html_(self) -> str:
        x = np.linspace(self.shift, float(self.ppf(0.98)), 100)
        words = f"median {self.median:.4g}, beta {self.beta:.4g}"
        if self.shift > 0.0:
            words += f", shift {self.shift:.4g}"
        return _draw.lines([(x, self.cdf(x))], "intensity", "P", words)


def _wanted(
    block: Block,
    im: str,
    id: str | None,
    limit_state: str,
    model: str,
    gravity: float,
    origin: str | None,
) -> _rocking.Wanted:
    return {
        "block": (block.alpha, block.p),
        "im": im,
        "id": id,
        "limit_state": limit_state,
        "model": model,
        "gravity": gravity,
        "origin": origin,
    }


def fit_fragility(
    sample: ArrayLike,
    *,
    shift: float | Literal["min"] = 0.0,
    method: str = "mle",
    quantile_type: int = 5,
    n_resamples: int = 0,
    rng: int = 0,
) -> Fragility:
    """Fits a lognormal fragility to a sample of capacities.

    Parameters
    ----------
    sample : array_like or scipy.stats.CensoredData
        Capacities; infinite for a record that never got there.
    shift : float or "min"
        The intensity below which nothing rocks: 1 for PGA/(g tan alpha).
        "min" takes the smallest value, which then does not enter.
    method : "mle", "moment", "quantile", "trimmed" or "censored"
        Infinite values need "censored" or "quantile".
    quantile_type : int
        Hyndman and Fan's, for the last three methods.
    n_resamples : int
        Bootstrap samples for `Fragility.confidence_interval`.
    rng : int
        Repetition of the bootstrap.

    >>> fit = fit_fragility([1.5, 2.0, 3.0], shift=1.0)
    >>> round(fit.median, 6), round(fit.beta, 6)
    (2.0, 0.565952)
    """
    values = _sample(sample)
    given = None if shift == "min" else _shift(shift)
    found = _rocking.fit_fragility(
        values, given, method, quantile_type, n_resamples, _seed(rng)
    )
    frozen(found["replicates"])
    frozen(found["jackknife"])
    return Fragility(**found, method=method, shift_is_smallest=given is None)


def _shift(shift: float | str) -> float:
    if isinstance(shift, str):
        raise ValueError(f"shift {shift!r}: expected a number, or 'min'")
    return float(shift)


@dataclass(frozen=True)
class TestResult:
    """A test of (log)normality."""

    __test__ = False  # It is no test of pytest's.

    statistic: float
    """The largest distance D between the distribution functions."""
    pvalue: float
    pvalue_low: float
    pvalue_high: float
    """Interval (95 %) of the p-value's Monte Carlo error."""
    critical_value: float
    level: float
    n: int
    verdict: str | None
    """"rejected", "not-rejected" or "indeterminate" (the interval of the
    p-value holds the level); None where the test does not apply."""
    reason: str | None
    """Why it does not apply."""
    method: str
    """"table" or "simulation"."""


def lilliefors(
    sample: ArrayLike,
    *,
    log: bool = True,
    shift: float | Literal["min"] | None = None,
    n_mc: int | None = None,
    rng: int = 0,
    level: float = 0.05,
) -> TestResult:
    """Lilliefors' test: is the sample lognormal above the shift?

    Parameters
    ----------
    log : bool
        Test ln(x - shift); False tests the values themselves.
    shift : float, "min" or None
        0 unless given.
    n_mc : int
        Simulate this many samples; the project's own table answers unless
        given.
    rng : int
        Repetition of the simulation.

    >>> test = lilliefors([1.0, 2.0, 4.0, 8.0, 16.0, 32.0])
    >>> test.verdict
    'not-rejected'
    """
    if not log and shift is not None:
        raise ValueError("shift without log: expected log=True")
    given = None if shift == "min" else _shift(0.0 if shift is None else shift)
    found = _rocking.lilliefors(
        _sample(sample), log, given, n_mc, _seed(rng), level
    )
    return TestResult(**found)


def quantile(sample: ArrayLike, q: ArrayLike, *, type: int = 5) -> Floats:
    """Quantiles of a sample, infinite values counted, by Hyndman and Fan's
    type (5 is Hazen's, numpy's "hazen").

    >>> quantile([1.0, 2.0, 3.0, 4.0], 0.5)
    array(2.5)
    """
    probabilities = np.asarray(q, dtype=np.float64)
    flat = np.ascontiguousarray(probabilities.ravel())
    found = _rocking.quantile(_sample(sample), flat, type)
    return found.reshape(probabilities.shape)


def boxplot_stats(sample: ArrayLike, *, type: int = 5) -> dict[str, Any]:
    """Notched boxplot, with the keys that `matplotlib.axes.Axes.bxp` takes.

    >>> box = boxplot_stats([1.0, 2.0, 3.0, 4.0, 20.0])
    >>> box["q1"], box["med"], box["q3"]
    (1.75, 3.0, 8.0)
    """
    return _rocking.boxplot(_sample(sample), type)


@dataclass(frozen=True, eq=False)
class PairedResult(Frozen):
    """Two samples over the same records, by their ratios a/b."""

    n: int
    zero: tuple[int, int, int]
    """Pairs of which both, only a, only b are zero."""
    infinite: tuple[int, int, int]
    """Pairs of which both, only a, only b are infinite."""
    geometric_mean: float
    interval: tuple[float, float]
    """90 % interval of the geometric mean."""
    equivalence_pvalue: float
    """Of the hypothesis that the geometric mean is beyond the margin."""
    hodges_lehmann: float
    sign_pvalue: float
    mcnemar_pvalue: float
    ratios: Floats = field(repr=False)


def paired_ratios(
    a: ArrayLike, b: ArrayLike, *, margin: float = 0.05
) -> PairedResult:
    """Compares two blocks over the same records.

    >>> found = paired_ratios([1.0, 2.1, 3.0], [1.0, 2.0, 3.1])
    >>> round(found.geometric_mean, 4)
    1.0053
    """
    found = _rocking.paired(_sample(a), _sample(b), margin)
    frozen(found["ratios"])
    for key in ("zero", "infinite"):
        found[key] = tuple(found[key])
    return PairedResult(**found)
