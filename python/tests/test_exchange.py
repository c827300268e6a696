"""Files for OpenQuake and pelicun: the command line's bytes, and what their
own readers find in them."""

import re
import subprocess
from collections.abc import Sequence
from pathlib import Path
from typing import Any, get_args

import numpy as np
import pytest
import rocking as rk
from conftest import Command
from rocking._choices import ExchangeFormat

SAMPLE = [1.32, 1.41, 1.56, 1.77, 2.04, 2.31, 2.64, 3.1, 3.6, 4.2, 5.3, 7.2]
SHIFTS = {"pga": (0.0, 1.0), "pgv": (0.0, 0.4)}
BLOCK = rk.Block(alpha=0.2, p=3.0)


def nrml(
    fit: rk.FragilityFit | Sequence[rk.FragilityFit],
    path: Path | None = None,
    gravity: float = 9.80665,
    format: Any = "nrml",
    **about: Any,
) -> str:
    """The file of one block."""
    known: Any = {"block": BLOCK, "im": "pga", **about}
    one = rk.BlockFragility(fit=fit, **known)
    return rk.export([one], path, format=format, gravity=gravity)


CASES = [(im, shift) for im, both in SHIFTS.items() for shift in both]


@pytest.mark.parametrize(("im", "shift"), CASES)
def test_a_text_has_the_bytes_of_the_command_line(
    im: Any, shift: float, command: Command, tmp_path: Path
) -> None:
    block = rk.Block.from_dimensions(width_m=0.45, height_m=1.6)
    sample = tmp_path / "sample.txt"
    sample.write_text("\n".join(map(repr, SAMPLE)) + "\n")
    flags = ["--sample", sample, "--shift", shift, "--im", im]
    flags += ["--alpha", block.alpha, "--p", block.p, "--gravity", 9.81]
    said = {}
    for name in ("nrml", "pelicun"):
        out = tmp_path / f"{name}.csv"
        command("fragility", "export", *flags, "--format", name, "--out", out)
        said[name] = out.read_bytes()
    fit = rk.fit_fragility(SAMPLE, shift=shift)
    one = rk.BlockFragility(block=block, fit=fit, im=im)
    text = rk.export([one], tmp_path / "own.xml", format="nrml", gravity=9.81)
    assert text.encode() == said["nrml"]
    assert (tmp_path / "own.xml").read_bytes() == said["nrml"]
    own = tmp_path / "own.csv"
    table = rk.export([one], own, format="pelicun", gravity=9.81)
    assert table.encode() == said["pelicun"] == own.read_bytes()
    expected = (tmp_path / "pelicun.json").read_bytes()
    assert own.with_suffix(".json").read_bytes() == expected


def test_limit_states_of_one_dispersion_do_not_cross(
    suite: rk.Suite, command: Command, tmp_path: Path
) -> None:
    optimize: Any = pytest.importorskip("scipy.optimize")
    stats: Any = pytest.importorskip("scipy.stats")
    block, levels = rk.Block(alpha=0.35, p=5.0), [0.3, 0.6, np.inf]
    ida = rk.ida(block, suite)
    own = ida.fit(levels, shift=1.0)
    common = ida.fit(
        levels, shift=1.0, dispersion="common", n_resamples=30, rng=1
    )
    with pytest.raises(ValueError, match="do not cross"):
        crossing = rk.BlockFragility(block=block, fit=own, im="pga")
        rk.export([crossing], format="nrml", model_dispersion=0)
    ida.to_csv(tmp_path / "ida.csv")
    words = ["--ida", tmp_path / "ida.csv", "--at", "0.3,0.6,inf"]
    words += ["--shift", 1, "--dispersion", "common", "--format", "nrml"]
    words += ["--alpha", 0.35, "--p", 5, "--out", tmp_path / "own.xml"]
    command("fragility", "export", *words)
    points = [re.findall(r"<poes[^>]*>([^<]+)<", text) for text in (
        nrml(common, block=block), (tmp_path / "own.xml").read_text()
    )]
    assert points[0] == points[1] and len(points[0]) == 3

    samples = [ida.sample(level) for level in levels]

    def loss(x: Any) -> float:
        total = 0.0
        for sample, mu in zip(samples, x):
            law = stats.lognorm(np.exp(x[3]), loc=1.0, scale=np.exp(mu))
            known = np.isfinite(sample.values)
            total += law.logpdf(sample.values[known]).sum()
            total += law.logsf(sample.limits[~known]).sum()
        return -total

    found = optimize.minimize(loss, [0.0, 0.2, 0.5, -0.5], method="BFGS")
    for fit, mu in zip(common, found.x):
        assert fit.fitted.log_mean == pytest.approx(mu, abs=1e-4)
        assert fit.fitted.dispersion == pytest.approx(np.exp(found.x[3]), 1e-4)
    likelihoods = [fit.log_likelihood or np.nan for fit in (*own, *common)]
    assert sum(likelihoods[3:]) == pytest.approx(-found.fun, abs=1e-6)
    losses = [fit.dispersion_loss or np.nan for fit in common]
    apart = np.subtract(likelihoods[:3], likelihoods[3:])
    assert losses == pytest.approx(apart, abs=1e-9) and min(losses) >= 0.0
    assert own[0].dispersion_loss is None

    # A draw is of all states: each has the interval of the others, and alone
    # that which it has among them.
    ends = [fit.bootstrap.dispersion for fit in common if fit.bootstrap]
    assert len(ends) == 3 and ends[0] == ends[1] == ends[2]
    hazard = rk.Hazard("h", "pga_g,annual_frequency\n0.1,0.1\n2,1e-4\n")
    all_ = rk.BlockFragility(block=block, fit=common, im="pga")
    last = rk.BlockFragility(block=block, fit=common[2], im="pga")
    alone: Any = {"n_resamples": 20, "model_dispersion": 0, "model_bias": 1}
    rows = [
        rk.risk(hazard, {"a": one}, **alone).fragilities[-1].sampling
        for one in (all_, last)
    ]
    assert rows[0] == rows[1] and rows[0] is not None
    for wrong in ({"method": "moment"}, {"shift": "min"}):
        asked: Any = {"dispersion": "common", **wrong}
        with pytest.raises(ValueError, match="dispersion common with"):
            ida.fit(levels, **asked)


