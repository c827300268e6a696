"""As many curves as records, whatever the records are made of and called;
a warning says what is suspicious about them."""

import csv
import json
import pickle
import re
import subprocess
import warnings
from collections.abc import Callable, Sequence
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import numpy as np
import pandas as pd
import pytest
import rocking as rk
from conftest import Command
from rocking._inputs import Floats

N = 5
DT = 0.01
T = np.arange(1200) * DT
BLOCK = rk.Block(alpha=0.2, p=3.0)


def acc(k: int) -> Floats:
    """A packet in g, another one for each k."""
    packet: Floats = np.sin((4 + k) * T + k) * np.exp(-(((T - 3) / 1.5) ** 2))
    return 0.3 * packet


def trace(k: int, **stats: Any) -> SimpleNamespace:
    """An ObsPy trace that nobody named."""
    stats = {"delta": DT, "calib": 1.0, **stats}
    return SimpleNamespace(data=acc(k), stats=SimpleNamespace(**stats), id="...")


Make = Callable[[int], rk.Record]
MADE: dict[str, Make] = {
    "named": lambda k: rk.Record(acc(k), DT, units="g", name=f"r{k}"),
    "unnamed": lambda k: rk.Record(acc(k), DT, units="g"),
    "trace": lambda k: rk.Record.of(trace(k), units="g"),
    "signal": lambda k: rk.Record.of(
        SimpleNamespace(values=acc(k), dt=DT, label="m1"), units="g"
    ),
    "series": lambda k: rk.Record.of(pd.Series(acc(k), index=T), units="g"),
}

Way = Callable[[rk.Ida, Sequence[rk.Record]], int]
WAYS: dict[str, Way] = {
    "records": lambda ida, suite: len(set(ida.records)),
    "im": lambda ida, suite: len(ida.im),
    "edp": lambda ida, suite: len(ida.edp),
    "capacities": lambda ida, suite: len(set(ida.capacities(np.inf))),
    "levels of capacities": lambda ida, suite: ida.capacities([1.0]).shape[1],
    "demands": lambda ida, suite: len(ida.demands(1.0)),
    "sample": lambda ida, suite: len(ida.sample(np.inf).values),
    "names of a sample": lambda ida, suite: len(ida.sample(0.5).records),
    "stripes": lambda ida, suite: ida.stripes([1.0])[0].n,
    "fit": lambda ida, suite: ida.fit([np.inf], shift=1.0)[0].n,
    "fit_stripes": lambda ida, suite: ida.fit_stripes(
        [1.25, 1.75], edp=np.inf, n_resamples=9
    ).n // 2,
    "summarise": lambda ida, suite: ida.summarise().records,
    "against": lambda ida, suite: len(
        ida.against("sa:1", suite).capacities(np.inf)
    ),
    "rank_ims": lambda ida, suite: rk.rank_ims(
        ida, suite, ims=["pgv"], n_resamples=9
    ).n,
    "to_pandas": lambda ida, suite: ida.to_pandas().record.nunique(),
    "to_xarray": lambda ida, suite: ida.to_xarray().sizes["record"],
    "pickle": lambda ida, suite: len(
        pickle.loads(pickle.dumps(ida)).capacities(np.inf)
    ),
    "assess": lambda ida, suite: rk.assess(
        rk.Object("a", BLOCK), suite, n_resamples=9
    ).records,
}


@pytest.mark.parametrize("made", MADE)
def test_as_many_capacities_as_records_by_every_way(
    made: str, command: Command, tmp_path: Path
) -> None:
    suite = [MADE[made](k) for k in range(N)]
    ida = rk.ida(BLOCK, suite, step_im=0.25)
    assert {way: count(ida, suite) for way, count in WAYS.items()} == {
        way: N for way in WAYS
    }
    named = rk.ida(BLOCK, [MADE["named"](k) for k in range(N)], step_im=0.25)
    assert ida.capacities(np.inf).tolist() == named.capacities(np.inf).tolist()
    expected = [f"r{k}" if made == "named" else str(k + 1) for k in range(N)]
    assert list(ida.records) == expected
    # The command line reads as many.
    table = tmp_path / "ida.csv"
    ida.to_csv(table)
    assert rk.read_ida(table).records == ida.records
    words = ["--ida", table, "--levels", 0.5, "--json"]
    said = json.loads(command("capacities", *words))
    assert len(said["records"]) == N


@pytest.mark.parametrize("call", ["ida", "assess"])
def test_two_records_of_one_name_are_refused_at_both_doors(
    call: str, program: Path, tmp_path: Path
) -> None:
    components = [
        rk.Record(acc(k), DT, units="g", name=f"STA{k // 2}") for k in range(4)
    ]
    words = 'two records are named "STA0": expected different names'
    with pytest.raises(ValueError) as refused:
        if call == "ida":
            rk.ida(BLOCK, components)
        else:
            rk.assess(rk.Object("a", BLOCK), components)
    assert str(refused.value).startswith(words)
    assert "Record(..., name=...)" in str(refused.value)
    index = ["file,name,units,dt_s"]
    for k in range(4):
        np.savetxt(tmp_path / f"{k}.txt", acc(k))
        index.append(f"{k}.txt,STA{k // 2},g,{DT}")
    (tmp_path / "index.csv").write_text("\n".join(index) + "\n")
    with pytest.raises(ValueError, match="two records are named"):
        rk.read_suite(tmp_path / "index.csv")
    flags = ["ida", "--alpha", "0.2", "--p", "3", "--suite", "index.csv"]
    done = subprocess.run(
        [program, *flags, "--out", "-"], cwd=tmp_path, capture_output=True
    )
    assert done.returncode == 2 and words.encode() in done.stderr


