"""Two doors, one answer: each procedure of the core gives Python what the
command line prints, digit for digit."""

import json
import re
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import rocking as rk
from conftest import ROOT, Command

PROCEDURES = ROOT / "crates" / "procedures" / "src"


@dataclass
class House:
    """What both doors open on: an IDA, its suite, and their files."""

    ida: rk.Ida
    suite: rk.Suite
    index: Path
    table: Path
    sample: Path
    folder: Path
    command: Command

    def file(self, name: str, lines: Sequence[str]) -> Path:
        path = self.folder / name
        path.write_text("\n".join(lines) + "\n")
        return path


@dataclass
class Pair:
    """What Python found, and how the command line is asked."""

    found: Any
    words: list[object]
    place: tuple[str | int, ...] = ()
    """Where in the JSON it stands."""
    extra: tuple[str, ...] = ()
    """Keys of the command alone, which come of no procedure."""


Prepare = Callable[[House], Pair]
PAIRS: list[tuple[str, Prepare]] = []


def pair(procedure: str) -> Callable[[Prepare], Prepare]:
    def keep(prepare: Prepare) -> Prepare:
        PAIRS.append((procedure, prepare))
        return prepare

    return keep


@pair("assess")
def objects_on_ground_and_floor(house: House) -> Pair:
    lines = ["label,width_m,height_m,eta,friction,limit_ratio,floor,x_m,y_m,room"]
    lines += ["Stèle,0.5,2.0,,5,,,1,2,12", "vase,0.2,0.7,0.9,,0.4,roof,,,"]
    lines += ["crate,0.5,0.7,,0.2,,,,,"]
    objects = house.file("objects.csv", lines)
    lines = ["name,period_s,damping,height_ratio", "roof,0.5,0.05,1.3"]
    floors = house.file("floors.csv", lines)
    lines = ["pga_g,annual_frequency", "0.05,0.1", "0.3,0.01", "2,1e-5"]
    hazard = house.file("site.csv", lines)
    words: list[object] = ["assess", "--objects", objects, "--floors", floors]
    words += ["--suite", house.index, "--hazard", hazard, "--bootstrap", 20]
    words += ["--target", 0.5, "--out", house.folder / "page"]
    roof = rk.Floor("roof", 0.5, 0.05, 1.3)
    sizes = [rk.Block.from_dimensions(width_m=0.5, height_m=2.0)]
    sizes += [rk.Block.from_dimensions(width_m=0.2, height_m=0.7)]
    sizes += [rk.Block.from_dimensions(width_m=0.5, height_m=0.7)]
    stele = rk.Object(
        "Stèle", sizes[0], friction=5, notes={"room": "12"}, position_m=(1, 2)
    )
    crate = rk.Object("crate", sizes[2], friction=0.2)
    vase = rk.Object("vase", sizes[1], 0.9, limit_ratio=0.4, floor=roof)
    found = rk.assess(
        [stele, vase, crate],
        house.suite,
        hazard=rk.read_hazard(hazard),
        target=0.5,
        n_resamples=20,
    )
    assert "Rocking of 3 objects" in found.to_html()
    return Pair(found, words, extra=("provenance",))


@pair("fit_sample")
def fit_with_intervals(house: House) -> Pair:
    words = ["fragility", "fit", "--sample", house.sample, "--shift", 1]
    words += ["--bootstrap", 99, "--seed", 3, "--band", "1.5,2.5"]
    found = rk.fit_fragility(
        house.ida.sample(0.5),
        shift=1.0,
        n_resamples=99,
        rng=3,
        band=[1.5, 2.5],
    )
    return Pair(found, words, extra=("sample_of", "unit"))


@pair("fit_sample")
def fit_above_the_smallest(house: House) -> Pair:
    values = [1.32, 1.41, 1.56, 1.77, 2.04, 2.31, 2.64, 3.1, 3.6, 4.2]
    sample = house.file("plain.txt", [repr(x) for x in values])
    words = ["fragility", "fit", "--sample", sample, "--shift", "min"]
    words += ["--method", "trimmed", "--quantile-type", 7, "--c", 0.9]
    found = rk.fit_fragility(
        values, shift="min", method="trimmed", quantile_type=7, c=0.9
    )
    return Pair(found, words, extra=("sample_of", "unit"))


