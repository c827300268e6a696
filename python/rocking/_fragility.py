"""Fragilities of blocks: by the law of AvgSA, for other programs, and under a
hazard curve."""

from __future__ import annotations

import os
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Literal

import numpy as np

from . import _rocking
from ._analyses import physics
from ._choices import ExchangeFormat
from ._inputs import (
    STANDARD_GRAVITY,
    Block,
    Eta,
    Floats,
    Model,
    frozen,
    number,
    pair_of,
)
from ._outputs import replace
from ._results import Bounds, IntervalBasis, Result
from ._statistics import (
    CloudLevel,
    CountsFragility,
    Fragility,
    FragilityFit,
    _Fit,
    seed,
)


@dataclass(frozen=True)
class ModelError(Result):
    """Bias and dispersion of the model: each a value, and the range over
    which the draws of an interval spread it."""

    bias: Bounds
    dispersion: Bounds


@dataclass(frozen=True)
class LawFragility(_Fit):
    """The fragility of one block by the law of AvgSA."""

    alpha_rad: float
    p_rad_s: float
    eta: float
    edp: float | None
    """Peak |theta|/alpha; None is overturning."""
    im: str
    periods_s: tuple[float, ...]
    """The periods of the measure, in equal ratios."""
    median_ratio: float
    """Median AvgSA over g tan alpha."""
    record_dispersion: float
    """By the choice of the record."""
    law_error: float
    """Root mean square of the logarithm of the median by analyses over the
    median by the law."""
    fitted: Fragility
    """In AvgSA (g), both dispersions together."""
    model_error: ModelError
    total: Fragility
    """With the error of the model."""
    origin: str
    """Its origin, in words."""


Fit = FragilityFit | CountsFragility | LawFragility | CloudLevel


def law_fragility(
    block: Block,
    *,
    eta: Eta = 0.92,
    edp: float = np.inf,
    model_dispersion: ModelValue | None = None,
    model_bias: ModelValue | Literal["fitted"] | None = None,
) -> LawFragility:
    """Fragility of a block in AvgSA, without an analysis, with its errors.

    AvgSA is the geometric mean of SA(T, 5 %) over twelve periods from 0.15 to
    1.0 times 2 pi/p, the measure "avgsa:rocking". One law gives the fragility
    of every block and kind of ground motion.

    Parameters
    ----------
    block : Block
    eta
        As in `respond`.
    edp : float
        Peak |theta|/alpha; infinite for overturning.
    model_dispersion, model_bias
        As in `risk`.

    >>> found = law_fragility(Block(alpha=0.15, p=3.0))
    >>> round(found.median_ratio, 2), round(found.fitted.median, 3)
    (2.36, 0.357)
    """
    error = model_error(model_dispersion, model_bias)
    known = physics(eta, "nonlinear", "alpha")["eta"]
    found = _rocking.law(pair_of(block), known, float(edp), error)
    return LawFragility._of(found)


def _source(fit: Fit) -> str | int:
    """The origin of a fit in words, or the size of its sample."""
    if isinstance(fit, LawFragility):
        return fit.origin
    if isinstance(fit, CloudLevel):
        return "a cloud of unscaled records"
    if isinstance(fit, CountsFragility):
        if fit.degrees_of_freedom is None:
            return "outcomes of each record"
        stripes = fit.degrees_of_freedom + 2
        return f"counts of exceedance at {stripes} intensities"
    return fit.n


@dataclass(frozen=True, kw_only=True)
class BlockFragility:
    """The fragilities of one block, for another program or a hazard curve.

    A fit in PGA or PGV is dimensionless. The file has the block's own PGA in
    g, or PGV in the unit that the reader expects.
    """

    block: Block
    fit: Fit | Sequence[Fit]
    """One, or one a limit state in the order of rising damage."""
    im: str
    """Intensity measure of the fit: "pga" for PGA/(g tan alpha), "pgv" for p
    PGV/(g tan alpha), or another name of `Ida.against` in its own unit."""
    id: str | None = None
    """Name in the file, of ASCII letters, digits, `_` and `:`; from alpha and
    p unless given."""
    limit_states: Sequence[str] = ()
    """Name of each limit state; "exceeded" unless given, or of several LS1,
    LS2 and so on."""
    eta: float | None = None
    model: Model = "nonlinear"
    """The linearized equation has alpha in place of tan alpha."""
    origin: str | None = None
    """Origin of the fragilities, in words."""

    def __post_init__(self) -> None:
        pair_of(self.block)
        object.__setattr__(self, "im", _rocking.measure(self.im))

    def _wanted(self) -> _rocking.Wanted:
        fits = [self.fit] if isinstance(self.fit, Fit) else [*self.fit]
        names = [*self.limit_states]
        if not names and len(fits) == 1:
            names = ["exceeded"]
        names = names or [f"LS{i + 1}" for i in range(len(fits))]
        if len(names) != len(fits):
            raise ValueError(
                f"limit_states: found {len(names)}: expected one for each of "
                f"{len(fits)} limit states"
            )
        return {
            "block": pair_of(self.block),
            "limit_states": [
                (name, fit.fitted._law, _source(fit))
                for name, fit in zip(names, fits)
            ],
            "im": self.im,
            "id": self.id,
            "eta": self.eta,
            "model": self.model,
            "origin": self.origin,
        }


