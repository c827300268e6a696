"""What Python gives has the bits of the command line."""

import json
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import rocking as rk
from conftest import Command


@pytest.mark.parametrize("name", ["ordinary", "pulse"])
@pytest.mark.parametrize("component", ["study", "both"])
def test_an_embedded_suite_is_what_the_command_line_exports(
    name: Any, component: Any, suites: Path
) -> None:
    read = rk.read_suite(suites / f"{name}.csv", component=component)
    own = rk.embedded_suite(name, component=component)
    assert own.name == name == read.name
    count = {"ordinary": 86, "pulse": 44}[name]
    assert len(own) == len(read) == count * (1 + (component == "both"))
    assert [r.name for r in own] == [r.name for r in read]
    for record, other in zip(own, read):
        assert record.dt == other.dt
        assert record.acc_g.tolist() == other.acc_g.tolist()
        assert set(record.attributes) > {"mw", "rrup_km", "pair"}
        for key, text in record.attributes.items():
            assert other.attributes[key] == text, key


def test_a_response_has_the_bits_of_the_command_line(
    command: Command, suite: rk.Suite, suites: Path
) -> None:
    record = suite[3]
    path = suites / record.attributes["file"]
    said = json.loads(
        command(
            "respond",
            "--alpha",
            0.2,
            "--p",
            3,
            "--record",
            path,
            "--im",
            40,
            "--json",
        )
    )
    found = rk.respond(rk.Block(alpha=0.2, p=3.0), record, im=40)
    # JSON has no infinity: null is that of a block that overturned.
    assert said["edp"] is None and found.peak_ratio == float("inf")
    assert found.peak_time == said["peak_time_s"]
    assert found.uplift_time == said["uplift_time_s"]


@pytest.mark.parametrize("model", ["nonlinear", "linearized"])
@pytest.mark.parametrize("by", ["im", "pga_g"])
def test_peaks_in_lanes_are_those_of_single_responses(
    by: Any, model: Any, suite: rk.Suite, block: rk.Block
) -> None:
    other = rk.Block(alpha=0.12, p=2.0)
    # At or hardly above the uplift threshold; by the last but one the grid
    # of an IDA would round.
    levels = [0.9, 1.0, 1.0 + 1e-9, 1.4, 3.0, 1.1 + 5e-14, 40.0]
    if by == "pga_g":
        levels = [0.01, 0.121, 0.25, 0.3, 1.0, 0.2 + 2e-14, 5.0]
    pulse = rk.Pulse("one-sine", amplitude_g=0.3, omega=6.0)
    motions = [suite[0], pulse, *suite[1:5]]
    table = rk.peak([block, other], motions, levels=levels, by=by, model=model)
    assert table.shape == (2, 6, 7)
    for i, one in enumerate([block, other]):
        for j, motion in enumerate(motions):
            for k, level in enumerate(levels):
                scaled: Any = {by: level}
                alone = rk.respond(one, motion, model=model, **scaled)
                assert table[i, j, k] == alone.peak_ratio
    # At or below the uplift threshold nothing moves.
    assert (table[:, :, 0] == 0.0).all() and np.isinf(table).any()
    stands = np.isfinite(table) & (table > 0.0)
    assert stands.sum() > 10


def test_a_rocking_spectrum_is_a_row_of_single_responses(
    packet: rk.Record,
) -> None:
    found = rk.rocking_spectrum(packet, alpha=0.15, p=[1.0, 3.0], level=1.1)
    alone = [
        rk.respond(rk.Block(alpha=0.15, p=p), packet, scale=1.1).peak_ratio
        for p in (1.0, 3.0)
    ]
    assert found.tolist() == alone


def test_a_stripe_has_the_peaks_of_its_level(
    block: rk.Block, suite: rk.Suite
) -> None:
    ida = rk.ida(block, suite[:20], step_im=0.25, refine=None)
    stripes = ida.demands([1.5, 2.25])
    assert stripes.shape == (2, 20)
    peaks = rk.peak(block, suite[:20], levels=[1.5, 2.25])
    stands = np.isfinite(stripes)
    assert stands.any() and not stands.all()
    assert stripes[stands].tolist() == peaks.T[stands].tolist()
    # Half a step above a standing level, before overturning, it is unknown.
    with pytest.raises(ValueError, match="says nothing at intensity"):
        ida.demands(np.arange(1.125, 6.0, 0.25))


def test_a_response_spectrum_has_the_shape_of_its_periods() -> None:
    step = rk.Record([0.1] * 81, 0.1, units="g")
    # The peak of a damped oscillator under a step lies half a period after it.
    for damping in (0.0, 0.05, 0.2):
        over = np.exp(-np.pi * damping / np.sqrt(1.0 - damping**2))
        found = rk.response_spectrum(step, [[0.5, 1.0], [2.0, 4.0]], damping)
        assert found == pytest.approx(np.full((2, 2), 0.1 * (1.0 + over)))
    assert rk.response_spectrum(step, 1.0).shape == ()
