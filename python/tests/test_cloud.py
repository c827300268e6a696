"""Cloud analysis against SciPy, and what its fragilities serve for."""

from typing import Any

import numpy as np
import pytest
import rocking as rk

BLOCK = rk.Block(alpha=0.2, p=3.0)
SUITE = rk.embedded_suite("ordinary")


def own(im: str) -> tuple[np.ndarray, np.ndarray]:
    """Intensity and response of each record."""
    peaks = rk.peak(BLOCK, SUITE, levels=1.0, by="scale")
    measures = [rk.intensity_measures(one, periods=[1.0]) for one in SUITE]
    slope = np.tan(0.2)
    values = {
        "pga": [one.pga_g / slope for one in measures],
        "pgv": [
            3.0 * one.pgv_m_s / (rk.STANDARD_GRAVITY * slope)
            for one in measures
        ],
        "sa:1": [one.spectral_acceleration_g[0] for one in measures],
        "arias": [one.arias_intensity_m_s for one in measures],
    }
    return np.array(values[im]), peaks


@pytest.mark.parametrize(
    ("im", "shift"), [("pga", 1.0), ("pgv", 0.0), ("sa:1", 0.0), ("arias", 0.0)]
)
def test_the_line_is_the_one_of_scipy(im: str, shift: float) -> None:
    optimize: Any = pytest.importorskip("scipy.optimize")
    stats: Any = pytest.importorskip("scipy.stats")
    intensity, peaks = own(im)
    kept = (intensity > shift) & (peaks > 0.0)
    x = np.log(intensity[kept] - shift)
    out = peaks[kept] >= 1.0
    y = np.where(out, 0.0, np.log(peaks[kept]))

    def loss(p: Any) -> Any:
        z = (y - p[0] - p[1] * x) / np.exp(p[2])
        exact = stats.norm.logpdf(z) - p[2]
        return -np.where(out, stats.norm.logsf(z), exact).sum()

    best = optimize.minimize(loss, [-2.0, 2.0, 0.5], tol=1e-12)
    found = rk.cloud(BLOCK, SUITE, [0.3, np.inf], im=im, shift=shift)
    line = found.intercept.point, found.slope.point, found.deviation.point
    expected = best.x[0], best.x[1], np.exp(best.x[2])
    assert line == pytest.approx(expected, rel=2e-5)
    assert found.log_likelihood == pytest.approx(-best.fun, rel=1e-9)
    assert found.overturned == out.sum()
    assert found.not_rocking == (peaks == 0.0).sum() > 0
    assert found.n == len(SUITE) == kept.sum() + found.not_rocking
    assert [level.edp for level in found.levels] == [0.3, None]
    a, b, sigma = line
    median = shift + np.exp((np.log(0.3) - a) / b)
    assert found.levels[0].fitted.median == pytest.approx(median)
    assert found.levels[0].fitted.dispersion == pytest.approx(sigma / b)


def test_earthquakes_are_drawn() -> None:
    def of(record: rk.Record, event: int) -> rk.Record:
        known = record.acc_g, record.dt, {"event": str(event)}
        return rk.Record._read(record.name, *known, ())

    pairs = [of(record, k // 2) for k, record in enumerate(SUITE)]
    alone, drawn = (rk.cloud(BLOCK, one, [0.5]) for one in (SUITE, pairs))
    assert "earthquake" in drawn.drawn and drawn.drawn != alone.drawn
    assert drawn.slope.point == alone.slope.point
    assert drawn.slope.low != alone.slope.low


def test_fragilities_of_a_cloud_are_exported_and_integrated() -> None:
    found = rk.cloud(BLOCK, SUITE, [0.3, 1.0], shift=1.0, n_resamples=9)
    block = rk.BlockFragility(block=BLOCK, fit=found.levels, im="pga")
    assert "cloud of unscaled records" in rk.export([block], format="csv")
    hazard = rk.Hazard("h", "pga_g,annual_frequency\n0.1,0.01\n2,1e-5\n")
    low, high = rk.risk(hazard, {"block": block}, n_resamples=0).fragilities
    frequency = "annual_frequency_truncation_lower"
    assert getattr(low, frequency) > getattr(high, frequency) > 0.0


@pytest.mark.parametrize(
    ("given", "text"),
    [
        ({"suite": SUITE[:2]}, "pairs: expected at least 3"),
        ({"edp": [1.5]}, "EDP level 1.5: expected a positive number up to 1"),
        ({"shift": -1.0}, "shift -1: expected a finite, non-negative number"),
        ({"im": "column:none"}, "attribute none: found none"),
        ({"n_resamples": 0}, "a bootstrap of 0 samples"),
    ],
)
def test_what_makes_no_cloud_is_refused(
    given: dict[str, Any], text: str
) -> None:
    words = {"block": BLOCK, "suite": SUITE, "edp": [0.5], **given}
    with pytest.raises(ValueError, match=text):
        rk.cloud(**words)
