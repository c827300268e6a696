"""Results of the procedures: what the command line prints as JSON.

Each class has the fields of that JSON, in its order. A field that may be
None is a number that is infinite or not known.
"""

from __future__ import annotations

import json
from dataclasses import asdict, dataclass, is_dataclass
from types import NoneType, UnionType
from typing import Any, Literal, TypeVar, get_args, get_origin, get_type_hints


R = TypeVar("R", bound="Result")
Verdict = Literal["rejected", "not-rejected", "indeterminate"]


def _made(kind: Any, value: Any) -> Any:
    """A value of this type, made from parsed JSON."""
    if value is None:
        return None
    if get_origin(kind) is tuple:
        return tuple(_made(get_args(kind)[0], one) for one in value)
    if get_origin(kind) is dict:
        return {key: _made(get_args(kind)[1], one) for key, one in value.items()}
    if get_origin(kind) is UnionType:
        kinds = [one for one in get_args(kind) if one is not NoneType]
        if Reason in kinds:
            is_reason = isinstance(value, dict) and [*value] == ["reason"]
            kinds = [k for k in kinds if (k is Reason) == is_reason]
        return _made(kinds[0], value)
    if is_dataclass(kind):
        hints = get_type_hints(kind)
        made = {key: _made(hints[key], one) for key, one in value.items()}
        make: Any = kind
        return make(**made)
    return value


class Result:
    """A result of a procedure."""

    @classmethod
    def _of(cls: type[R], text: str) -> R:
        found: R = _made(cls, json.loads(text))
        return found

    @classmethod
    def _all(cls: type[R], text: str) -> tuple[R, ...]:
        return tuple(_made(cls, one) for one in json.loads(text))

    def to_dict(self) -> dict[str, Any]:
        """The fields by their names, results within it too."""
        assert is_dataclass(self)
        return asdict(self)

    def to_json(self) -> str:
        """The JSON that the command line prints, on one line."""
        return json.dumps(self.to_dict(), allow_nan=False)


@dataclass(frozen=True)
class Reason(Result):
    """Why there is no result."""

    reason: str


@dataclass(frozen=True)
class Estimate(Result):
    """A number with its bootstrap interval."""

    point: float
    low: float | None
    """None of a number without an interval."""
    high: float | None
    standard_error: float | None
    """Of the logarithm, if the number is positive."""
    level: float
    used: int
    """Samples drawn that gave a finite value."""
    replicates: int


@dataclass(frozen=True)
class IntervalBasis(Result):
    """Basis of intervals."""

    replicates: int
    seed: int
    drawn: str
    """The unit that was drawn: records, or earthquakes with all their
    records."""
    level: float
    remark: str | None
    """Why the intervals are rough: fewer than 8 earthquakes (records) or 200
    draws. Of fewer than 3 there is no interval."""


@dataclass(frozen=True)
class FitIntervals(IntervalBasis):
    """Bootstrap intervals of the numbers of a fit; None of a number that a
    tenth of the draws do not have."""

    log_mean: Estimate | None
    dispersion: Estimate | None
    median: Estimate | None
    eq5: Estimate | None
    eq6: Estimate | None
    eq7: Estimate | None


@dataclass(frozen=True)
class BandPoint(Result):
    """A probability with its band, by the bootstrap and by the delta
    method."""

    intensity: float
    probability: float
    low: float | None
    high: float | None
    delta_low: float | None
    delta_high: float | None


@dataclass(frozen=True)
class Band(IntervalBasis):
    """Bands of a fragility, of one intensity at a time."""

    points: tuple[BandPoint, ...]


@dataclass(frozen=True)
class Needed(Result):
    """How many records bring median and dispersion to a relative precision at
    a level, if dispersion and earthquakes stay as they are."""

    precision: float
    level: float
    for_median: float
    for_dispersion: float
    intraclass_correlation: float | None
    """None if no earthquake has two records."""
    design_effect: float
    """Number of records that are worth one independent record."""


@dataclass(frozen=True)
class ShiftInterval(Result):
    """Likelihood interval of a free shift."""

    low: float
    high: float | None
    level: float


@dataclass(frozen=True)
class Transformed(Result):
    """Eqs. 5 to 7 applied to the unshifted statistics."""

    shift: float
    c: float
    c_max: float | None
    eq5: float | Reason | None
    eq6: float | Reason | None
    eq7: float | Reason | None


@dataclass(frozen=True)
class Bounds(Result):
    """A number with the ends of its likelihood interval."""

    point: float
    low: float | None
    high: float | None


@dataclass(frozen=True)
class Statistic(Result):
    """Lilliefors' D and its one-sided parts."""

    n: int
    d: float
    d_plus: float
    d_minus: float


@dataclass(frozen=True)
class PValue(Result):
    """A p-value with the interval (95 %) of its Monte Carlo error."""

    value: float
    low: float
    high: float


