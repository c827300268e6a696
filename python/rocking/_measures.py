"""Intensity measures of records, and which of them predicts best."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from . import _rocking
from ._ida import Ida
from ._inputs import STANDARD_GRAVITY, Record, floats, given

PERIODS = (0.1, 0.2, 0.5, 1.0, 2.0, 3.0, 5.0)


def intensity_measures(
    record: Record,
    *,
    periods: ArrayLike = PERIODS,
    damping: float = 0.05,
    gravity: float = STANDARD_GRAVITY,
) -> dict[str, Any]:
    """PGA, PGV, PGD, Arias intensity, CAV, durations, mean period, and the
    pseudo-spectral acceleration at `periods` (s).

    >>> step = Record([0.1] * 5, 0.5, units="g")
    >>> round(intensity_measures(step)["significant_duration_5_75_s"], 12)
    1.4
    """
    times = floats(periods, "periods").tolist()
    return _rocking.intensity_measures(given(record), times, damping, gravity)


def rotd50(
    first: Record,
    second: Record,
    *,
    periods: ArrayLike = PERIODS,
    damping: float = 0.05,
    gravity: float = STANDARD_GRAVITY,
) -> dict[str, Any]:
    """The same measures of a pair: the median over all directions.

    >>> lobe = Record([0.0, 0.2, 0.0], 0.25, units="g")
    >>> round(rotd50(lobe, lobe, periods=[1.0])["pga_g"], 3)
    0.2
    """
    times = floats(periods, "periods").tolist()
    pair = given(first), given(second)
    return _rocking.rotd50(*pair, times, damping, gravity)


@dataclass(frozen=True)
class RankedIm:
    """How well an intensity measure predicts a capacity."""

    name: str
    median: float
    """Geometric mean of the capacities."""
    beta: float
    """Standard deviation of ln(capacity): the efficiency of Luco and
    Cornell, small is good."""
    n: int
    """Records that reached the response; the others do not enter."""
    pvalues: Mapping[str, float]
    """Of no slope of ln(capacity) on each quantity of `against`: the
    sufficiency, small is bad."""


def rank_ims(
    ida: Ida,
    suite: Sequence[Record],
    *,
    edp: float = math.inf,
    periods: ArrayLike = PERIODS,
    damping: float = 0.05,
    against: Mapping[str, ArrayLike] | None = None,
) -> list[RankedIm]:
    """Intensity measures by their efficiency, the best first.

    Parameters
    ----------
    ida : Ida
        Of the records of `suite`, in their order.
    edp : float
        Response whose capacities are compared; infinite for overturning.
    periods : array_like
        Periods in s of the spectral accelerations; `AvgSA_g` is their
        geometric mean. `pgv_d575` is PGV times the fourth root of D5-75.
    against : mapping of name to array_like
        Magnitudes, logarithms of distances, ..., one value a record.

    Returns
    -------
    list of RankedIm
        `pandas.DataFrame(rank_ims(...))` is a table.

    >>> from rocking import Block, ida
    >>> suite = [
    ...     Record([0.0, 0.2, 0.0], dt, units="g", name=f"{dt} s")
    ...     for dt in (0.2, 0.25, 0.3, 0.4)
    ... ]
    >>> best = rank_ims(ida(Block(alpha=0.1, p=3.0), suite), suite)[0]
    >>> best.name, round(best.beta, 2)
    ('SA(1 s)_g', 0.04)
    """
    names = tuple(record.name for record in suite)
    if names != ida.records:
        raise ValueError("records of another suite than those of the IDA")
    times = floats(periods, "periods").tolist()
    found = [
        intensity_measures(
            record, periods=times, damping=damping, gravity=ida.gravity
        )
        for record in suite
    ]
    own: dict[str, Any] = {
        key: np.array([measures[key] for measures in found])
        for key in ("pga_g", "pgv_m_s", "pgd_m", "cav_m_s")
    }
    for i, period in enumerate(times):
        key = f"SA({period:g} s)_g"
        own[key] = np.array(
            [measures["spectral_acceleration_g"][i] for measures in found]
        )
    if times:
        spectra = [list(m["spectral_acceleration_g"]) for m in found]
        own["AvgSA_g"] = np.exp(np.log(np.array(spectra)).mean(axis=1))
    duration = [m["significant_duration_5_75_s"] for m in found]
    own["pgv_d575"] = own["pgv_m_s"] * np.array(duration) ** 0.25
    quantities = {
        key: floats(values, key) for key, values in (against or {}).items()
    }
    for key, values in quantities.items():
        if len(values) != len(names):
            raise ValueError(
                f"{key}: {len(values)} values: expected {len(names)}, one a "
                "record"
            )
    ranked = []
    for key, intensities in own.items():
        capacities = ida.capacities(edp, im=intensities)
        reached = np.isfinite(capacities)
        if int(reached.sum()) < 3:
            raise ValueError(
                f"{int(reached.sum())} records reach {edp}: expected at "
                "least 3"
            )
        logs = np.log(capacities[reached])
        pvalues = {
            name: _rocking.slope(values[reached].tolist(), logs.tolist())[1]
            for name, values in quantities.items()
        }
        ranked.append(
            RankedIm(
                name=key,
                median=float(np.exp(logs.mean())),
                beta=float(logs.std(ddof=1)),
                n=int(reached.sum()),
                pvalues=pvalues,
            )
        )
    return sorted(ranked, key=lambda im: im.beta)