@pair("fit_sample")
def fit_of_a_free_shift(house: House) -> Pair:
    values = [2.0, 2.2, 2.3, 2.5, 2.6, 3.0, 3.3, 4.0, 5.0, 8.0]
    sample = house.file("free.txt", [repr(x) for x in values])
    words = ["fragility", "fit", "--sample", sample, "--shift", "free"]
    found = rk.fit_fragility(values, shift="free")
    assert found.shift_interval is not None
    return Pair(found, words, extra=("sample_of", "unit"))


@pair("fit_levels")
def fit_at_levels(house: House) -> Pair:
    words = ["fragility", "fit", "--ida", house.table, "--at", "0.3,0.5"]
    words += ["--im", "pgv", "--point", "first", "--bootstrap", 20]
    curves = house.ida.against("pgv")
    found = curves.fit([0.3, 0.5], rule="first", n_resamples=20)
    return Pair(found, words, ("levels",))


@pair("fit_levels")
def fit_of_one_dispersion(house: House) -> Pair:
    words = ["fragility", "fit", "--ida", house.table, "--at", "0.3,0.6,inf"]
    words += ["--shift", 1, "--dispersion", "common", "--bootstrap", 20]
    found = house.ida.fit(
        [0.3, 0.6, np.inf], shift=1.0, dispersion="common", n_resamples=20
    )
    assert len({fit.fitted.dispersion for fit in found}) == 1
    return Pair(found, words, ("levels",))


@pair("fit_stripes")
def fit_of_counts(house: House) -> Pair:
    counts = [(1.0, 1, 10), (2.0, 4, 10), (4.0, 9, 10)]
    lines = ["intensity,exceeded,n", *(f"{x},{k},{n}" for x, k, n in counts)]
    table = house.file("counts.csv", lines)
    words = ["fragility", "counts", "--counts", table, "--shift", 0.5]
    return Pair(rk.fit_stripes(counts, shift=0.5), words)


@pair("fit_outcomes")
def fit_of_stripes_of_the_same_records(house: House) -> Pair:
    table = house.folder / "outcomes.csv"
    words = ["stripes", "--ida", house.table, "--levels", "1.5,2,3,4"]
    words += ["--at", 0.5, "--counts", table]
    house.command(*words)
    words = ["fragility", "counts", "--counts", table]
    words += ["--bootstrap", 50, "--seed", 2]
    found = house.ida.fit_stripes(
        [1.5, 2.0, 3.0, 4.0], edp=0.5, n_resamples=50, rng=2
    )
    return Pair(found, words)


@pair("test_normality")
def normality_by_the_table(house: House) -> Pair:
    words = ["lilliefors", "--sample", house.sample, "--shift", 1]
    return Pair(rk.test_normality(house.ida.sample(0.5), shift=1.0), words)


@pair("test_normality")
def normality_by_simulation(house: House) -> Pair:
    values = [1.2, 1.5, 1.9, 2.4, 3.8, 5.0, 6.5, 9.0]
    sample = house.file("normal.txt", [repr(x) for x in values])
    words = ["lilliefors", "--sample", sample, "--shift", "min"]
    words += ["--replicates", 999, "--level", 0.1]
    found = rk.test_normality(values, shift="min", n_mc=999, level=0.1)
    return Pair(found, words)


@pair("compare")
def comparison(house: House) -> Pair:
    a, b = [1.0, 2.1, 3.0, np.inf, 0.0], [0.0, 1.0, 2.0, 3.1, 4.0]
    files = [
        house.file(file, [f"{x!r} # {name}" for x, name in zip(values, names)])
        for file, values, names in (("a.txt", a, "vwxyz"), ("b.txt", b, "zvwxy"))
    ]
    words = ["compare", "--a", files[0], "--b", files[1], "--margin", 0.1]
    of_a = rk.Sample(a, records=[*"vwxyz"])
    of_b = rk.Sample(b, records=[*"zvwxy"])
    return Pair(rk.compare(of_a, of_b, margin=0.1), words)