@dataclass(frozen=True)
class OtherTest(Result):
    """A test beside Lilliefors'."""

    statistic: float
    p_value: float
    p_low: float | None
    p_high: float | None
    verdict: Verdict | None


@dataclass(frozen=True)
class Normality(Result):
    """Tests of (log)normality; `reason` says why one does not apply."""

    n: int
    distinct: int | None
    largest_tie: int | None
    statistic: Statistic | None
    p_value: PValue | None
    method: str | None
    replicates: int | None
    critical_value: float | None
    level: float
    verdict: Verdict | None
    reason: str | None
    anderson_darling: OtherTest | None
    cramer_von_mises: OtherTest | None
    shapiro_wilk: OtherTest | None


@dataclass(frozen=True)
class Quantile(Result):
    """A quantile of a sample; None if it is censored."""

    probability: float
    value: float | None


@dataclass(frozen=True)
class MedianInterval(Result):
    """Exact order-statistic interval of a median."""

    low: float
    high: float | None
    rank: int
    coverage: float


@dataclass(frozen=True)
class Boxplot(Result):
    """Box, McGill's notch, whiskers and outliers."""

    n: int
    q1: float
    median: float
    q3: float
    notch_low: float
    notch_high: float
    whisker_low: float
    whisker_high: float
    outliers: tuple[float | None, ...]
    median_interval: MedianInterval | None

    def plot(self, ax: Any = None) -> Any:
        """Draws the notched box; gives the matplotlib axes."""
        ax = axes(ax)
        box = {
            "q1": self.q1,
            "med": self.median,
            "q3": self.q3,
            "cilo": self.notch_low,
            "cihi": self.notch_high,
            "whislo": self.whisker_low,
            "whishi": self.whisker_high,
            "fliers": [x for x in self.outliers if x is not None],
        }
        ax.bxp([box], shownotches=True)
        return ax


@dataclass(frozen=True)
class Summary(Result):
    """A sample in a few numbers."""

    n: int
    censored: int
    quantile_type: int
    quantiles: tuple[Quantile, ...]
    boxplot: Boxplot | Reason


@dataclass(frozen=True)
class SignTest(Result):
    """Exact two-sided binomial test with probability 1/2."""

    above: int
    below: int
    equal: int
    p_value: float


@dataclass(frozen=True)
class HodgesLehmann(Result):
    """Centre of the ratios with its interval."""

    ratio: float
    low: float
    high: float
    level: float


@dataclass(frozen=True)
class SignEquivalence(Result):
    """Two one-sided sign tests of the median ratio."""

    margin: float
    p_lower: float
    p_upper: float
    p_value: float


@dataclass(frozen=True)
class Equivalence(Result):
    """Two one-sided t tests of the geometric mean, with its 90 %
    interval."""

    margin: float
    geometric_mean: float
    low: float
    high: float
    p_lower: float
    p_upper: float
    p_value: float


@dataclass(frozen=True)
class Comparison(Result):
    """Two samples over the same records, by their ratios a/b."""

    n: int
    only_a_infinite: int
    only_b_infinite: int
    both_infinite: int
    both_zero: int
    only_a_zero: int
    only_b_zero: int
    usable: int
    share: float
    boxplot: Boxplot | None
    sign_test: SignTest
    mcnemar: SignTest
    hodges_lehmann: HodgesLehmann | Reason
    mean_equivalence: Equivalence | Reason
    median_equivalence: SignEquivalence | Reason


@dataclass(frozen=True)
class ContrastedSample(Result):
    """One sample of a contrast; `median` is None if censored values leave it
    unknown."""

    n: int
    censored: int
    median: float | None
    drawn: str
    """The unit that the bootstrap draws."""


@dataclass(frozen=True)
class MedianRatio(Result):
    """A ratio of medians with its bootstrap interval; its ends are None if a
    tenth of the draws leave it open."""

    point: float
    low: float | None
    high: float | None
    level: float
    open: int
    """Draws in which censored values leave the ratio open."""
    remark: str | None
    """Why the interval is rough: few records, earthquakes or draws."""


@dataclass(frozen=True)
class Distance(Result):
    """Kolmogorov and Smirnov's comparison of two samples."""

    distance: float
    up_to: float | None
    """The least limit of a censored value, up to which they are compared."""
    p_value: float | Reason


@dataclass(frozen=True)
class Contrast(Result):
    """Two samples over different records: the ratio of their medians a/b, and
    the distance of their distributions."""

    a: ContrastedSample
    b: ContrastedSample
    median_ratio: MedianRatio | Reason
    kolmogorov_smirnov: Distance
    replicates: int
    seed: int


@dataclass(frozen=True)
class Slope(Result):
    """Line of ln(capacity) on a property of the records, with a random
    intercept for each earthquake that has several."""

    on: str
    intercept: float
    slope: float
    standard_error: float
    residual_deviation: float
    event_deviation: float | None
    """Between earthquakes; None of a line by least squares."""
    degrees_of_freedom: float
    p_value: float
    n: int


