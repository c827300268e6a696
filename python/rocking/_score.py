"""Answers of any rocking code, scored against certified ones."""

from __future__ import annotations

import csv
import io
import json
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from os import PathLike, fspath
from pathlib import Path
from typing import Any, Literal

from . import _rocking
from ._results import Result

Value = float | str | None
Solve = Callable[[dict[str, Any]], Mapping[str, Value]]


@dataclass(frozen=True)
class Mistake(Result):
    """A mistake, and what to look at."""

    name: str
    what: str
    look_at: str


@dataclass(frozen=True)
class Explanation(Result):
    """One mistake, or two that are made together, and what they explain."""

    mistakes: tuple[Mistake, ...]
    factor: float | None
    """Factor on the input at fault, if it was found."""
    deviating: int
    """Answers that deviate, or should."""
    explained: int


@dataclass(frozen=True)
class Diagnosis(Result):
    """The fault of a code."""

    verdict: Literal["none", "known", "coarse", "unknown", "too-few"]
    explanations: tuple[Explanation, ...]
    """Several if the answers cannot distinguish them."""
    scatter: float | None
    remarks: tuple[str, ...]
    """What is coarse or deviates; empty for other verdicts."""


@dataclass(frozen=True)
class LevelScore(Result):
    """The score on a level of difficulty."""

    level: int
    kind: str
    asked: int
    answered: int
    median_digits: float | None
    worst_digits: float | None
    attained_share: float | None
    """Share of the numbers with all digits that doubles can get."""
    fates_right: int
    fates_wrong: int
    fates_missing: int
    counts_right: int
    counts_wrong: int


@dataclass(frozen=True)
class QuantityScore(Result):
    """The score of one answer."""

    scene: str
    quantity: str
    value: float | str
    certified: float | str
    digits: float | None
    attainable_digits: float | None
    attained: bool


@dataclass(frozen=True)
class Score(Result):
    """The score of a code's answers."""

    data_set: str
    asked: int
    answered: int
    levels: tuple[LevelScore, ...]
    diagnosis: Diagnosis
    quantities: tuple[QuantityScore, ...]


def score(answers: str | PathLike[str] | Solve) -> Score:
    """Scores a rocking code, and names its mistake.

    Parameters
    ----------
    answers : str, path-like or callable
        A CSV with the columns `scene,quantity,value`, or a function that gets
        a scene of the reference data set as a dictionary, whose fields
        `fixtures/benchmark/README.md` explains, and gives values by quantity.
        What is missing, or None, is no answer.

    >>> def solve(scene):
    ...     still = scene["excitation"]["kind"] != "free"
    ...     return {"fate": "no-uplift" if still else "rocked"}
    >>> found = score(solve)
    >>> found.answered, found.levels[0].fates_right
    (65, 10)
    >>> found.diagnosis.verdict
    'too-few'
    """
    if not callable(answers):
        place = fspath(answers)
        return Score._of(_rocking.score(Path(place).read_text(), place))
    text = io.StringIO()
    rows = csv.writer(text)
    rows.writerow(["scene", "quantity", "value"])
    for scene in json.loads(_rocking.score_scenes())["scenes"]:
        for quantity, value in answers(scene).items():
            shown = "" if value is None else value
            if isinstance(shown, (int, float)):
                shown = repr(float(shown))
            rows.writerow([scene["name"], quantity, shown])
    name = getattr(answers, "__name__", "answers")
    return Score._of(_rocking.score(text.getvalue(), name))