@pair("contrast")
def contrast_of_records(house: House) -> Pair:
    a, b = [1.1, 1.3, 1.4, 1.8], [2.2, 2.6, 2.8, 3.6, 9.0]
    files = [
        house.file(file, [repr(x) for x in values])
        for file, values in (("few.txt", a), ("others.txt", b))
    ]
    words = ["contrast", "--a", files[0], "--b", files[1]]
    words += ["--bootstrap", 50, "--seed", 4]
    return Pair(rk.contrast(a, b, n_resamples=50, rng=4), words)


@pair("contrast")
def contrast_of_earthquakes(house: House) -> Pair:
    names = ["aabbccddeeffgg", "ggghhhiiijjjkk"]
    samples, files = [], []
    for file, factor, events in zip(("near.txt", "far.txt"), (1.0, 2.0), names):
        values = [factor * (1.2 + 0.1 * i) for i in range(14)]
        limits = [np.nan] * 13 + [factor * 2.4]
        records = [f"{file} {i}" for i in range(14)]
        samples.append(
            rk.Sample([*values[:13], np.inf], limits, [*events], records)
        )
        texts = [*map(repr, values[:13]), f">{limits[13]!r}"]
        rows = zip(texts, records, events)
        files.append(house.file(file, [" # ".join(row) for row in rows]))
    words = ["contrast", "--a", files[0], "--b", files[1], "--bootstrap", 80]
    found = rk.contrast(*samples, n_resamples=80)
    assert found.a.drawn == "14 records of 7 earthquakes; unit: earthquake"
    assert isinstance(found.kolmogorov_smirnov.p_value, rk.Reason)
    return Pair(found, words)


@pair("rank")
def ranking(house: House) -> Pair:
    ims = ["pga", "pgv", "arias", "pgv-d575", "sa:1", "avgsa:0.5,1,2"]
    ims += ["column:mw"]
    words = ["rank", "--ida", house.table, "--suite", house.index]
    words += ["--at", 0.5, "--magnitude", "mw", "--distance", "rrup_km"]
    words += ["--bootstrap", 10, *(w for im in ims for w in ("--im", im))]
    found = rk.rank_ims(
        house.ida,
        house.suite,
        ims=ims,
        edp=0.5,
        magnitude="mw",
        distance="rrup_km",
        n_resamples=10,
    )
    return Pair(found, words, extra=("edp", "point", "set_aside"))


@pair("rank")
def ranking_of_survivors(house: House) -> Pair:
    # Survivors of the highest intensity enter by it.
    ida = rk.ida(rk.Block(alpha=0.2, p=3.0), house.suite, highest_im=5.0)
    table = house.folder / "low.csv"
    ida.to_csv(table)
    words = ["rank", "--ida", table, "--suite", house.index, "--at", "inf"]
    found = rk.rank_ims(ida, house.suite, n_resamples=10)
    assert found.censored > 0
    words += ["--bootstrap", 10]
    return Pair(found, words, extra=("edp", "point", "set_aside"))


@pair("stripes")
def responses_at_intensities(house: House) -> Pair:
    words = ["stripes", "--ida", house.table, "--levels", "1.5,2,40"]
    words += ["--at", 0.5, "--counts", house.folder / "stripes.csv"]
    found = house.ida.stripes([1.5, 2.0, 40.0], edp=0.5)
    return Pair(found, words, ("stripes",))


@pair("summarise")
def summary(house: House) -> Pair:
    words = ["sample", "--sample", house.sample, "--at", "0.1,0.5,0.99"]
    words += ["--quantile-type", 7]
    found = rk.summarise(
        house.ida.sample(0.5), [0.1, 0.5, 0.99], quantile_type=7
    )
    return Pair(found, words)


@pair("capacities::levels")
def capacities(house: House) -> Pair:
    words = ["capacities", "--ida", house.table, "--levels", "0.3,0.9"]
    words += ["--point", "last", "--im", "sa:1", "--suite", house.index]
    curves = house.ida.against("sa:1", house.suite)
    found = curves.levels([0.3, 0.9], rule="last")
    return Pair(found, words, ("levels",))