def export(
    blocks: Sequence[BlockFragility],
    path: str | os.PathLike[str] | None = None,
    *,
    format: ExchangeFormat,
    gravity: float = STANDARD_GRAVITY,
    model_dispersion: ModelValue | None = None,
    model_bias: ModelValue | Literal["fitted"] | None = None,
) -> str:
    """Fragilities of blocks as one file of another program.

    They hold the error of the model, as in `risk`.

    Formats: EXCHANGE_FORMATS.

    OpenQuake and pelicun have no lognormal with a shift: such a fit is written
    as points, which are off by at most 5e-4 in probability.

    Parameters
    ----------
    blocks : sequence of BlockFragility
    path : str or path-like, optional
        The file.
    format : str
        One of the formats above.
    gravity : float
        In m/s2, for PGV.
    model_dispersion, model_bias
        As in `risk`.

    Returns
    -------
    str
        The text, with the bytes of `rocking fragility export`; it is written
        to `path` if that is given, and a second file beside it.

    >>> from rocking import fit_fragility
    >>> fit = fit_fragility([1.5, 2.0, 3.0], shift=1.0)
    >>> one = BlockFragility(block=Block(alpha=0.2, p=3.0), fit=fit, im="pga")
    >>> print(export([one], format="nrml").splitlines()[5])
    <fragilityFunction id="block_a0_2_p3" format="discrete">
    """
    wanted = [block._wanted() for block in blocks]
    error = model_error(model_dispersion, model_bias)
    text, beside = _rocking.exchange(format, wanted, gravity, error)
    if path is None:
        return text
    files = [(Path(path), text)]
    if beside is not None:
        extension, second = beside
        files.append((Path(path).with_suffix(f".{extension}"), second))
        if files[1][0] == files[0][0]:
            raise ValueError(
                f"{path}: expected a file .csv, beside which a file "
                f".{extension} is written"
            )
    for file, content in files:
        replace(file, content)
    return text


export.__doc__ = (export.__doc__ or "").replace(
    "EXCHANGE_FORMATS", "; ".join(_rocking.EXCHANGE_FORMATS)
)


@dataclass(frozen=True)
class HazardPoint(Result):
    """A point of a hazard curve."""

    intensity: float
    annual_frequency: float


@dataclass(frozen=True)
class Hazard:
    """A hazard curve, as its file has it.

    `years` are the years of probabilities of exceedance, if the file does not
    say them, and `site` is the longitude and latitude in degrees, or the
    `custom_site_id`, if it has several.
    """

    place: str
    """The file, for errors."""
    text: str
    years: float | None = None
    site: tuple[float, float] | str | None = None

    def __post_init__(self) -> None:
        # What is refused is refused here.
        _ = self.points

    def __repr__(self) -> str:
        return f"Hazard({self.place!r}, im={self.im!r}, unit={self.unit!r})"

    @property
    def _written(self) -> _rocking.Written:
        return self.place, self.text, self.years, self.site

    @property
    def points(self) -> Floats:
        """(n, 2): intensity, and annual frequency of exceedance."""
        return frozen(np.array(_rocking.hazard(self._written)[0]))

    @property
    def im(self) -> str | None:
        """The intensity measure; None if it is the same as the fragility's."""
        return _rocking.hazard(self._written)[1]

    @property
    def unit(self) -> str:
        """Unit of the intensities."""
        return _rocking.hazard(self._written)[2]

    @property
    def remarks(self) -> Sequence[str]:
        """Remarks on what was set aside of the file."""
        return _rocking.hazard(self._written)[3]


def read_hazard(
    path: str | os.PathLike[str],
    *,
    years: float | None = None,
    site: tuple[float, float] | str | None = None,
) -> Hazard:
    """Reads a hazard curve: OpenQuake's CSV, or a CSV of two columns.

    The first is `pga_g`, `pgv_m_s`, `pgv_cm_s` or `intensity` (the unit of
    the fragility), the second `annual_frequency` or
    `probability_of_exceedance` in `years`.

    Parameters
    ----------
    path : str or path-like
    years : float, optional
        Years of the probabilities, if the file does not state them.
    site : (longitude, latitude) in degrees or str, optional
        Which site of several: its place, or its `custom_site_id`.

    >>> from tempfile import TemporaryDirectory
    >>> with TemporaryDirectory() as folder:
    ...     path = Path(folder, "hazard.csv")
    ...     text = "pga_g,annual_frequency\\n0.05,0.02\\n0.2,0.002\\n1,0\\n"
    ...     _ = path.write_text(text)
    ...     found = read_hazard(path)
    >>> found.im, found.points.tolist()
    ('pga', [[0.05, 0.02], [0.2, 0.002]])
    """
    text = Path(path).read_text(encoding="utf-8")
    return Hazard(os.fspath(path), text, years, site)


