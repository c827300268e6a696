"""What Python gives has the bits of the command line."""

import csv
import json
from pathlib import Path
from typing import Any, Literal

import numpy as np
import pytest
import rocking as rk
from conftest import Command


def test_an_ida_has_the_bits_of_the_command_line(
    ida: rk.Ida, command: Command, suites: Path, tmp_path: Path
) -> None:
    table = tmp_path / "ida.csv"
    arguments = ["--alpha", 0.2, "--p", 3, "--suite", suites / "ordinary.csv"]
    command("ida", *arguments, "--out", table)
    with table.open() as lines:
        rows = list(csv.DictReader(lines))
    found = ida.to_pandas()
    assert len(found) == len(rows) > 2000
    for name in found.columns:
        column = [row[name] for row in rows]
        if name in ("record", "outcome"):
            assert found[name].tolist() == column, name
        else:
            assert found[name].tolist() == [float(x) for x in column], name


@pytest.mark.parametrize("name", ["ordinary", "pulse"])
@pytest.mark.parametrize("component", ["study", "both"])
def test_an_embedded_suite_is_what_the_command_line_exports(
    name: str, component: str, suites: Path
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


def test_capacities_and_a_fragility_have_the_bits_of_the_command_line(
    ida: rk.Ida, command: Command, suites: Path, tmp_path: Path
) -> None:
    table = tmp_path / "ida.csv"
    arguments = ["--alpha", 0.2, "--p", 3, "--suite", suites / "ordinary.csv"]
    command("ida", *arguments, "--out", table)
    for im in ("pga", "pgv"):
        out = tmp_path / f"{im}.txt"
        command(
            "capacities", "--ida", table, "--im", im, "--at", 0.5, "--out", out
        )
        lines = out.read_text().splitlines()
        expected = [float(x.split()[0]) for x in lines if x[0] != "#"]
        assert ida.capacities(0.5, im=im).tolist() == expected
    sample = ["--sample", tmp_path / "pga.txt", "--shift", 1]
    said = json.loads(
        command("fragility", "fit", *sample, "--bootstrap", 200, "--json")
    )
    fit = rk.fit_fragility(ida.capacities(0.5), shift=1.0, n_resamples=200)
    assert fit.median == said["fitted"]["median"]
    assert fit.beta == said["fitted"]["dispersion"]
    for key in ("log_likelihood", "ks_distance"):
        assert getattr(fit, key) == said[key], key
    kinds: list[tuple[Literal["BCa", "percentile"], str]]
    kinds = [("BCa", "bca"), ("percentile", "percentile")]
    for method, key in kinds:
        interval = said["bootstrap"]["median"][key]
        found = fit.confidence_interval(method=method)
        assert found == (interval["low"], interval["high"])
    said = json.loads(command("lilliefors", *sample, "--log", "--json"))
    test = rk.lilliefors(ida.capacities(0.5), shift=1.0)
    assert test.statistic == said["statistic"]["d"]
    assert test.pvalue == said["p_value"]["value"]
    assert test.critical_value == said["critical_value"]
    assert test.verdict == said["verdict"]


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
            1.5,
            "--json",
        )
    )
    found = rk.respond(rk.Block(alpha=0.2, p=3.0), record, im=1.5)
    # JSON has no infinity: null is that of a block that overturned.
    peak = float("inf") if said["peak_ratio"] is None else said["peak_ratio"]
    assert found.peak_ratio == peak
    assert found.uplift_time == said["uplift_time_s"]


@pytest.mark.parametrize("model", ["nonlinear", "linearized"])
@pytest.mark.parametrize("by", ["im", "pga_g"])
def test_peaks_in_lanes_are_those_of_single_responses(
    by: str, model: str, suite: rk.Suite, block: rk.Block
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


def test_a_spectrum_is_a_row_of_single_responses(packet: rk.Record) -> None:
    found = rk.spectrum(packet, alpha=0.15, p=[1.0, 3.0], level=1.1)
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


def test_a_measure_of_ones_own_is_that_of_the_curve(
    ida: rk.Ida, suite: rk.Suite
) -> None:
    # PGA of the records as recorded: capacities then are PGAs in g.
    pga = [record.pga_g for record in suite]
    found = ida.capacities(np.inf, im=pga)
    expected = ida.capacities(np.inf) * np.tan(0.2)
    np.testing.assert_allclose(found, expected, rtol=1e-14)
    best = rk.rank_ims(ida, suite, against={"order": np.arange(86.0)})
    assert [im.beta for im in best] == sorted(im.beta for im in best)
    by_pga = next(im for im in best if im.name == "pga_g")
    spread = np.log(ida.capacities(np.inf)).std(ddof=1)
    np.testing.assert_allclose(by_pga.beta, spread, rtol=1e-12)
    assert 0.0 <= by_pga.pvalues["order"] <= 1.0
