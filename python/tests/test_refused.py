"""What is refused, by which exception, with the core's text."""

from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import rocking as rk

PULSE = rk.Pulse("one-sine", amplitude_g=0.3, omega=6.0)
BLOCK = rk.Block(alpha=0.2, p=3.0)
LOBE = rk.Record([0.0, 0.3, 0.0], 0.25, units="g", name="lobe")
PACKET = rk.Record([0.0, 0.3, 0.0], 0.25, units="g", name="packet")
# What a type checker refuses, too.
WRONG: Any = "neither"
TEXT: Any = "0.2"
NO_BLOCK: Any = (0.2, 3.0)
COMPLEX: Any = np.array([0.0, 1j, 0.0])
TIMES: Any = np.array(["2026-01-01", "2026-01-02"], dtype="datetime64[s]")
HAZARD = rk.Hazard("h.csv", "pga_g,annual_frequency\n0.1,0.01\n1,1e-5\n")
LAW = rk.Fragility(shift=0.0, log_mean=0.0, dispersion=0.5, median=1.0)
BY_VELOCITY = rk.BlockFragility(
    block=BLOCK, fit=rk.fit_fragility([1.5, 2.0, 3.0]), im="pgv"
)

REFUSED: list[tuple[Callable[[], object], str]] = [
    (lambda: rk.Block(alpha=0.0, p=1.0), "slenderness angle 0 rad: expected"),
    (lambda: rk.Block(alpha=0.1, p=float("nan")), "frequency parameter NaN"),
    (
        lambda: rk.Block.from_dimensions(width_m=-1.0, height_m=1.0),
        "expected positive lengths",
    ),
    (lambda: rk.Record([0.0], 0.1, units="g"), "at least"),
    (lambda: rk.Record([0.0, 1.0], 0.0, units="g"), "interval"),
    (lambda: rk.Record([0.0, np.inf], 0.1, units="g"), "finite"),
    (lambda: rk.Record([[0.0, 1.0]], 0.1, units="g"), "2 dimensions"),
    (
        lambda: rk.Record([0.0, 1.0], 0.1, units=WRONG),
        'units "neither": expected g, m/s2 or cm/s2',
    ),
    (
        lambda: rk.Record([0.0, 1.0], 0.1, units="g", name="=1+1"),
        'name "=1+1": expected no control character',
    ),
    (lambda: rk.Pulse("square", amplitude_g=1.0), "expected one of one-sine"),
    (lambda: rk.Pulse("one-sine", amplitude_g=1.0), "needs omega"),
    (
        lambda: rk.Pulse("one-sine", amplitude_g=1.0, omega=1.0, gamma=1.0),
        "has no use for gamma",
    ),
    (
        lambda: rk.embedded_suite(WRONG),
        'suite "neither": expected one of ordinary, pulse',
    ),
    (
        lambda: rk.embedded_suite("pulse", component=WRONG),
        "component 'neither': expected one of study, both",
    ),
    (lambda: rk.respond(BLOCK, PULSE, eta=1.1), "restitution 1.1"),
    (lambda: rk.respond(BLOCK, PULSE, im=1.0, scale=1.0), "at most one"),
    (lambda: rk.respond(BLOCK, PULSE, im=-1.0), "im -1: expected"),
    (lambda: rk.respond(BLOCK, PULSE, model=WRONG), "expected one of non"),
    (lambda: rk.peak(BLOCK, PULSE, levels=[np.nan]), "im NaN: expected"),
    (lambda: rk.ida(BLOCK, LOBE, step_g=0.0), "expected a positive number"),
    (lambda: rk.ida(BLOCK, LOBE, step_g=0.1, step_im=0.1), "at most one"),
    (lambda: rk.ida(BLOCK, LOBE, threads=0), "threads 0"),
    (lambda: rk.ida(BLOCK, []), "at least one"),
    (lambda: rk.ida(BLOCK, LOBE).capacities(-1.0), "EDP level -1"),
    (lambda: rk.ida(BLOCK, LOBE).against("sa:1"), "the suite"),
    (lambda: rk.ida(BLOCK, LOBE).against("sa"), "expected one of"),
    (
        lambda: rk.ida(BLOCK, LOBE).against("arias", [LOBE]).stripes([1.0]),
        "square of the acceleration",
    ),
    (
        lambda: rk.rank_ims(rk.ida(BLOCK, LOBE), [PACKET]),
        "record 1 of the suite is packet: expected lobe, as in the IDA",
    ),
    (
        lambda: rk.rank_ims(rk.ida(BLOCK, LOBE), [LOBE], ims=["column:mw"]),
        "record lobe, attribute mw: found none: expected a positive",
    ),
    (
        lambda: rk.ida(BLOCK, LOBE).pivot_forces([LOBE, PACKET], [0.3]),
        "2 records: expected the 1 of the IDA",
    ),
    (
        lambda: rk.ida(BLOCK, LOBE).pivot_forces([LOBE], [0.0]),
        "coefficient of friction 0: expected",
    ),
    (lambda: rk.law_fragility(rk.Block(alpha=0.2, p=9.0)), "p in rad/s 9"),
    (lambda: rk.Hazard("h.csv", "pga,rate\n"), "h.csv:1: found columns"),
    (lambda: rk.risk(HAZARD, {"a": LAW}, years=0.0), "0 years: expected"),
    (
        lambda: rk.risk(HAZARD, {"a": BY_VELOCITY}),
        "a: a fragility in pgv, a hazard curve in pga: expected the same",
    ),
    (lambda: rk.fit_fragility([0.5, 2.0], shift=1.0), "above the shift"),
    (lambda: rk.fit_fragility([2.0, np.inf]), "1 of 2 values are infinite"),
    (
        lambda: rk.fit_fragility([1.0, 2.0, 3.0], shift="min", n_resamples=9),
        "bootstrap of the smallest value",
    ),
    (lambda: rk.fit_fragility([1.0, 2.0], rng=-1), "rng -1"),
    (lambda: rk.test_normality([1.0, 2.0], level=2.0), "level 2: expected"),
    (lambda: rk.summarise([1.0], [1.5]), "probability 1.5"),
    (lambda: rk.summarise([]), "empty sample"),
    (
        lambda: rk.compare(rk.Sample([1.0]), rk.Sample([2.0])),
        "0 names of records for 1 values: expected a name for each value",
    ),
    (
        lambda: rk.compare(
            rk.Sample([1.0], records=["a"]), rk.Sample([2.0], records=["b"])
        ),
        "record a is not in the other sample",
    ),
    (
        lambda: rk.compare(
            # Of two suites without names.
            rk.Sample([1.0, 2.0], records=["1", "2"]),
            rk.Sample([2.0, 1.0], records=["1", "2"]),
        ),
        "records without names, numbered by their places",
    ),
    (
        lambda: rk.contrast(
            rk.Sample([1.0, 2.0], records=["a", "b"]),
            rk.Sample([1.0, 2.0], records=["b", "c"]),
        ),
        "record b is in both samples",
    ),
    (lambda: rk.contrast([1.0, 0.0], [1.0]), "value 2 is 0: expected a pos"),
    (lambda: rk.Sample([1.0], [1.0, 2.0]), "limits of 2 records for 1 values"),
    (
        lambda: rk.BlockFragility(block=BLOCK, fit=LAW, im="sa"),  # type: ignore[arg-type]
        'intensity measure "sa": expected one of pga, pgv',
    ),
    (
        lambda: rk.fit_fragility([1.0, 2.0], shift="0.2"),  # type: ignore[arg-type]
        "shift '0.2': expected a number, 'min' or 'free'",
    ),
    (
        lambda: rk.intensity_measures(LOBE, periods=[-1.0]),
        "period -1 s: expected at least 0.001 s",
    ),
]