@pair("capacities::crossings")
def crossings(house: House) -> Pair:
    words = ["capacities", "--ida", house.table, "--levels", "0.3,0.9"]
    words += ["--im", "arias", "--suite", house.index]
    name = house.ida.records[2]
    curves = house.ida.against("arias", house.suite)
    found = curves.crossings(name, [0.3, 0.9])
    return Pair(found, words, ("records", 2, "levels"))


SUITE = ("suite", "study_components", "processing", "remarks", "set_aside")


def analysed(house: House) -> list[object]:
    words = ["ida", "--alpha", 0.2, "--p", 3, "--suite", house.index]
    return words + ["--out", house.folder / "again.csv"]


@pair("summarise_ida")
def curves_counted(house: House) -> Pair:
    extra = *SUITE, "earthquakes", "highest_im", "order", "pivot"
    return Pair(house.ida.summarise(), analysed(house), extra=extra)


@pair("pivot_forces")
def forces_at_the_pivot(house: House) -> Pair:
    found = house.ida.pivot_forces(house.suite, [0.25, 0.5])
    words = [*analysed(house), "--friction", "0.25,0.5"]
    return Pair(found, words, ("pivot",))


@pair("fit_sample")
def fit_by_earthquake(house: House) -> Pair:
    values = [1.3, 1.6, 1.7, 2.0, 2.1, 2.5, 2.6, 3.1, 3.4, 4.2]
    events = ["a", "a", "a", "b", "b", "c", "c", "d", "e", "f"]
    lines = [f"{x!r} # {i} # {e}" for i, (x, e) in enumerate(zip(values, events))]
    sample = house.file("events.txt", lines)
    words = ["fragility", "fit", "--sample", sample, "--bootstrap", 60]
    words += ["--band", 2]
    given = np.array(values)
    none = np.full(len(values), np.nan)
    found = rk.fit_fragility(
        rk.Sample(given, none, tuple(events)), n_resamples=60, band=[2.0]
    )
    assert found.bootstrap is not None
    drawn = "10 records of 6 earthquakes; unit: earthquake"
    assert found.bootstrap.drawn == drawn
    assert found.needed is not None and found.needed.design_effect > 1.0
    return Pair(found, words, extra=("sample_of", "unit"))


@pair("risk")
def risk_of_a_fragility(house: House) -> Pair:
    lines = ["pga_g,probability_of_exceedance"]
    lines += ["0.05,1", "0.1,0.6", "0.3,0.08", "1,0.002", "2,0"]
    file = house.file("hazard.csv", lines)
    words = ["risk", "--hazard", file, "--years", 30, "--shift", 0.15]
    words += ["--median", 0.43, "--dispersion", 0.71]
    law = rk.Fragility(
        shift=0.15, log_mean=np.log(0.28), dispersion=0.71, median=0.43
    )
    hazard = rk.read_hazard(file, years=30.0)
    assert hazard.im == "pga" and len(hazard.points) == 3
    return Pair(rk.risk(hazard, {"shifted": law}, years=30.0), words)


@pair("risk")
def risk_of_a_block(house: House) -> Pair:
    # OpenQuake's PGV is in cm/s.
    lines = ["#,,\"investigation_time=50.0, imt='PGV'\""]
    lines += ["lon,lat,depth,poe-10,poe-40,poe-160"]
    lines += ["9.1,45.4,0,0.5,0.07,0.001", "9.2,45.4,0,0.6,0.08,0.002"]
    file = house.file("openquake.csv", lines)
    values = [1.32, 1.41, 1.56, 1.77, 2.04, 2.31, 2.64, 3.1, 3.6, 4.2]
    sample = house.file("velocity.txt", [repr(x) for x in values])
    words = ["risk", "--hazard", file, "--site", "9.2,45.4"]
    words += ["--sample", sample, "--im", "pgv", "--alpha", 0.15, "--p", 3]
    one = rk.BlockFragility(
        block=rk.Block(alpha=0.15, p=3.0),
        fit=rk.fit_fragility(values),
        im="pgv",
    )
    hazard = rk.read_hazard(file, site=(9.2, 45.4))
    return Pair(rk.risk(hazard, {"not shifted": one}), words)


