"""Fits, tests and summaries of samples."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any, Literal, TypeVar

import numpy as np
from numpy.typing import ArrayLike

from . import _rocking
from ._inputs import Floats, Frozen, floats, frozen, number, numbers
from ._results import (
    Band,
    Bounds,
    Comparison,
    Contrast,
    Estimate,
    FitIntervals,
    IntervalBasis,
    Needed,
    Normality,
    Result,
    ShiftInterval,
    Summary,
    Transformed,
    axes,
)

Shift = float | Literal["min", "free"]
Method = Literal["mle", "moment", "quantile", "trimmed", "censored"]
Dispersion = Literal["own", "common"]


@dataclass(frozen=True, init=False, eq=False)
class Sample(Frozen):
    """Capacities of a suite, as numpy's functions and the fits take them.

    Parameters
    ----------
    values : array_like
        One value per record; infinite if it is censored.
    limits : array_like, optional
        The limit up to which a censored record was run; NaN if that is not
        known.
    events : sequence of str
        The earthquake of each record; empty if they are not known.
    records : sequence of str
        The name of each record, by which `compare` pairs samples.

    >>> Sample([1.5, float("inf")], [float("nan"), 3.2]).limits.tolist()
    [nan, 3.2]
    """

    values: Floats
    limits: Floats
    events: tuple[str, ...] = ()
    records: tuple[str, ...] = ()

    def __init__(
        self,
        values: ArrayLike,
        limits: ArrayLike | None = None,
        events: Sequence[str] = (),
        records: Sequence[str] = (),
    ) -> None:
        own = floats(values, "sample").copy()
        known = np.full(len(own), np.nan)
        if limits is not None:
            known = floats(limits, "limits").copy()
        sizes = {"limits": len(known)}
        sizes |= {"events": len(events)} if events else {}
        sizes |= {"records": len(records)} if records else {}
        for what, size in sizes.items():
            if size != len(own):
                raise ValueError(
                    f"{what} of {size} records for {len(own)} values: "
                    "expected one a value"
                )
        object.__setattr__(self, "values", frozen(own))
        object.__setattr__(self, "limits", frozen(known))
        object.__setattr__(self, "events", tuple(events))
        object.__setattr__(self, "records", tuple(records))

    def __array__(self, dtype: Any = None, copy: bool | None = None) -> Any:
        return np.array(self.values, dtype=dtype, copy=True)

    def to_scipy(self) -> Any:
        """The sample as `scipy.stats.CensoredData`."""
        from scipy import stats

        censored = np.isinf(self.values)
        known = np.where(censored, self.limits, self.values)
        return stats.CensoredData.right_censored(known, censored)


def given_sample(sample: Any) -> _rocking.Sample:
    """Values, the limits of those that are censored at a known one, and the
    earthquakes and the names of the records where they are known."""
    if isinstance(sample, Sample):
        limits = [None if x != x else x for x in sample.limits.tolist()]
        return sample.values, limits, sample.events, sample.records
    parts = ("_uncensored", "_left", "_right", "_interval")
    if not all(hasattr(sample, part) for part in parts):
        return floats(sample, "sample"), [], (), ()
    if len(sample._left) > 0 or len(sample._interval) > 0:
        raise ValueError(
            "CensoredData with left- or interval-censored values: expected "
            "only right-censored ones"
        )
    limits = [None] * len(sample._uncensored) + sample._right.tolist()
    infinite = np.full(len(sample._right), np.inf)
    return np.concatenate([sample._uncensored, infinite]), limits, (), ()


def shift_text(shift: Shift) -> str:
    """A shift, as the native half reads it."""
    if isinstance(shift, str):
        if shift not in ("min", "free"):
            raise ValueError(
                f"shift {shift!r}: expected a number, 'min' or 'free'"
            )
        return shift
    return repr(number(shift, "shift"))


def seed(rng: int) -> int:
    """The repetition of a simulation."""
    if isinstance(rng, bool) or not isinstance(rng, int) or rng < 0:
        raise ValueError(
            f"rng {rng!r}: expected a non-negative whole number; streams "
            "are the project's own, so that results are the same everywhere"
        )
    return rng


@dataclass(frozen=True)
class Fragility(Result):
    """A lognormal fragility, with or without a shift.

    F(x) = Phi((ln(x - shift) - log_mean)/dispersion) above the shift, 0 up
    to it.

    >>> Fragility(shift=1.0, log_mean=0.0, dispersion=0.5, median=2.0).cdf(2)
    array(0.5)
    """

    shift: float
    """Nothing rocks below it; 0 for the ordinary lognormal."""
    log_mean: float
    """Mean of ln(x - shift)."""
    dispersion: float
    """Standard deviation of ln(x - shift)."""
    median: float
    """shift + exp(log_mean)."""

    @property
    def _law(self) -> _rocking.Law:
        return self.shift, self.log_mean, self.dispersion

    def _at(self, function: str, x: ArrayLike) -> Floats:
        values = numbers(x, "numbers")
        flat = np.ascontiguousarray(values.ravel())
        found = _rocking.lognormal(self._law, function, flat)
        return found.reshape(values.shape)

    def cdf(self, x: ArrayLike) -> Floats:
        """Probability of exceedance at intensity x."""
        return self._at("cdf", x)

    def sf(self, x: ArrayLike) -> Floats:
        """1 - cdf(x), without cancellation if it is small."""
        return self._at("sf", x)

    def pdf(self, x: ArrayLike) -> Floats:
        """Density at intensity x."""
        density: Floats = np.exp(self._at("logpdf", x))
        return density

    def ppf(self, q: ArrayLike) -> Floats:
        """Intensity at probability q."""
        return self._at("ppf", q)

    def rvs(
        self,
        size: int | tuple[int, ...] = (),
        rng: np.random.Generator | int | None = None,
    ) -> Floats:
        """Capacities drawn at random, by numpy's generator or its seed."""
        return self.ppf(np.random.default_rng(rng).random(size))

    def to_scipy(self) -> Any:
        """The distribution as a frozen `scipy.stats.lognorm`."""
        from scipy import stats

        scale = self.median - self.shift
        return stats.lognorm(self.dispersion, self.shift, scale)

    def _curve(self) -> tuple[Floats, Floats]:
        x = np.linspace(self.shift, float(self.ppf(0.98)), 100)
        return x, self.cdf(x)

    def plot(self, ax: Any = None) -> Any:
        """Draws the curve; gives the matplotlib axes."""
        ax = axes(ax)
        ax.plot(*self._curve())
        ax.set(xlabel="intensity", ylabel="probability")
        return ax