@pytest.mark.parametrize(
    ("call", "text"), REFUSED, ids=[t for _, t in REFUSED]
)
def test_bad_input_is_a_value_error_with_a_text(
    call: Callable[[], object], text: str
) -> None:
    with pytest.raises(ValueError) as refused:
        call()
    assert text in str(refused.value)


def test_a_missing_file_is_a_file_not_found_error(tmp_path: Path) -> None:
    missing = tmp_path / "none.AT2"
    for read in (rk.read_record, rk.read_suite, rk.read_hazard):
        with pytest.raises(FileNotFoundError, match="none.AT2"):
            read(missing)


def test_a_file_without_a_unit_needs_one(tmp_path: Path) -> None:
    file = tmp_path / "column.txt"
    file.write_text("0.0\n9.80665\n-1.0\n")
    with pytest.raises(ValueError, match="column.txt"):
        rk.read_record(file)
    record = rk.read_record(file, dt=0.1, units="m/s2")
    assert record.pga_g == 1.0 and record.dt == 0.1


def test_a_cut_file_is_refused_with_its_line(tmp_path: Path) -> None:
    file = tmp_path / "column.txt"
    file.write_text("0.0\n1.0\nabc\n")
    with pytest.raises(ValueError, match="column.txt:3"):
        rk.read_record(file, dt=0.1, units="g")