def test_names_and_origin_are_those_given() -> None:
    fit = rk.fit_fragility(SAMPLE)
    text = nrml(fit, limit_states=["fallen"], id="statue", origin="A & B")
    assert '<fragilityFunction id="statue" ' in text
    assert "<limitStates>fallen</limitStates>" in text
    assert "<description>A &amp; B; statue; parts: records, fallen: " in text
    assert "model bias 1 (0.77 to 1.3), model dispersion 0.2" in text
    own = nrml(fit)
    assert "12 capacities in PGA/(g tan alpha), response level" in own
    linearized = nrml(fit, model="linearized")
    mean = [
        float(re.findall(r' mean="([^"]+)"', one)[0])
        for one in (own, linearized)
    ]
    # Uplift at tan(0.2) g, and in the linearized equation at 0.2 g.
    assert mean[0] / mean[1] == pytest.approx(np.tan(0.2) / 0.2, rel=1e-8)


def test_what_no_reader_takes_is_refused_as_the_command_line_says(
    program: Path, tmp_path: Path
) -> None:
    sample = tmp_path / "sample.txt"
    sample.write_text("\n".join(map(repr, SAMPLE)) + "\n")
    fit = rk.fit_fragility(SAMPLE, shift=1.0)
    tiny = rk.fit_fragility([1e-9, 1.1e-9, 1.2e-9], shift=9e-10)
    small = tmp_path / "small.txt"
    small.write_text("1e-9\n1.1e-9\n1.2e-9\n")
    out = tmp_path / "out.csv"
    calls: list[tuple[Any, list[object]]] = [
        (
            lambda: nrml(fit, out, id="a.b"),
            ["--sample", sample, "--shift", 1, "--id", "a.b"],
        ),
        (
            lambda: nrml(fit, out, limit_states=["x" * 76]),
            ["--sample", sample, "--shift", 1, "--limit-state", "x" * 76],
        ),
        (
            lambda: nrml(tiny, out, format="pelicun"),
            ["--sample", small, "--shift", 9e-10, "--format", "pelicun"],
        ),
    ]
    for call, flags in calls:
        with pytest.raises(ValueError) as refused:
            call()
        flags += ["--im", "pga", "--alpha", 0.2, "--p", 3, "--out", out]
        if "--format" not in flags:
            flags += ["--format", "nrml"]
        words = [str(program), "fragility", "export", *map(str, flags)]
        done = subprocess.run(words, capture_output=True, text=True)
        assert done.returncode == 2, done.stdout
        assert str(refused.value) in done.stderr
    wrongs: list[tuple[dict[str, Any], str]] = [
        ({"im": "sa"}, 'intensity measure "sa": expected one of pga, pgv'),
        ({"limit_states": ["a", "b"]}, "each of 1 limit states"),
        ({"im": "pgv", "gravity": 0.0}, "gravity 0 m/s2: expected"),
        ({"im": "pga", "model": "both"}, "expected one of nonlinear"),
    ]
    for wrong, text in wrongs:
        with pytest.raises(ValueError, match=re.escape(text)):
            nrml(fit, out, **wrong)
    with pytest.raises(ValueError, match="beside which a file"):
        nrml(fit, tmp_path / "out.json", format="pelicun")
    with pytest.raises(FileNotFoundError, match="nowhere"):
        nrml(fit, tmp_path / "nowhere" / "out.xml")
    left = {path.name for path in tmp_path.iterdir()}
    assert left == {"sample.txt", "small.txt"}


def test_a_file_that_is_there_keeps_its_mode_and_its_link(
    tmp_path: Path,
) -> None:
    fit = rk.fit_fragility(SAMPLE)
    file, link = tmp_path / "file.xml", tmp_path / "link.xml"
    file.write_text("old")
    file.chmod(0o640)
    link.symlink_to("file.xml")
    text = nrml(fit, link)
    assert link.is_symlink() and file.read_text() == text
    assert file.stat().st_mode & 0o777 == 0o640