def test_a_name_for_every_record_or_for_none() -> None:
    mixed = [MADE["named"](0), MADE["unnamed"](1)]
    with pytest.raises(ValueError, match="record 2 has no name: expected"):
        rk.ida(BLOCK, mixed)


def test_unnamed_suites_are_contrasted_and_not_paired() -> None:
    first, second = (
        rk.ida(BLOCK, [MADE["unnamed"](k) for k in some]).sample(np.inf)
        for some in (range(4), range(4, 8))
    )
    with pytest.raises(ValueError, match="numbered by their places"):
        rk.compare(first, second)
    assert rk.contrast(first, second, n_resamples=9).b.n == 4


def test_an_index_of_whole_numbers_is_no_times() -> None:
    series = pd.Series(acc(0))
    for whole in (series, series[100:], series.set_axis(range(1200))):
        with pytest.raises(ValueError, match="as pandas numbers rows"):
            rk.Record.of(whole, units="g")
    assert rk.Record(series, DT, units="g").dt == DT


@pytest.mark.parametrize("rate", [50, 60, 100, 128, 200, 256, 1000 / 3])
@pytest.mark.parametrize("count", [200, 40_000])
def test_single_precision_times_have_the_step_that_was_meant(
    rate: float, count: int
) -> None:
    values = np.sin(np.arange(count))
    times = np.arange(count) / rate
    single = np.arange(count, dtype=np.float32) * np.float32(1.0 / rate)
    for index in (times, times.astype(np.float32), single, times + 7.0):
        series = pd.Series(values, index=index)
        found = rk.Record.of(series, units="g").dt
        assert abs(found * rate - 1.0) < 1e-7
        if index is not single and rate != 1000 / 3:
            assert found == 1.0 / rate
    for unit in ("ms", "us", "ns"):
        if rate <= 300 and (count > 200 or unit != "ms"):
            steps = pd.to_timedelta(times, unit="s").round(unit).as_unit(unit)
            dated = rk.Record.of(pd.Series(values, index=steps), units="g")
            assert abs(dated.dt * rate - 1.0) < 1e-6, unit
    steps = pd.to_timedelta(times, unit="s")
    found = rk.Record.of(pd.Series(values, index=steps), units="g").dt
    assert abs(found * rate - 1.0) < 1e-7


def test_a_gap_in_single_precision_times_is_refused() -> None:
    times = (np.arange(20_000) * 0.005).astype(np.float32)
    times[15_000:] += np.float32(0.005)
    series = pd.Series(np.sin(times), index=times)
    with pytest.raises(ValueError, match=r"row 15000: time 75.00499\d* s"):
        rk.Record.of(series, units="g")


def test_a_calibration_that_may_be_applied_or_not_is_refused() -> None:
    with pytest.raises(ValueError, match="calib is 6.34e-06: expected 1"):
        rk.Record.of(trace(0, calib=6.34e-6), units="m/s2")


def test_masked_samples_are_refused() -> None:
    masked = np.ma.masked_greater(acc(0), 0.2)
    for call in (
        lambda: rk.Record(masked, DT, units="g"),
        lambda: rk.fit_fragility(masked),
        lambda: rk.summarise(masked),
    ):
        with pytest.raises(ValueError, match="masked values"):
            call()


def test_a_label_that_somebody_gave_is_a_name() -> None:
    zero = rk.Record.of(pd.Series(acc(0), index=T, name=0), units="g")
    signal = SimpleNamespace(values=acc(0), dt=DT, label="A1")
    assert zero.name == "0"
    assert rk.Record.of(signal, units="g").name == "A1"


def test_a_record_of_an_array_tells_what_is_suspicious() -> None:
    with pytest.warns(UserWarning, match="record 'x': units: PGA ") as told:
        record = rk.Record(acc(0) * 1e5, DT, units="g", name="x")
    assert told[0].filename == __file__
    assert [text.partition(":")[0] for text in record.remarks] == ["units"]
    assert pickle.loads(pickle.dumps(record)).remarks == record.remarks
    with pytest.warns(UserWarning, match="offset") as told:
        rk.Record.of(pd.Series(acc(0) + 0.01, index=T), units="g")
    assert told[0].filename == __file__
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        clean = rk.Record(acc(0), DT, units="g")
        pickle.loads(pickle.dumps(record))
    assert clean.remarks == ()


def test_remarks_reach_the_table_as_the_command_line_writes_them(
    command: Command, tmp_path: Path
) -> None:
    folder = tmp_path / "suite"
    folder.mkdir()
    motions = [acc(0), acc(1) + 0.02, acc(2), acc(2) * 2, 50 * acc(3)]
    for k, motion in enumerate(motions):
        rows = (f"{t:.2f},{a!r}" for t, a in zip(T, motion.tolist()))
        text = "\n".join(["t_s,a_g", *rows]) + "\n"
        (folder / f"{k}.csv").write_text(text if k else text.rstrip("\n"))
    with pytest.warns(UserWarning, match="remarks on 5 of 5 records; 0: last"):
        suite = rk.read_suite(folder)
    with pytest.warns(UserWarning, match="last-line"):
        rk.read_record(folder / "0.csv")
    assert suite.to_pandas().remarks[0].startswith("last-line: ")
    table, own = tmp_path / "said.csv", tmp_path / "own.csv"
    words = ["ida", "--alpha", 0.2, "--p", 3, "--suite", folder]
    command(*words, "--out", table)
    rk.ida(BLOCK, suite).to_csv(own)

    def without_build(file: Path) -> str:
        return re.sub(r",rocking [^,]*,1\n", "\n", file.read_text())

    assert without_build(own) == without_build(table)
    cells = [row["remarks"] for row in csv.DictReader(own.open())]
    codes = {code for cell in cells for code in cell.split()}
    assert codes >= {"last-line", "offset", "duplicate", "units"}
