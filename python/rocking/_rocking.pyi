"""Native half of the package; its public names are in `rocking`."""

import os
from collections.abc import Callable, Sequence
from typing import Any, Literal, TypedDict

import numpy as np
from numpy.typing import NDArray

_Floats = NDArray[np.float64]
Given = tuple[str, _Floats | None, float, dict[str, float]]
_Block = tuple[float, float]
Law = tuple[float, float, float]
ModelError = tuple[str | None, str | None]
Sample = tuple[
    _Floats, Sequence[float | None], Sequence[str], Sequence[str]
]
Member = tuple[Given, dict[str, str]]
_Read = tuple[str, _Floats, float, dict[str, str], list[str]]
Written = tuple[
    str, str, float | None, tuple[float, float] | str | None
]
_Progress = Callable[[int, int], object] | None

class Physics(TypedDict):
    eta: float | None
    model: str
    overturn: str

class Scan(TypedDict):
    step_g: float | None
    step_im: float | None
    refine: float | None
    by: str
    certify: bool
    highest_im: float
    resurrections: tuple[bool, float] | None

Run = tuple[_Block, Physics, Scan]
WholeRun = tuple[_Block, Physics, Scan, str]

class Fit(TypedDict):
    shift: str
    method: str
    dispersion: str
    quantile_type: int
    c: float
    n_resamples: int
    seed: int
    band: Sequence[float]

Behind = tuple[Sequence[Sample], int, Fit] | None

class Wanted(TypedDict):
    block: _Block
    limit_states: Sequence[tuple[str, Law, str | int]]
    im: str
    id: str | None
    eta: float | None
    model: str
    origin: str | None

class GivenObject(TypedDict):
    id: str
    block: _Block
    eta: float
    friction: float | None
    limit_ratio: float | None
    notes: list[tuple[str, str]]
    position_m: tuple[float, float] | None
    floor: tuple[str, float, float, float] | None

class AssessOptions(TypedDict):
    years: float
    target: float | None
    sliding_share: float
    certify: bool
    replicates: int
    seed: int
    gravity: float
    model_error: ModelError

class Comparing(TypedDict):
    block: _Block | None
    p: float | None
    eta: float | None
    model: str
    ims: Sequence[str]
    replicates: int
    seed: int
    gravity: float

class IdaTable:
    def csv(self) -> str: ...
    def starts(self) -> list[int]: ...
    def columns(self) -> dict[str, Any]: ...
    def setting(self) -> dict[str, Any]: ...
    def against(
        self, im: str, suite: Sequence[Member] | None
    ) -> IdaCurves: ...
    def events(self) -> list[str]: ...
    def summary(self) -> str: ...
    def pivot_forces(
        self, suite: Sequence[Given], friction: Sequence[float]
    ) -> str: ...
    def rank(
        self,
        suite: Sequence[Member],
        ims: Sequence[str],
        edp: float,
        rule: str,
        magnitude: str | None,
        distance: str | None,
        replicates: int,
        seed: int,
    ) -> str: ...

class IdaCurves:
    def capacities(
        self, levels: Sequence[float], rule: str
    ) -> tuple[_Floats, _Floats]: ...
    def demands(self, ims: Sequence[float]) -> _Floats: ...
    def levels(self, levels: Sequence[float], rule: str) -> str: ...
    def crossings(self, record: str, levels: Sequence[float]) -> str: ...
    def fit(self, levels: Sequence[float], rule: str, options: Fit) -> str: ...
    def fit_stripes(
        self,
        ims: Sequence[float],
        edp: float,
        shift: float,
        replicates: int,
        seed: int,
    ) -> str: ...
    def stripes(self, ims: Sequence[float], edp: float | None) -> str: ...

__version__: str
STANDARD_GRAVITY: float
RECORD_FORMATS: list[str]
EXCHANGE_FORMATS: list[str]