@pytest.mark.parametrize(("im", "shift"), CASES)
def test_openquake_reads_the_probabilities(
    im: Any, shift: float, tmp_path: Path
) -> None:
    reader: Any = pytest.importorskip("openquake.hazardlib.nrml")
    pytest.importorskip("openquake.risklib.read_nrml")
    fit = rk.fit_fragility(SAMPLE, shift=shift)
    block = rk.Block(alpha=0.15, p=3.0)
    path = tmp_path / "block.xml"
    nrml(fit, path, block=block, im=im)
    model = reader.to_python(str(path))
    [((measure, _), functions)] = model.items()
    [function] = functions.build(model.limitStates)
    assert measure == im.upper()
    x = np.linspace(0.05, 12.0, 40)
    # OpenQuake's PGV is in cm/s.
    unit = np.tan(0.15) * (1.0 if im == "pga" else 100 * 9.80665 / 3.0)
    assert abs(function(x * unit) - fit.fitted.cdf(x)).max() < 5e-4


@pytest.mark.parametrize(("im", "shift"), CASES)
def test_pelicun_reads_the_probabilities(
    im: Any, shift: float, tmp_path: Path
) -> None:
    uq: Any = pytest.importorskip("pelicun.uq")
    pandas: Any = pytest.importorskip("pandas")
    fit = rk.fit_fragility(SAMPLE, shift=shift)
    path = tmp_path / "block.csv"
    block = rk.Block(alpha=0.15, p=3.0)
    nrml(fit, path, format="pelicun", block=block, im=im)
    row = pandas.read_csv(path, index_col=0).iloc[0]
    theta = row["LS1-Theta_0"]
    if shift > 0.0:
        parts = theta.split("|")
        columns = [np.array(part.split(","), dtype=float) for part in parts]
        theta = np.column_stack(columns)
    else:
        theta = np.array([float(theta), float(row["LS1-Theta_1"])])
    law = uq.rv_class_map(row["LS1-Family"])(name="capacity", theta=theta)
    assert row["Demand-Unit"] == ("g" if im == "pga" else "mps")
    x = np.linspace(0.05, 12.0, 40)
    unit = np.tan(0.15) * (1.0 if im == "pga" else 9.80665 / 3.0)
    assert abs(law.cdf(x * unit) - fit.fitted.cdf(x)).max() < 5e-4


def test_fits_of_any_origin_have_the_bytes_of_the_command_line(
    command: Command, tmp_path: Path
) -> None:
    levels = [SAMPLE, [2.0 * x for x in SAMPLE]]
    flags: list[object] = ["--im", "pga"]
    for k, values in enumerate(levels):
        file = tmp_path / f"{k}.txt"
        file.write_text("\n".join(map(repr, values)) + "\n")
        flags += ["--sample", file]
    fits = [rk.fit_fragility(values) for values in levels]
    law = rk.law_fragility(BLOCK)
    counts = [(1.0, 1, 10), (2.0, 4, 10), (4.0, 9, 10)]
    table = tmp_path / "counts.csv"
    lines = ["intensity,exceeded,n", *(f"{x},{k},{n}" for x, k, n in counts)]
    table.write_text("\n".join(lines) + "\n")
    calls: list[tuple[Any, list[object]]] = [
        (fits, flags),
        (law, ["--law"]),
        (rk.fit_stripes(counts), ["--counts", table, "--im", "pga"]),
    ]
    for fit, words in calls:
        eta, im = (0.92, "avgsa:rocking") if fit is law else (None, "pga")
        one = rk.BlockFragility(block=BLOCK, fit=fit, im=im, eta=eta)
        out = tmp_path / "out.csv"
        words += ["--alpha", 0.2, "--p", 3, "--format", "csv", "--out", out]
        command("fragility", "export", *words)
        assert rk.export([one], format="csv").encode() == out.read_bytes()


def test_blocks_share_a_file(command: Command, tmp_path: Path) -> None:
    sample, table = tmp_path / "sample.txt", tmp_path / "blocks.csv"
    sample.write_text("\n".join(map(repr, SAMPLE)) + "\n")
    table.write_text("id,alpha,p\nfirst,0.2,3\nsecond,0.15,2.5\n")
    fit = rk.fit_fragility(SAMPLE)
    blocks = [
        rk.BlockFragility(block=block, fit=fit, im="pga", id=name)
        for name, block in (
            ("first", BLOCK),
            ("second", rk.Block(alpha=0.15, p=2.5)),
        )
    ]
    for format in get_args(ExchangeFormat):
        out = tmp_path / f"{format}.csv"
        words = ["--sample", sample, "--im", "pga", "--blocks", table]
        words += ["--format", format, "--out", out]
        command("fragility", "export", *words)
        assert rk.export(blocks, format=format).encode() == out.read_bytes()