@dataclass(frozen=True)
class Ranked(Result):
    """Results for one intensity measure.

    `dispersion` is the efficiency, small is good; a small p-value among
    `slopes` says that the measure is not sufficient.
    """

    im: str
    median: float
    dispersion: Estimate
    ratio_to_first: Estimate
    slopes: tuple[Slope, ...]


@dataclass(frozen=True)
class Ranking(Result):
    """Intensity measures in the requested order.

    Records that do not reach the response are `censored`: they enter by the
    intensity up to which they were run.
    """

    n: int
    censored: int
    replicates: int
    seed: int
    drawn: str
    level: float
    remark: str | None
    """Why the intervals are rough: few records, earthquakes or draws."""
    no_slope: str | None
    """Why there is no slope."""
    measures: tuple[Ranked, ...]

    def plot(self, ax: Any = None) -> Any:
        """Draws the dispersions with their intervals; gives the matplotlib
        axes."""
        ax = axes(ax)
        shown = [m.dispersion for m in self.measures]
        below = [0.0 if e.low is None else e.point - e.low for e in shown]
        above = [0.0 if e.high is None else e.high - e.point for e in shown]
        ax.errorbar(
            [m.im for m in self.measures],
            [e.point for e in shown],
            [below, above],
            fmt="o",
        )
        ax.set_ylabel("dispersion")
        ax.tick_params("x", rotation=90)
        return ax


@dataclass(frozen=True)
class ResolutionCounts(Result):
    """How many analyses each arithmetic resolved."""

    analyses: int
    assessed: int
    resolved_by_double: int
    resolved_by_double_double: int
    resolved_by_octuple: int
    unresolved: int
    wrong_in_double: int
    """Analyses that have another fate in double precision."""
    only_these_doubles: int
    """Resolved for the doubles given, not for all inputs that round to
    them."""


@dataclass(frozen=True)
class CurveSummary(Result):
    """One curve, counted; `overturning_im` is None if the block stays up."""

    record: str
    levels: int
    overturning_im: float | None


@dataclass(frozen=True)
class IdaSummary(Result):
    """The curves of a suite, counted."""

    records: int
    analyses: int
    """Bisection included."""
    overturned_curves: int
    median_overturning_im: float | None
    """PGA/(g tan alpha); None if half of the curves do not overturn."""
    resolution: ResolutionCounts
    resurrections: int | None
    """Levels above a first overturning at which the block stays up again."""
    curves: tuple[CurveSummary, ...]


@dataclass(frozen=True)
class FrictionNeed(Result):
    """How many analyses need more than this coefficient of friction."""

    friction: float
    need_more: int
    share: float


@dataclass(frozen=True)
class PivotForces(Result):
    """Friction |H|/N and normal force N/(m g) that analyses need at the pivot;
    `largest_friction` is None if N is not positive."""

    analyses: int
    needs: tuple[FrictionNeed, ...]
    largest_friction: float | None
    least_normal_over_weight: float


@dataclass(frozen=True)
class StripeResponses(Result):
    """The responses at one intensity; quantiles are None if the block
    overturned. If `open` records were not run up to the intensity, quantiles
    and the share that overturned are too high, and `exceeded` is None."""

    intensity: float
    n: int
    edp16: float | None
    edp50: float | None
    edp84: float | None
    overturned: int
    open: int
    exceeded: int | None


@dataclass(frozen=True)
class LevelCapacities(Result):
    """Quantiles of the capacities at one EDP level; None if censored."""

    edp: float | None
    im16: float | None
    im50: float | None
    im84: float | None
    censored: int
    stripe_discrepancy: float


@dataclass(frozen=True)
class LevelCrossings(Result):
    """All crossings of one EDP level by one curve, and the capacities made of
    them; None if the level is not reached."""

    edp: float | None
    median: float | None
    first: float | None
    last: float | None
    monotone: float | None
    crossings: tuple[float | None, ...]


@dataclass(frozen=True)
class Measures(Result):
    """Intensity measures of a record, or of a pair.

    `spectral_acceleration_g` is at the requested periods;
    `significant_duration_5_75_s` is from 5 to 75 % of the Arias intensity.
    """

    pga_g: float
    pgv_m_s: float
    pgd_m: float
    arias_intensity_m_s: float
    cav_m_s: float
    significant_duration_5_75_s: float
    significant_duration_5_95_s: float
    mean_period_s: float | None
    spectral_acceleration_g: tuple[float, ...]


@dataclass(frozen=True)
class VelocityPulse(Result):
    """A velocity pulse, after Shahi and Baker (2014)."""

    direction_rad: float
    period_s: float
    time_s: float
    pgv_m_s: float
    pgv_ratio: float
    energy_ratio: float
    indicator: float
    late: bool


def axes(ax: Any) -> Any:
    """The axes given, or new ones."""
    if ax is not None:
        return ax
    from matplotlib import pyplot

    return pyplot.subplots()[1]