F = TypeVar("F", bound="FragilityFit")


class _Fit(Result):
    """Base of results with a fitted fragility."""

    fitted: Fragility

    def plot(self, ax: Any = None) -> Any:
        """Draws the fragility, with its band if there is one; gives the
        matplotlib axes."""
        ax = self.fitted.plot(ax)
        band = getattr(self, "band", None)
        if band is not None:
            x, low, high = zip(
                *((p.intensity, p.low, p.high) for p in band.points)
            )
            ends = (np.array(end, dtype=np.float64) for end in (low, high))
            ax.fill_between(x, *ends, alpha=0.3)
        return ax


@dataclass(frozen=True)
class FragilityFit(_Fit):
    """A fragility fitted to a sample, all intensities in its unit."""

    n: int
    """Size of the sample, censored values included."""
    n_kept: int
    n_censored: int
    n_limited: int
    """Censored values whose limit is known."""
    n_left_out: int
    """Values left out because they equal the shift "min"."""
    remarks: tuple[str, ...]
    """Weaknesses of the fit."""
    method: str
    fitted: Fragility
    shift_interval: ShiftInterval | None
    log_likelihood: float | None
    ks_distance: float | None
    area_distance: float | None
    quantile_type: int
    im16: float | None
    im50: float | None
    im84: float | None
    unshifted: Fragility | None
    """The fit by the same method without a shift."""
    transformed: Transformed
    needed: Needed | None
    """How many records a precision needs."""
    bootstrap: FitIntervals | None
    band: Band | None

    @property
    def _behind(self) -> _rocking.Behind:
        """The samples of the levels, the place of this one's, and how they
        were fitted."""
        found: _rocking.Behind = self.__dict__.get("_asked")
        return found

    def _remember(
        self: F,
        samples: Sequence[_rocking.Sample],
        place: int,
        fit: _rocking.Fit,
    ) -> F:
        self.__dict__["_asked"] = samples, place, fit
        return self


@dataclass(frozen=True)
class LevelFit(FragilityFit):
    """The fit of the capacities at one EDP level; None is overturning."""

    edp: float | None
    dispersion_loss: float | None
    """Loss of log-likelihood against the level's own dispersion; None if the
    fit has that dispersion."""


