"""A block against shaking-table tests."""

from __future__ import annotations

import os
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Literal

from . import _rocking
from ._analyses import physics
from ._inputs import (
    STANDARD_GRAVITY,
    Block,
    Eta,
    Model,
    Record,
    Units,
    given,
    number,
    pair_of,
    warn_of_remarks,
)
from ._results import Bounds, Result
from ._statistics import seed

Fate = Literal["overturned", "stood", "unknown"]


@dataclass(frozen=True)
class ShakingTest:
    """One shaking-table test.

    `record` is the motion of the table as it was run; `motion` names the
    motion that the test repeats, at its own level. Numbers among the
    attributes of the record serve the measures `column:NAME`.
    """

    record: Record
    motion: str
    fate: Fate


@dataclass(frozen=True)
class Predictor(Result):
    """How well one number per test predicts the outcomes."""

    predictor: str
    right: Bounds
    median: Bounds
    """Of the block the median of measured over computed capacity."""
    dispersion: Bounds
    auc: Bounds
    log_score: Bounds
    log_likelihood: float


@dataclass(frozen=True)
class UnfittedMeasure(Result):
    """A measure that has no fit."""

    im: str
    computed: bool
    reason: str


@dataclass(frozen=True)
class ReliabilityClass(Result):
    """Predicted and observed overturning of a tenth of the tests."""

    tests: int
    predicted: float
    observed: Bounds


@dataclass(frozen=True)
class Repeatability(Result):
    """How well tests repeat themselves."""

    pairs: int
    different: int
    mixed_motions: int
    not_monotone: int
    dispersion: float | None


@dataclass(frozen=True)
class Resurrected(Result):
    """Tests at levels at which the block stays up again."""

    tests: int
    overturned: int
    expected: float | None
    right_at_level: float


@dataclass(frozen=True)
class OnsetComparison(Result):
    """Log-likelihoods by what the scatter of the model multiplies."""

    onset_g: float
    tests: int
    overturned_below: int
    below: int
    whole: float | None
    above: float | None
    pga_unshifted: float | None
    pga_shifted: float | None


@dataclass(frozen=True)
class DistributionComparison(Result):
    """Measured and computed fragilities of the same tests."""

    im: str
    unit: str
    measured_median: float
    measured_dispersion: float
    computed_median: float
    computed_dispersion: float
    median_ratio: Bounds
    dispersion_difference: Bounds
    missing_dispersion: Bounds


@dataclass(frozen=True)
class TestResult(Result):
    """One test of a comparison."""

    # pytest takes no class of results for tests.
    __test__ = False

    test: str
    motion: str
    pga_g: float
    intensities: tuple[float, ...]
    capacity_factor: float
    overturns_at_level: bool
    probability: float
    overturned: bool


@dataclass(frozen=True)
class TestComparison(Result):
    """A block compared with shaking-table tests."""

    __test__ = False

    tests: int
    motions: int
    overturned: int
    unknown: int
    never_overturned: int
    alpha_rad: Bounds
    alpha_is_fitted: bool
    p_rad_s: float
    eta: float
    model: str
    level: float
    replicates: int
    seed: int
    remark: str | None
    computed: Predictor
    rivals: tuple[Predictor, ...]
    unfitted: tuple[UnfittedMeasure, ...]
    reliability: tuple[ReliabilityClass, ...]
    repeatability: Repeatability
    resurrected: Resurrected
    onset: OnsetComparison
    distributions: tuple[DistributionComparison, ...]
    each: tuple[TestResult, ...]


def read_tests(
    path: str | os.PathLike[str],
    *,
    fate: str = "fate",
    dt: float | None = None,
    units: Units | None = None,
    gravity: float = STANDARD_GRAVITY,
) -> tuple[ShakingTest, ...]:
    """Reads a table of shaking-table tests, one row a test.

    The table is an index of a suite, as `read_suite` reads it, with two more
    columns: `fate` ("overturned", "stood" or "unknown", or 1, 0 or an empty
    cell), and the motion that a test repeats (`event`, or `motion`). A column
    `scale` is a factor on the motion of the file. A `UserWarning` counts
    the motions with remarks.

    Parameters
    ----------
    path : str or path-like
    fate : str
        Name of the column of outcomes.
    dt, units, gravity
        As in `read_suite`.

    Raises
    ------
    FileNotFoundError, ValueError
        As `read_suite`; with every fault of the table and its line.

    >>> from pathlib import Path
    >>> from tempfile import TemporaryDirectory
    >>> rows = ["file,motion,scale,fate", "a.txt,Kobe,0.5,stood"]
    >>> with TemporaryDirectory() as folder:
    ...     _ = Path(folder, "a.txt").write_text("0.0\\n0.3\\n0.0\\n")
    ...     table = Path(folder, "tests.csv")
    ...     _ = table.write_text("\\n".join(rows))
    ...     tests = read_tests(table, dt=0.1, units="g")
    >>> tests[0].motion, tests[0].fate, tests[0].record.pga_g
    ('Kobe', 'stood', 0.15)
    """
    found = _rocking.read_tests(path, fate, dt, units, gravity)
    tests = tuple(
        ShakingTest(Record._read(*record), motion, became)
        for record, motion, became in found
    )
    warn_of_remarks(os.fspath(path), [test.record for test in tests])
    return tests


def compare_with_tests(
    tests: Sequence[ShakingTest],
    block: Block | None = None,
    *,
    p: float | None = None,
    eta: Eta = 0.92,
    model: Model = "nonlinear",
    ims: Sequence[str] = (),
    n_resamples: int = 1000,
    rng: int = 0,
    gravity: float = STANDARD_GRAVITY,
    threads: int | None = None,
) -> TestComparison:
    """How many outcomes of tests a block predicts, its bias, and its scatter.

    Parameters
    ----------
    tests : sequence of ShakingTest
    block : Block, optional
        The block of the specimen.
    p : float, optional
        Frequency parameter in rad/s instead of the block: the slenderness is
        then fitted to the fates, so that the bias is 1.
    eta, model
        As in `respond`.
    ims : sequence of str
        Intensity measures that predict the same fates by themselves; "pga",
        "pgv" and "avgsa:0.5,1,1.5,2,3" unless given.
    n_resamples, rng : int
        Draws of motions with all their tests, and their repetition.
    gravity : float
        In m/s2, for velocities.
    threads : int
        All processors unless given.

    >>> lobes = [Record([0.0, 0.3, 0.0], 0.2 + 0.1 * k, units="g", name=f"{k}")
    ...          for k in range(8)]
    >>> fates: list[Fate] = ["stood", "stood", "overturned", "stood"]
    >>> fates += ["overturned"] * 4
    >>> tests = [ShakingTest(lobe, lobe.name, fate)
    ...          for lobe, fate in zip(lobes, fates)]
    >>> found = compare_with_tests(
    ...     tests, Block(alpha=0.2, p=3.0), ims=["pgv"], n_resamples=20
    ... )
    >>> found.tests, found.overturned, found.motions
    (8, 5, 8)
    """
    options: _rocking.Comparing = {
        "block": None if block is None else pair_of(block),
        "p": None if p is None else number(p, "p"),
        "eta": physics(eta, model, "alpha")["eta"],
        "model": model,
        "ims": list(ims),
        "replicates": n_resamples,
        "seed": seed(rng),
        "gravity": number(gravity, "gravity"),
    }
    rows = [
        (given(t.record), t.motion, t.fate, dict(t.record.attributes))
        for t in tests
    ]
    return TestComparison._of(
        _rocking.compare_with_tests(rows, options, threads)
    )