def block(alpha: float, p: float) -> None: ...
def block_of_size(
    width_m: float, height_m: float, gravity: float
) -> _Block: ...
def block_size(alpha: float, p: float, gravity: float) -> _Block: ...
def uplift_threshold(alpha: float, p: float, physics: Physics) -> float: ...
def samples(
    acc: _Floats, dt: float, units: str, gravity: float, name: str
) -> tuple[_Floats, list[str]]: ...
def measure(name: str) -> str: ...
def pulse(
    kind: str, numbers: dict[str, float]
) -> tuple[float, float, float]: ...
def pulses() -> list[tuple[str, list[tuple[str, float | None]]]]: ...
def read_record(
    path: str | os.PathLike[str],
    dt: float | None,
    units: str | None,
    gravity: float,
) -> _Read: ...
def sampling_interval(times_s: _Floats) -> float: ...
def read_suite(
    path: str | os.PathLike[str],
    dt: float | None,
    units: str | None,
    gravity: float,
    both: bool,
    recursive: bool,
) -> tuple[str, str, tuple[int, int], list[_Read]]: ...
def embedded_suite(name: str, both: bool) -> list[_Read]: ...
def respond(
    block: _Block,
    excitation: Given,
    physics: Physics,
    by: str,
    level: float,
    history_dt: float | None,
    certified: bool,
) -> dict[str, Any]: ...
def peak(
    blocks: Sequence[_Block],
    excitations: Sequence[Given],
    levels: Sequence[float],
    by: str,
    physics: Physics,
    threads: int | None,
    progress: _Progress,
) -> _Floats: ...
def ida(
    block: _Block,
    records: Sequence[Given],
    known: Sequence[tuple[str, str]],
    physics: Physics,
    scan: Scan,
    gravity: float,
    threads: int | None,
    progress: _Progress,
) -> IdaTable: ...
def read_ida(path: str | os.PathLike[str]) -> IdaTable: ...
def ida_of_csv(text: str, run: WholeRun | None) -> IdaTable: ...
def cloud(
    block: _Block,
    suite: Sequence[Member],
    peaks: Sequence[float],
    events: Sequence[str],
    model: str,
    gravity: float,
    im: str,
    edp: Sequence[float],
    shift: float,
    replicates: int,
    seed: int,
) -> str: ...
def average_sa(record: Given, p: float) -> float: ...
def intensity_measures(
    record: Given,
    second: tuple[Given, float] | None,
    periods: Sequence[float],
    damping: float,
    gravity: float,
) -> str: ...
def velocity_pulse(first: Given, second: Given, gravity: float) -> str: ...
def fit(sample: Sample, options: Fit) -> str: ...
def fit_stripes(
    stripes: Sequence[tuple[float, int, int]], shift: float
) -> str: ...
def test_normality(
    sample: Sample,
    shift: str | None,
    level: float,
    replicates: int | None,
    seed: int,
) -> str: ...
def summarise(
    values: _Floats, probabilities: Sequence[float], quantile_type: int
) -> str: ...
def compare(a: Sample, b: Sample, margin: float) -> str: ...
def contrast(a: Sample, b: Sample, replicates: int, seed: int) -> str: ...
def lognormal(law: Law, function: str, numbers: _Floats) -> _Floats: ...
def exchange(
    format: str,
    blocks: Sequence[Wanted],
    gravity: float,
    error: ModelError,
) -> tuple[str, tuple[str, str] | None]: ...
def hazard(
    written: Written,
) -> tuple[list[tuple[float, float]], str | None, str, list[str]]: ...
def risk(
    written: Written,
    exposed: Sequence[tuple[str, Law | Wanted, Sequence[Behind]]],
    gravity: float,
    years: float,
    replicates: int,
    seed: int,
    error: ModelError,
) -> str: ...
def assess(
    objects: Sequence[GivenObject],
    records: Sequence[Given],
    events: Sequence[str],
    embedded: bool,
    hazard: Written | None,
    options: AssessOptions,
    threads: int | None,
) -> dict[str, str]: ...
def law(
    block: _Block, eta: float | None, edp: float, error: ModelError
) -> str: ...
def score(csv: str, place: str) -> str: ...
def score_scenes() -> str: ...
def read_tests(
    path: str | os.PathLike[str],
    fate: str,
    dt: float | None,
    units: str | None,
    gravity: float,
) -> list[tuple[_Read, str, Literal["overturned", "stood", "unknown"]]]: ...
def compare_with_tests(
    tests: Sequence[tuple[Given, str, str, dict[str, str]]],
    comparing: Comparing,
    threads: int | None,
) -> str: ...