@dataclass(frozen=True)
class CountsFragility(_Fit):
    """A fragility fitted to counts of stripes."""

    n: int
    """Records run, over all stripes."""
    open: int
    """Records that do not exceed the level up to where their run ends, if not
    every one was run to every intensity: the likelihood is then that of the
    two analyses next to each record's capacity."""
    fitted: Fragility
    level: float
    intervals: str
    """Basis of the intervals."""
    median: Bounds
    dispersion: Bounds
    log_likelihood: float | None
    chi_squared: float | None
    degrees_of_freedom: int | None


@dataclass(frozen=True)
class CloudLevel(_Fit):
    """The fragility of one level of response; `edp` None is overturning."""

    edp: float | None
    fitted: Fragility
    median: Estimate
    dispersion: Estimate


@dataclass(frozen=True)
class CloudFragility(IntervalBasis):
    """A line of ln EDP on ln(IM - shift), and the fragilities that follow."""

    n: int
    not_rocking: int
    """Records left out because the block did not uplift."""
    below_shift: int
    """Other records left out because their IM is not above the shift."""
    overturned: int
    shift: float
    intercept: Estimate
    """ln EDP at IM - shift = 1."""
    slope: Estimate
    deviation: Estimate
    """Standard deviation of ln EDP about the line."""
    log_likelihood: float
    """Of ln EDP."""
    levels: tuple[CloudLevel, ...]
    """For `BlockFragility`, `export` and `risk`."""


def options(
    shift: Shift,
    method: Method,
    quantile_type: int,
    c: float,
    n_resamples: int,
    rng: int,
    band: ArrayLike,
    dispersion: Dispersion = "own",
) -> _rocking.Fit:
    """The options of a fit, as the native half takes them."""
    return {
        "shift": shift_text(shift),
        "method": method,
        "dispersion": dispersion,
        "quantile_type": quantile_type,
        "c": c,
        "n_resamples": n_resamples,
        "seed": seed(rng),
        "band": floats(band, "band").tolist(),
    }


def fit_fragility(
    sample: ArrayLike | Sample,
    *,
    shift: Shift = 0.0,
    method: Method = "mle",
    quantile_type: int = 5,
    c: float = 1.0,
    n_resamples: int = 0,
    rng: int = 0,
    band: ArrayLike = (),
) -> FragilityFit:
    """Fits a lognormal fragility to a sample of capacities.

    Parameters
    ----------
    sample : array_like, Sample or scipy.stats.CensoredData
        Capacities; infinite for a record that never got there. The latter
        two know up to where it was run, which the fit uses.
    shift : float, "min" or "free"
        The intensity below which nothing rocks: 1 for PGA/(g tan alpha).
        "min" takes the smallest value, which then does not enter; "free" fits
        the shift by likelihood.
    method : "mle", "moment", "quantile", "trimmed" or "censored"
        Infinite values without limits need "censored" or "quantile".
    quantile_type : int
        Hyndman and Fan's.
    c : float
        Constant of Eq. 7.
    n_resamples : int
        Bootstrap samples for intervals; 0 for none. Earthquakes are drawn with
        all their records, if the sample knows them. `remark` says why the
        intervals are rough; 200 samples give their ends to 5 %.
    rng : int
        Repetition of the bootstrap.
    band : array_like
        Intensities at which the probability gets a band.

    >>> fit = fit_fragility([1.5, 2.0, 3.0], shift=1.0).fitted
    >>> round(fit.median, 6), round(fit.dispersion, 6)
    (2.0, 0.565952)
    """
    asked = options(shift, method, quantile_type, c, n_resamples, rng, band)
    given = given_sample(sample)
    found = FragilityFit._of(_rocking.fit(given, asked))
    return found._remember([given], 0, asked)


def fit_stripes(
    stripes: Sequence[tuple[float, int, int]], *, shift: float = 0.0
) -> CountsFragility:
    """Fits a lognormal fragility to counts of stripes, (intensity, records
    that exceeded, records run), by maximum likelihood.

    The intervals take the stripes as independent. `Ida.fit_stripes` has those
    of stripes of the same records, and takes records that were not run to
    every intensity: counts of the others exceed too often.

    Parameters
    ----------
    stripes : sequence of (float, int, int)
    shift : float
        The intensity below which nothing rocks.

    >>> fit = fit_stripes([(1.0, 1, 10), (2.0, 5, 10), (4.0, 9, 10)])
    >>> round(fit.fitted.median, 6)
    2.0
    """
    counts = [(number(im, "intensity"), k, n) for im, k, n in stripes]
    return CountsFragility._of(_rocking.fit_stripes(counts, shift))