@dataclass(frozen=True)
class TotalFragility(Result):
    """A fragility with the error of the model: quantiles, and the parts.

    A capacity is model_bias exp(model_dispersion Z) times one of `records`, Z
    standard normal."""

    im16: float
    median: float
    im84: float
    model_bias: float
    model_dispersion: float
    records: Fragility


@dataclass(frozen=True)
class SamplingInterval(IntervalBasis):
    """Uncertainty by the choice of records and the model error of a frequency
    and a probability; the hazard curve counts as known."""

    model_error: ModelError | None
    """None without a model error."""
    annual_frequency_low: float
    annual_frequency_high: float
    probability_low: float
    probability_high: float


@dataclass(frozen=True)
class FragilityRisk(Result):
    """Annual frequency and probability of damage of one fragility.

    Lower and upper are bounds of the hazard curve's truncation at its last
    point, and no confidence interval: that is `sampling`.
    """

    fragility: str
    """Its name."""
    fitted: TotalFragility
    """In the unit of the hazard curve."""
    annual_frequency_truncation_lower: float
    annual_frequency_truncation_upper: float
    annual_frequency_covered: float
    """Of what the points cover."""
    probability_truncation_lower: float
    probability_truncation_upper: float
    probability_at_first_point: float
    """If it is not 0, weaker motions add to the frequency."""
    sampling: SamplingInterval | None
    """None for a fragility without a sample."""


@dataclass(frozen=True)
class Risk(Result):
    """Annual frequencies of damage under a hazard curve, and probabilities of
    damage in some years."""

    im: str | None
    unit: str
    points: int
    first: HazardPoint
    last: HazardPoint
    remarks: tuple[str, ...]
    years: float
    fragilities: tuple[FragilityRisk, ...]


def risk(
    hazard: Hazard,
    fragilities: Mapping[str, Fragility | FragilityFit | BlockFragility],
    *,
    years: float = 50.0,
    gravity: float = STANDARD_GRAVITY,
    n_resamples: int = 1000,
    rng: int = 0,
    model_dispersion: ModelValue | None = None,
    model_bias: ModelValue | Literal["fitted"] | None = None,
) -> Risk:
    """Annual frequency of damage, and its probability in `years`.

    Between the points of the hazard curve the frequency is a power of the
    intensity; beyond the last one nothing is assumed.

    Parameters
    ----------
    hazard : Hazard
    fragilities : mapping of names to Fragility, FragilityFit or BlockFragility
        Fragilities in the unit of the hazard curve, and those of blocks,
        which are brought to it. Fits to a sample above a known shift have a
        sampling interval; a Fragility is taken as it is, without an error of
        the model unless one is given.
    years : float
        Years of the probability.
    gravity : float
        In m/s2, for the PGV of blocks.
    n_resamples, rng : int
        Bootstrap samples of a fit's records, of earthquakes if they are known,
        and their repetition; 0 for no interval.
    model_dispersion, model_bias : float or (value, low, high), optional
        Error of the model. By default 0.2 (0 to 0.25) and 1 (0.77 to 1.3);
        0 and 1 are none, "fitted" is the bias of an object whose slenderness
        was fitted to its own tests. A value without a range counts as known.

    >>> text = "intensity,annual_frequency\\n1e-6,1e8\\n1e6,1e-16\\n"
    >>> hazard = Hazard("power law", text)
    >>> law = Fragility(shift=0.0, log_mean=0.0, dispersion=0.5, median=1.0)
    >>> row = risk(hazard, {"block": law}).fragilities[0]
    >>> round(row.annual_frequency_truncation_lower, 9)  # exp(0.5)/10,000
    0.000164872
    """
    exposed = [(name, *_exposed(one)) for name, one in fragilities.items()]
    found = _rocking.risk(
        hazard._written,
        exposed,
        gravity,
        years,
        n_resamples,
        seed(rng),
        model_error(model_dispersion, model_bias),
    )
    return Risk._of(found)


ModelValue = float | tuple[float, float, float]


def model_error(
    dispersion: ModelValue | None, bias: ModelValue | str | None
) -> _rocking.ModelError:
    """Dispersion and bias as the command spells them."""

    def text(value: ModelValue | str | None, what: str) -> str | None:
        if value is None or isinstance(value, str):
            return value
        numbers = value if isinstance(value, tuple) else (value,)
        return ",".join(repr(number(one, what)) for one in numbers)

    return text(dispersion, "model_dispersion"), text(bias, "model_bias")


def _exposed(
    one: Fragility | FragilityFit | BlockFragility,
) -> tuple[_rocking.Law | _rocking.Wanted, list[_rocking.Behind]]:
    """A fragility, and the samples behind it."""
    if isinstance(one, Fragility):
        return one._law, []
    if isinstance(one, FragilityFit):
        return one.fitted._law, [one._behind]
    fits = [one.fit] if isinstance(one.fit, Fit) else [*one.fit]
    return one._wanted(), [getattr(fit, "_behind", None) for fit in fits]
