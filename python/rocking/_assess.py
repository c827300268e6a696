"""From objects and records to which object is damaged first."""

from __future__ import annotations

import json
import os
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, Literal

from . import _rocking
from ._fragility import Hazard, ModelError, ModelValue, model_error
from ._ida import _events
from ._inputs import (
    STANDARD_GRAVITY,
    Block,
    Record,
    embedded_suite,
    given,
    number,
    pair_of,
)
from ._outputs import replace
from ._results import Bounds, Result
from ._statistics import Fragility, seed


@dataclass(frozen=True)
class Floor:
    """A floor of a building that moves in one linear mode.

    `height_ratio` is the participation factor of the mode times its shape at
    the floor: 0 on the ground, some 1.3 to 1.6 at the roof.
    """

    name: str
    period_s: float
    damping: float
    height_ratio: float


@dataclass(frozen=True)
class Object:
    """A free-standing object.

    `id` is any text; the key for files of other programs is made of it.
    `friction` is the coefficient of friction of its floor, if known;
    `limit_ratio` a rotation over alpha that must not be exceeded; no `floor`
    is the ground. `notes` are further columns of an inventory, `position_m`
    the centre in the room in m.
    """

    id: str
    block: Block
    eta: float = 0.92
    friction: float | None = None
    limit_ratio: float | None = None
    floor: Floor | None = None
    notes: Mapping[str, str] = field(default_factory=dict)
    position_m: tuple[float, float] | None = None

    def _given(self) -> _rocking.GivenObject:
        on = self.floor
        floor = None
        if on is not None:
            floor = (on.name, on.period_s, on.damping, on.height_ratio)
        return {
            "id": self.id,
            "block": pair_of(self.block),
            "eta": self.eta,
            "friction": self.friction,
            "limit_ratio": self.limit_ratio,
            "floor": floor,
            "notes": list(self.notes.items()),
            "position_m": self.position_m,
        }


@dataclass(frozen=True)
class DamageProbability(Result):
    """Probability of damage at an intensity, with its interval."""

    im: float
    p: float
    low: float | None
    high: float | None


@dataclass(frozen=True)
class Contribution(Result):
    """Annual frequency of damage by motions between two intensities."""

    from_im: float
    to_im: float
    annual_frequency: float


@dataclass(frozen=True)
class Answer(Result):
    """The answer of a fragility with the model error; intensities are in the
    unit of the assessment."""

    median_im: Bounds
    im_at_5_percent: Bounds
    records: Fragility
    """Fit of the records, without the model error."""
    model_bias: float
    model_dispersion: float
    annual_frequency: Bounds | None
    probability: Bounds | None


@dataclass(frozen=True)
class Alternative(Answer):
    """The answer under another assumption."""

    assumption: str


@dataclass(frozen=True)
class DamagedTogether(Answer):
    """Joint damage of several objects by the same earthquake."""

    at_least: int


@dataclass(frozen=True)
class IntervalPart(Result):
    """The answer if only one source is uncertain: return period in years, or
    intensity of 5 % damage without a hazard curve."""

    source: str
    low: float
    high: float


@dataclass(frozen=True)
class Remedy(Result):
    """A measure that changes the return period of an object."""

    measure: str
    """wider-base, lower-centre, isolation, yielding-tie or
    tie-against-uplift."""
    size: float
    """Width in m, how much lower in m, period in s, force over weight."""
    return_period_years: Bounds | None
    """None if no size up to this one meets the target, and of a tie against
    uplift."""
    target: str | None


@dataclass(frozen=True)
class ObjectFacts(Result):
    """What is known of an object without its answer."""

    id: str
    """Key in files of other programs."""
    label: str
    state: str
    """ranked, remarked or not rocking"""
    remarks: tuple[str, ...]
    notes: dict[str, str]
    position_m: tuple[float, ...] | None
    width_m: float
    height_m: float
    alpha_rad: float
    p_rad_s: float
    eta: float
    friction: float | None
    floor: str | None
    damage: str
    onset_pga_g: float
    lean_m: float
    """How far its top leans beyond its base at the rotation of damage."""
    falls_on: tuple[str, ...]


@dataclass(frozen=True)
class SlidingObject(ObjectFacts):
    """An object that slides before it rocks. It has no rank."""

    friction_share: float
    needed_friction: float | None
    """None if no friction is enough."""


@dataclass(frozen=True)
class AssessedObject(ObjectFacts, Answer):
    """An object that rocks."""

    return_period_years: Bounds | None
    parts: tuple[IntervalPart, ...]
    target: str | None
    """meets, does not meet or undecided"""
    remedies: tuple[Remedy, ...]
    p_damage: tuple[DamageProbability, ...]
    contributions: tuple[Contribution, ...]
    first_in_draws: float
    friction_share: float | None
    unresolved: int
    analyses: int
    records_without_damage: int
    best_im: str | None
    best_im_dispersion: float | None
    records_needed: float | None
    alternatives: tuple[Alternative, ...]