@pair("risk")
def risk_with_an_error_of_the_model(house: House) -> Pair:
    file = house.file("own.csv", ["pga_g,annual_frequency", "0.1,0.1", "1,1e-3"])
    words = ["risk", "--hazard", file, "--median", 0.43, "--dispersion", 0.71]
    words += ["--shift", 0.15, "--model-dispersion", "0.1,0.05,0.2"]
    words += ["--model-bias", "fitted"]
    law = rk.Fragility(
        shift=0.15, log_mean=np.log(0.28), dispersion=0.71, median=0.43
    )
    found = rk.risk(
        rk.read_hazard(file),
        {"shifted": law},
        model_dispersion=(0.1, 0.05, 0.2),
        model_bias="fitted",
    )
    assert found.fragilities[0].fitted.model_dispersion == 0.1
    with pytest.raises(ValueError, match="model_dispersion: found"):
        rk.risk(rk.read_hazard(file), {"law": law}, model_dispersion=0.001)
    return Pair(found, words)


@pair("law_fragility")
def law(house: House) -> Pair:
    words = ["fragility", "law", "--alpha", 0.15, "--p", 3, "--at", 0.5]
    found = rk.law_fragility(rk.Block(alpha=0.15, p=3.0), edp=0.5)
    return Pair(found, words)


@pair("compare_with_tests")
def specimen_on_a_table(house: House) -> Pair:
    rows = house.index.read_text().splitlines()
    columns = rows[0].split(",")
    lines = ["file,name,motion,scale,fate"]
    for k, row in enumerate(rows[1:13]):
        cells = dict(zip(columns, row.split(",")))
        fates = ("0", "stood", str(k % 2), "1", "overturned", "")
        for scale, fate in zip((0.2, 0.5, 1.0, 1.5, 3.0, 1.0), fates):
            name = f"{k}-{scale}-{fate}"
            lines.append(f"{cells['file']},{name},m{k},{scale},{fate}")
    table = house.index.parent / "tests.csv"
    table.write_text("\n".join(lines) + "\n")
    words: list[object] = ["validate", table, "--alpha", 0.15, "--p", 3]
    words += ["--bootstrap", 30, "--seed", 4, "--eta", "housner"]
    words += ["--im", "pgv", "--im", "sa:1"]
    found = rk.compare_with_tests(
        rk.read_tests(table),
        rk.Block(alpha=0.15, p=3.0),
        eta="housner",
        ims=["pgv", "sa:1"],
        n_resamples=30,
        rng=4,
    )
    assert found.unknown == 12 and found.tests == 60
    return Pair(found, words)


@pytest.fixture(scope="module")
def house(
    ida: rk.Ida,
    suite: rk.Suite,
    suites: Path,
    command: Command,
    tmp_path_factory: pytest.TempPathFactory,
) -> House:
    folder = tmp_path_factory.mktemp("doors")
    table, sample = folder / "ida.csv", folder / "sample.txt"
    ida.to_csv(table)
    command("capacities", "--ida", table, "--at", 0.5, "--out", sample)
    index = suites / "ordinary.csv"
    return House(ida, suite, index, table, sample, folder, command)


@pytest.mark.parametrize(
    ("procedure", "prepare"), PAIRS, ids=[p.__name__ for _, p in PAIRS]
)
def test_both_doors_give_the_same_digits(
    procedure: str, prepare: Prepare, house: House, command: Command
) -> None:
    asked = prepare(house)
    said = json.loads(command(*asked.words, "--json"))
    if isinstance(asked.found, tuple):
        own: Any = [json.loads(one.to_json()) for one in asked.found]
    else:
        own = json.loads(asked.found.to_json())
        for key in ("schema", "version", *asked.extra):
            del said[key]
        # A page's JSON has it among its provenance.
        said.pop("commit", None)
    for step in asked.place:
        said = said[step]
    # As text: a digit of difference is one.
    assert text(own) == text(said)
    assert len(own) > 0


def text(found: object) -> str:
    return json.dumps(found, indent=1, sort_keys=True)


