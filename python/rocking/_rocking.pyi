"""Native half of the package; its public names are in `rocking`."""

import os
from collections.abc import Callable, Sequence
from typing import Any, TypedDict

import numpy as np
from numpy.typing import NDArray

_Floats = NDArray[np.float64]
_Given = tuple[str, _Floats | None, float, dict[str, float]]
_Block = tuple[float, float]
_Law = tuple[float, float, float]
_Read = tuple[str, _Floats, float, dict[str, str]]
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

class Wanted(TypedDict):
    block: _Block
    im: str
    id: str | None
    limit_state: str
    model: str
    gravity: float
    origin: str | None

class Rows(TypedDict):
    sizes: NDArray[np.int64]
    im: _Floats
    edp: _Floats
    outcome: NDArray[np.uint8]
    factor: _Floats

__version__: str
STANDARD_GRAVITY: float

def block(alpha: float, p: float) -> None: ...
def block_of_size(
    width_m: float, height_m: float, gravity: float
) -> _Block: ...
def block_size(alpha: float, p: float, gravity: float) -> _Block: ...
def uplift_threshold(alpha: float, p: float, physics: Physics) -> float: ...
def samples(
    acc: _Floats, dt: float, units: str, gravity: float, name: str
) -> _Floats: ...
def pulse(
    kind: str, numbers: dict[str, float]
) -> tuple[float, float, float]: ...
def read_record(
    path: str | os.PathLike[str],
    dt: float | None,
    units: str | None,
    gravity: float,
) -> _Read: ...
def read_suite(
    path: str | os.PathLike[str],
    dt: float | None,
    units: str | None,
    gravity: float,
    both: bool,
) -> tuple[str, str, list[_Read]]: ...
def embedded_suite(name: str, both: bool) -> list[_Read]: ...
def respond(
    block: _Block,
    excitation: _Given,
    physics: Physics,
    by: str,
    level: float,
    history_dt: float | None,
    certified: bool,
) -> dict[str, Any]: ...
def peak(
    blocks: Sequence[_Block],
    excitations: Sequence[_Given],
    levels: Sequence[float],
    by: str,
    physics: Physics,
    threads: int | None,
    progress: _Progress,
) -> _Floats: ...
def ida(
    block: _Block,
    records: Sequence[_Given],
    physics: Physics,
    scan: Scan,
    threads: int | None,
    progress: _Progress,
) -> dict[str, Any]: ...
def capacities(rows: Rows, levels: Sequence[float], rule: str) -> _Floats: ...
def demands(rows: Rows, ims: Sequence[float]) -> _Floats: ...
def intensity_measures(
    record: _Given, periods: Sequence[float], damping: float, gravity: float
) -> dict[str, Any]: ...
def rotd50(
    first: _Given,
    second: _Given,
    periods: Sequence[float],
    damping: float,
    gravity: float,
) -> dict[str, Any]: ...
def fit_fragility(
    values: _Floats,
    shift: float | None,
    method: str,
    quantile_type: int,
    n_resamples: int,
    seed: int,
) -> dict[str, Any]: ...
def interval(
    point: float,
    replicates: Sequence[float],
    jackknife: Sequence[float] | None,
    level: float,
) -> tuple[float, float, float]: ...
def cdf(parameters: _Law, x: _Floats) -> _Floats: ...
def ppf(parameters: _Law, q: _Floats) -> _Floats: ...
def exchange(
    format: str, law: _Law, n: int, wanted: Wanted
) -> tuple[str, str | None]: ...
def lilliefors(
    values: _Floats,
    log: bool,
    shift: float | None,
    n_mc: int | None,
    seed: int,
    level: float,
) -> dict[str, Any]: ...
def quantile(values: _Floats, q: _Floats, quantile_type: int) -> _Floats: ...
def boxplot(values: _Floats, quantile_type: int) -> dict[str, Any]: ...
def paired(a: _Floats, b: _Floats, margin: float) -> dict[str, Any]: ...
def slope(x: Sequence[float], y: Sequence[float]) -> tuple[float, float]: ...