@dataclass(frozen=True)
class RecordedMotions(Result):
    """Difference of recorded motions from embedded ones, a factor of each
    capacity on the ground."""

    blocks: int
    """Blocks whose medians are compared."""
    median_ratio: Bounds
    """Median intensity of overturning under recorded motions over that under
    embedded ones: the median of these blocks, the least and the largest."""


@dataclass(frozen=True)
class Assessment(Result):
    """Objects under a suite, the one that needs attention first before all."""

    im: str
    unit: str
    records: int
    replicates: int
    seed: int
    drawn: str
    level: float
    remark: str | None
    """Why the intervals are rough: few records, earthquakes or draws."""
    model_error: ModelError
    """In every answer except the alternative without it."""
    years: float
    remarks: tuple[str, ...]
    """On the hazard curve."""
    longest_years: float | None
    """Return period of its last point; longer ones are not known."""
    target_years: float | None
    sliding_share: float
    correlation: Bounds | None
    objects: tuple[AssessedObject, ...]
    not_rocking: tuple[SlidingObject, ...]
    """Objects that slide first."""
    together: tuple[DamagedTogether, ...]
    recorded_motions: RecordedMotions | None
    _files: dict[str, str] = field(default_factory=dict, repr=False)

    def to_dict(self) -> dict[str, Any]:
        """The numbers of `assess.json`."""
        return {k: v for k, v in super().to_dict().items() if k != "_files"}

    def to_html(self) -> str:
        """The page, in one file that needs no script and no network."""
        return self._files["index.html"]

    def save(self, folder: str | os.PathLike[str]) -> None:
        """Writes the page and its files into a folder, which is made."""
        place = Path(folder)
        place.mkdir(parents=True, exist_ok=True)
        # The page comes last: where it is, all files are.
        for name in sorted(self._files, key=lambda name: name == "index.html"):
            replace(place / name, self._files[name])


def assess(
    objects: Object | Sequence[Object],
    suite: Sequence[Record] | None = None,
    *,
    hazard: Hazard | None = None,
    years: float = 50.0,
    target: float | None = None,
    sliding_share: float = 0.05,
    certify: bool = False,
    n_resamples: int = 1000,
    rng: int = 0,
    model_dispersion: ModelValue | None = None,
    model_bias: ModelValue | Literal["fitted"] | None = None,
    gravity: float = STANDARD_GRAVITY,
    threads: int | None = None,
) -> Assessment:
    """Which object is damaged first, how often, and how sure that is.

    Parameters
    ----------
    objects : Object or sequence of Object
    suite : sequence of Record, optional
        Records of the site; without them the 86 synthetic motions of
        `embedded_suite("ordinary")`.
    hazard : Hazard, optional
        Hazard curve of the site. With it objects come by falling annual
        frequency of damage, without it by the rising PGA that damages them
        with a probability of 5 %.
    years : float
        Years of probabilities.
    target : float, optional
        Return period in years that each object is to reach, or a probability
        of damage in `years`; with measures that reach it.
    sliding_share : float
        Share of the records above which an object that slides before its
        damage counts as not rocking.
    certify : bool
        Decide each outcome in the arithmetic that it needs.
    n_resamples, rng : int
        Draws of the bootstrap, of earthquakes if these are known, and their
        repetition.
    model_dispersion, model_bias : float or (value, low, high), optional
        Error of the model, as in `risk`, without that of the coefficient of
        restitution, which is varied here.
    gravity : float
        In m/s2.
    threads : int
        All processors unless given.

    >>> cabinet = Object("cabinet", Block.from_dimensions(width_m=0.5, height_m=1.8))
    >>> lobe = [Record([0.0, 0.3, 0.0], 0.2 + 0.1 * k, units="g", name=f"r{k}")
    ...         for k in range(3)]
    >>> found = assess(cabinet, lobe, n_resamples=20)
    >>> found.objects[0].median_im.point > 0.5 / 1.8
    True
    """
    embedded = suite is None
    records = list(embedded_suite("ordinary") if suite is None else suite)
    all_objects = [objects] if isinstance(objects, Object) else list(objects)
    files = _rocking.assess(
        [one._given() for one in all_objects],
        [given(record) for record in records],
        _events(records),
        embedded,
        None if hazard is None else hazard._written,
        {
            "years": number(years, "years"),
            "target": None if target is None else number(target, "target"),
            "sliding_share": number(sliding_share, "sliding_share"),
            "certify": certify,
            "replicates": n_resamples,
            "seed": seed(rng),
            "gravity": number(gravity, "gravity"),
            "model_error": model_error(model_dispersion, model_bias),
        },
        threads,
    )
    numbers = json.loads(files["assess.json"])
    for key in ("schema", "version", "provenance"):
        del numbers[key]
    found = Assessment._of(json.dumps(numbers))
    object.__setattr__(found, "_files", files)
    return found