def test_a_score_is_that_of_the_command_line(
    house: House, command: Command
) -> None:
    lines = ["scene,quantity,value", "free-half,fate,rocked"]
    lines += ["sine,uplift_time_s,0.12", "sine,impacts,3"]
    answers = house.file("answers.csv", lines)

    def solve(scene: dict[str, Any]) -> dict[str, Any]:
        if scene["name"] == "free-half":
            return {"fate": "rocked"}
        if scene["name"] == "sine":
            return {"uplift_time_s": 0.12, "impacts": 3}
        return {}

    said = json.loads(command("score", answers, "--json"))
    for key in ("schema", "version", "commit"):
        del said[key]
    for found in (rk.score(answers), rk.score(solve)):
        assert text(json.loads(found.to_json())) == text(said)


def test_every_procedure_of_the_core_has_a_pair() -> None:
    paired = {name.split("::")[-1] for name, _ in PAIRS}
    # The sample is the file that the command writes, the next test; draws of
    # outcomes enter `risk`.
    paired |= {"sample", "intervals", "sample_outcomes"}
    # Python only: the command line scales every record of a suite.
    paired |= {"fit_cloud"}
    known = set()
    # What the procedures stand on is no procedure itself.
    below = {"fragility", "fragility.rs", "inversion.rs", "tests.rs"}
    for source in PROCEDURES.rglob("*.rs"):
        if not below & set(source.parts):
            text = source.read_text()
            known |= set(re.findall(r"^pub fn (\w+)", text, re.MULTILINE))
    assert known == paired


@pytest.mark.parametrize("to", [True, 9])
def test_resurrections_have_the_bytes_of_the_command_line(
    to: Any, house: House, command: Command
) -> None:
    out = house.folder / "risen.csv"
    words = [*analysed(house)[:-1], out, "--resurrections-to"]
    command(*words, *([] if to is True else [to]))
    block = rk.Block(alpha=0.2, p=3.0)
    found = rk.ida(block, house.suite, resurrections_to=to)
    found.to_csv(house.folder / "own.csv")
    assert (house.folder / "own.csv").read_bytes() == out.read_bytes()
    assert (found.summarise().resurrections or 0) > 0
    capacities = found.capacities([0.5, np.inf]).tolist()
    assert capacities == house.ida.capacities([0.5, np.inf]).tolist()


def test_infinity_is_overturning_in_both_doors(
    house: House, command: Command
) -> None:
    words = ["--ida", house.table, "--json"]
    fit = json.loads(command("fragility", "fit", "--at", "inf", *words))
    [own] = house.ida.fit([np.inf])
    assert fit["levels"][0]["fitted"]["median"] == own.fitted.median
    said = json.loads(command("capacities", "--levels", "inf", *words))
    [level] = house.ida.levels([np.inf])
    assert said["levels"] == [level.to_dict()]


@pytest.mark.parametrize("im", ["pga", "pgv"])
def test_a_sample_is_the_file_of_the_command_line(
    im: str, house: House, command: Command
) -> None:
    out = house.folder / f"{im}.txt"
    words = ["--ida", house.table, "--im", im, "--at", "inf", "--out", out]
    command("capacities", *words)
    lines = [x for x in out.read_text().splitlines() if x[0] != "#"]
    curves = house.ida.against(im)
    found = curves.sample(np.inf)
    values = zip(found.values.tolist(), found.limits.tolist())
    own = [f">{b!r}" if a == np.inf else repr(a) for a, b in values]
    assert own == [line.split(" #")[0] for line in lines]
    assert found.values.tolist() == curves.capacities(np.inf).tolist()


def test_an_ida_has_the_bytes_of_the_command_line(
    house: House, command: Command
) -> None:
    table = house.folder / "said.csv"
    words = ["--alpha", 0.2, "--p", 3, "--suite", house.index]
    command("ida", *words, "--out", table)
    assert table.read_bytes() == house.table.read_bytes()
    read = rk.read_ida(table)
    assert read == house.ida and hash(read) == hash(house.ida)
    assert rk.ida(rk.Block(alpha=0.2, p=3.1), house.suite[:1]) != read