def test_normality(
    sample: ArrayLike | Sample,
    *,
    shift: float | Literal["min"] | None = None,
    n_mc: int | None = None,
    rng: int = 0,
    level: float = 0.05,
) -> Normality:
    """Lilliefors' test, and others beside it: is the sample normal?

    Parameters
    ----------
    sample : array_like, Sample or scipy.stats.CensoredData
    shift : float, "min" or None
        Tests ln(x - shift), 0 for the ordinary lognormal; None tests the
        values themselves.
    n_mc : int
        Simulate this many samples; the project's own table answers unless
        given.
    rng : int
        Repetition of the simulation.
    level : float
        Level of the test.

    >>> found = test_normality([1.0, 2.0, 4.0, 8.0, 16.0, 32.0], shift=0.0)
    >>> found.verdict
    'not-rejected'
    """
    above = None if shift is None else shift_text(shift)
    found = _rocking.test_normality(
        given_sample(sample), above, level, n_mc, seed(rng)
    )
    return Normality._of(found)


test_normality.__test__ = False  # type: ignore[attr-defined]


def summarise(
    sample: ArrayLike | Sample,
    probabilities: ArrayLike = (0.16, 0.5, 0.84),
    *,
    quantile_type: int = 5,
) -> Summary:
    """Quantiles and notched boxplot of a sample, infinite values counted.

    Parameters
    ----------
    sample : array_like, Sample or scipy.stats.CensoredData
    probabilities : array_like
        Probabilities of the quantiles.
    quantile_type : int
        Hyndman and Fan's; 5 is Hazen's, numpy's "hazen".

    >>> found = summarise([1.0, 2.0, 3.0, 4.0, 20.0], [0.5])
    >>> found.quantiles[0].value, found.boxplot.whisker_high
    (3.0, 4.0)
    """
    values, *_ = given_sample(sample)
    at = floats(probabilities, "probabilities").tolist()
    return Summary._of(_rocking.summarise(values, at, quantile_type))


def compare(a: Sample, b: Sample, *, margin: float = 0.05) -> Comparison:
    """Compares two samples of the same records by their ratios a/b.

    Values are paired by the names of their records, which `Ida.sample` gives;
    `contrast` takes samples of different records.

    Parameters
    ----------
    a, b : Sample
    margin : float
        Ratios between 1/(1 + margin) and 1 + margin count as equivalent to 1.

    >>> a = Sample([1.0, 2.1, 3.0], records=["x", "y", "z"])
    >>> b = Sample([3.1, 1.0, 2.0], records=["z", "x", "y"])
    >>> found = compare(a, b)
    >>> round(found.mean_equivalence.geometric_mean, 4)
    1.0053
    """
    for sample in (a, b):
        if not isinstance(sample, Sample):
            raise TypeError(
                f"{type(sample).__name__}: expected a Sample with the names "
                "of its records, by which values are paired; contrast takes "
                "samples of different records"
            )
    both = given_sample(a), given_sample(b)
    return Comparison._of(_rocking.compare(*both, margin))


def contrast(
    a: ArrayLike | Sample,
    b: ArrayLike | Sample,
    *,
    n_resamples: int = 1000,
    rng: int = 0,
) -> Contrast:
    """Contrasts two samples of different records: the ratio of their medians
    a/b with a bootstrap interval, and the distance of their distributions.

    Parameters
    ----------
    a, b : array_like, Sample or scipy.stats.CensoredData
        Positive capacities, infinite if censored.
    n_resamples : int
        Bootstrap samples. Earthquakes are drawn with all their records, where
        a sample knows them.
    rng : int
        Repetition of the bootstrap.

    >>> pulse, ordinary = [1.1, 1.3, 1.4, 1.8], [2.2, 2.6, 2.8, 3.6, 9.0]
    >>> found = contrast(pulse, ordinary, n_resamples=200)
    >>> round(found.median_ratio.point, 3), found.median_ratio.remark
    (0.482, 'intervals are rough: 4 records, fewer than 8')
    """
    both = given_sample(a), given_sample(b)
    found = _rocking.contrast(*both, n_resamples, seed(rng))
    return Contrast._of(found)
