"""Intensity measures of records."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from . import _rocking
from ._inputs import (
    STANDARD_GRAVITY,
    Floats,
    Record,
    floats,
    given,
    number,
    numbers,
)
from ._results import Measures, VelocityPulse

PERIODS = (0.1, 0.2, 0.5, 1.0, 2.0, 3.0, 5.0)


def intensity_measures(
    record: Record,
    *,
    periods: ArrayLike = PERIODS,
    damping: float = 0.05,
    gravity: float = STANDARD_GRAVITY,
) -> Measures:
    """PGA, PGV, PGD, Arias intensity, CAV, durations, mean period, and the
    pseudo-spectral acceleration at `periods`.

    Parameters
    ----------
    record : Record
    periods : array_like
        Periods of the oscillators in s.
    damping : float
        Their damping ratio.
    gravity : float
        In m/s2.

    >>> step = Record([0.1] * 5, 0.5, units="g")
    >>> round(intensity_measures(step).significant_duration_5_75_s, 12)
    1.4
    """
    times = floats(periods, "periods").tolist()
    one = given(record)
    return Measures._of(
        _rocking.intensity_measures(one, None, times, damping, gravity)
    )


def response_spectrum(
    record: Record, periods: ArrayLike, damping: float = 0.05
) -> Floats:
    """Pseudo-spectral acceleration in g.

    It is (2 pi/T)^2 times the peak displacement of a linear oscillator.

    Parameters
    ----------
    record : Record
    periods : float or array_like
        Periods T of the oscillator in s.
    damping : float
        Damping ratio of the oscillator.

    Returns
    -------
    ndarray of the shape of `periods`

    >>> step = Record([0.1] * 9, 0.5, units="g")
    >>> response_spectrum(step, [0.5, 1.0], damping=0.0).round(12)
    array([0.2, 0.2])
    """
    times = numbers(periods, "periods")
    flat = np.ravel(times).tolist()
    found = intensity_measures(record, periods=flat, damping=damping)
    return np.reshape(found.spectral_acceleration_g, times.shape)


def average_sa(record: Record, p: float) -> float:
    """Average spectral acceleration over the periods of a block, in g.

    The geometric mean of SA(T, 5 %) over twelve periods T in equal ratios from
    0.15 to 1.0 times 2 pi/p: the measure "avgsa:rocking" of `Ida.against`.

    Parameters
    ----------
    record : Record
    p : float
        Frequency parameter of the block in rad/s.

    >>> step = Record([0.1] * 9, 0.5, units="g")
    >>> round(average_sa(step, 3.0), 3)
    0.185
    """
    return _rocking.average_sa(given(record), number(p, "p"))


def rotd(
    first: Record,
    second: Record,
    percentile: float = 50.0,
    *,
    periods: ArrayLike = PERIODS,
    damping: float = 0.05,
    gravity: float = STANDARD_GRAVITY,
) -> Measures:
    """The same measures of a pair: a percentile over all directions.

    Parameters
    ----------
    first, second : Record
        Horizontal components at right angles, of one sampling interval.
    percentile : float
        0 to 100: 50 is RotD50, the median; 100 is RotD100, the largest.
    periods, damping, gravity
        As in `intensity_measures`.

    >>> lobe = Record([0.0, 0.2, 0.0], 0.25, units="g")
    >>> round(rotd(lobe, lobe).pga_g, 3), round(rotd(lobe, lobe, 100).pga_g, 3)
    (0.2, 0.283)
    """
    times = floats(periods, "periods").tolist()
    other = given(second), number(percentile, "percentile")
    return Measures._of(
        _rocking.intensity_measures(
            given(first), other, times, damping, gravity
        )
    )


def velocity_pulse(
    first: Record, second: Record, *, gravity: float = STANDARD_GRAVITY
) -> VelocityPulse | None:
    """The velocity pulse of a pair of components, if it has one, by the
    algorithm of Shahi and Baker (BSSA 104, 2014).

    Parameters
    ----------
    first, second : Record
        As in `rotd`.
    gravity : float
        In m/s2.

    >>> from rocking import embedded_suite
    >>> suite = embedded_suite("pulse", component="both")
    >>> found = velocity_pulse(suite[0], suite[1])
    >>> found is not None and found.indicator > 0.0
    True
    """
    found = _rocking.velocity_pulse(given(first), given(second), gravity)
    return None if found == "null" else VelocityPulse._of(found)