KINDS: list[tuple[Callable[[], object], str]] = [
    (lambda: rk.Record(WRONG, 0.1, units="g"), "samples of <U7: expected real"),
    (lambda: rk.Record(COMPLEX, 0.1, units="g"), "samples of complex128"),
    (
        lambda: rk.Record(COMPLEX.real > 0.0, 0.1, units="g"),
        "samples of bool: expected real numbers",
    ),
    (
        lambda: rk.Record(TIMES, 0.1, units="g"),
        "samples of datetime64[s]: expected real numbers",
    ),
    (
        lambda: rk.Record([0.0, None], 0.1, units="g"),  # type: ignore[arg-type]
        "samples of object: expected real numbers",
    ),
    (lambda: rk.Block(alpha=TEXT, p=3.0), "alpha '0.2': expected a number"),
    (lambda: rk.Block(alpha=0.2, p=True), "p True: expected a number"),
    (
        lambda: rk.Pulse("one-sine", amplitude_g=TEXT, omega=1.0),
        "amplitude_g '0.2': expected a number",
    ),
    (lambda: rk.respond(BLOCK, PULSE, eta=1j), "eta 1j: expected a"),  # type: ignore[arg-type]
    (lambda: LAW.cdf(TEXT), "numbers of <U3: expected real numbers"),
    (lambda: rk.fit_fragility(["1", "2"]), "sample of <U1: expected"),
    (lambda: rk.ida(NO_BLOCK, LOBE), "tuple: expected a Block"),
    (lambda: rk.respond(NO_BLOCK, LOBE), "tuple: expected a Block"),
    (lambda: rk.peak([NO_BLOCK], LOBE, levels=2.0), "tuple: expected a Block"),
    (lambda: rk.law_fragility(NO_BLOCK), "tuple: expected a Block"),
    (
        lambda: rk.BlockFragility(block=NO_BLOCK, fit=BY_VELOCITY.fit, im="pga"),
        "tuple: expected a Block",
    ),
    (
        lambda: rk.assess(rk.Object("a", NO_BLOCK), [LOBE]),
        "tuple: expected a Block",
    ),
    (lambda: rk.compare([1.0], [1.0]), "list: expected a Sample with the"),  # type: ignore[arg-type]
]


@pytest.mark.parametrize(("call", "text"), KINDS, ids=[t for _, t in KINDS])
def test_what_is_of_another_kind_is_a_type_error_with_a_text(
    call: Callable[[], object], text: str
) -> None:
    with pytest.raises(TypeError) as refused:
        call()
    assert text in str(refused.value)


def test_capitals_name_a_measure() -> None:
    block = rk.BlockFragility(block=BLOCK, fit=BY_VELOCITY.fit, im="PGV")
    assert block == BY_VELOCITY
    analysed = rk.ida(BLOCK, LOBE)
    found = analysed.against("SA:1", [LOBE]).capacities(np.inf)
    assert found == analysed.against("sa:1", [LOBE]).capacities(np.inf)


def test_an_array_is_no_excitation() -> None:
    with pytest.raises(TypeError, match="expected a Record or a Pulse"):
        rk.respond(BLOCK, np.zeros(3))  # type: ignore[arg-type]


def test_what_is_given_serves_the_files_that_state_none(
    tmp_path: Path,
) -> None:
    inner = tmp_path / "event"
    inner.mkdir()
    (inner / "column.txt").write_text("0.0\n1.0\n-1.0\n")
    (tmp_path / "own.csv").write_text("t_s,a_g\n0,0\n0.1,1\n0.2,-1\n")
    words = "{}: taken for 1 of 2 records, whose files state no {}"
    with (
        pytest.warns(UserWarning, match=words.format("dt", "interval")),
        pytest.warns(UserWarning, match=words.format("units", "unit")),
    ):
        suite = rk.read_suite(tmp_path, dt=0.5, units="g", recursive=True)
    assert {r.name: r.dt for r in suite} == {"event/column": 0.5, "own": 0.1}
    with pytest.warns(UserWarning, match="set aside: 1 folder"):
        rk.read_suite(tmp_path)


def test_what_a_folder_sets_aside_is_warned_of(tmp_path: Path) -> None:
    (tmp_path / "a.csv").write_text("t_s,a_g\n0,0\n0.1,0.2\n0.2,0\n")
    (tmp_path / "notes.txt").write_text("About these records.\n")
    words = r"set aside: 1 in no known format \(first: notes.txt\)"
    with pytest.warns(UserWarning, match=words):
        suite = rk.read_suite(tmp_path)
    assert [record.name for record in suite] == ["a"]
