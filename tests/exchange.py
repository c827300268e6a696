"""Files of `rocking fragility export`, read back by their readers.

    python3 tests/exchange.py target/release/rocking

writes the fragility of a block as NRML and as a pelicun library, shifted and
unshifted, in PGA and in PGV; the same of every origin (samples of two limit
states, an IDA, counts, the law of AvgSA, a table of blocks) and in SA; runs the
tour of docs/tour.md from records to decisions; reads all these files with
openquake.engine 3.26 and pelicun 3.10; and compares their probabilities with
those of lognormal and model at forty intensities. OpenQuake then calculates
scenario_damage and classical_damage with an exported model. Both programs
come from PyPI. openquake.engine has dependencies that need GDAL, none of
which is used here:

    pip install --no-deps openquake.engine==3.26.2 geopandas pyogrio
    pip install pelicun==3.10.0 toml psutil pyzmq h5py shapely pyproj numba \
        requests docutils "h3<4" fiona matplotlib decorator alpha_shapes
"""

import csv
import json
import math
import os
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

# No database server and no pool of workers.
os.environ.update(OQ_DATABASE="127.0.0.1", OQ_DISTRIBUTE="no")

import numpy
import pandas
from openquake.calculators import base
from openquake.commonlib import logs
from openquake.hazardlib import nrml
from openquake.risklib import read_nrml  # registers the reader
from pelicun import uq
from pelicun.assessment import Assessment

assert read_nrml
BINARY = Path(sys.argv[1]).resolve()
ROOT = Path(__file__).resolve().parents[1]
ALPHA, P, GRAVITY = 0.15, 3.0, 9.80665
SAMPLE = """1.32 1.41 1.56 1.63 1.77 1.9 2.04 2.1 2.31 2.5 2.64 2.77 2.92
3.1 3.3 3.43 3.6 3.88 4.2 4.5 4.9 5.3 6.1 7.2 9.4""".split()
# What the points hold, and what is cut off at the ends of a range.
TOLERANCE = 5e-4


def rocking(folder, *words, of=("fragility",)):
    done = subprocess.run(
        [BINARY, *of, *map(str, words)], cwd=folder, check=True,
        capture_output=True, text=True)
    return done.stdout


def truth(fitted, factor, im):
    """The probability by the lognormal's parameters that were printed, and the
    model's dispersion of 0.2: the mean over its standard normal variable."""
    z = numpy.linspace(-8, 8, 401)
    weight = numpy.exp(-z * z / 2)
    excess = im * numpy.exp(-0.2 * z) / factor - fitted["shift"]
    scores = [(math.log(x) - fitted["log_mean"]) / fitted["dispersion"]
              if x > 0 else -math.inf for x in excess]
    alone = [0.5 * math.erfc(-score / math.sqrt(2)) for score in scores]
    return float(weight @ numpy.array(alone) / weight.sum())


def openquake(path):
    """Measure and functions, one a limit state, of each block by its name."""
    model = nrml.to_python(str(path))
    return {name: (imt, functions.build(model.limitStates))
            for (imt, name), functions in model.items()}


def pelicun(path, name, im, state=1):
    """Probabilities as the reader's own random variables give them."""
    row = pandas.read_csv(path, index_col=0).loc[name]
    theta = row[f"LS{state}-Theta_0"], row[f"LS{state}-Theta_1"]
    family = row[f"LS{state}-Family"]
    if family == "multilinear_CDF":
        parts = [numpy.array(part.split(","), dtype=float)
                 for part in theta[0].split("|")]
        theta = numpy.column_stack(parts)
    else:
        theta = numpy.array([float(t) for t in theta])
    variable = uq.rv_class_map(family)(name="capacity", theta=theta)
    return row["Demand-Unit"], variable.cdf(numpy.array(im))


def damaged(path, block, demand, im, sample_size=20_000):
    """The share of damaged components in a whole assessment."""
    row = pandas.read_csv(path, index_col=0).loc[block]
    run = Assessment({"PrintLog": False, "Seed": 1, "Verbose": False})
    name = f"{demand}-0-1"
    unit = row["Demand-Unit"]
    run.demand.load_model({"marginals": pandas.DataFrame(
        {"Units": [unit], "Family": ["deterministic"], "Theta_0": [im]},
        index=pandas.MultiIndex.from_tuples(
            [tuple(name.split("-"))], names=["type", "loc", "dir"]))})
    run.demand.generate_sample({"SampleSize": sample_size})
    run.asset.load_cmp_model({"marginals": pandas.DataFrame(
        {"Units": ["ea"], "Location": ["0"], "Direction": ["1"],
         "Family": [numpy.nan], "Theta_0": [1.0], "Blocks": [1]},
        index=[row.name])})
    run.asset.generate_cmp_sample(sample_size)
    run.damage.load_model_parameters([str(path)], [row.name])
    run.damage.calculate()
    found = run.damage.save_sample()
    states = found.columns.get_level_values("ds")
    return float(found.loc[:, states == "1"].sum(axis=1).mean())


def compare(folder, name, nrml_file, library, fitted, metres, measure):
    """The largest error of both readers; `metres` is the number of g or m/s
    that makes a dimensionless intensity of 1."""
    pga = measure == "PGA"
    units = numpy.linspace(0.05, 12, 40)
    expected = numpy.array([
        truth(fitted, metres, x * metres) for x in units])
    imt, [function] = openquake(folder / nrml_file)[name]
    assert imt == measure, imt
    percent = 1 if pga else 100
    error = abs(function(units * metres * percent) - expected).max()
    unit, found = pelicun(folder / library, name, units * metres)
    assert unit == ("g" if pga else "mps"), unit
    other = abs(found - expected).max()
    print(f"{name}, {measure}: openquake {error:.1e}, pelicun {other:.1e}")
    # Four standard errors of 20,000 draws.
    x = 3.0 * metres
    share = damaged(folder / library, name, measure, x)
    p = truth(fitted, metres, x)
    bound = TOLERANCE + 4 * math.sqrt(p * (1 - p) / 20_000)
    print(f"{name}, {measure}: assessment {share:.5f}, expected {p:.5f}")
    assert abs(share - p) < bound, (share, p)
    return max(error, other)


def single(folder):
    """One block, each measure, with a shift and without."""
    (folder / "sample.txt").write_text("\n".join(SAMPLE) + "\n")
    threshold = math.tan(ALPHA)
    worst = 0.0
    for measure, shift in [
            ("pga", "0"), ("pga", "1"), ("pgv", "0"), ("pgv", "0.4")]:
        sample = ["--sample", "sample.txt", "--shift", shift]
        fitted = json.loads(rocking(folder, "fit", *sample, "--json"))
        fitted = fitted["fitted"]
        block = ["--im", measure, "--alpha", str(ALPHA), "--p", str(P)]
        files = "block.xml", "block.csv"
        for form, file in zip(["nrml", "pelicun"], files):
            rocking(folder, "export", *sample, *block, "--id", "block",
                    "--format", form, "--out", file)
        library = json.loads((folder / "block.json").read_text())
        assert list(library) == ["block"]
        pga = measure == "pga"
        metres = threshold if pga else threshold * GRAVITY / P
        worst = max(worst, compare(
            folder, "block", *files, fitted, metres, measure.upper()))
    return worst


def of_tour(mark):
    """The fenced block after a mark in the tour."""
    after = (ROOT / "docs/tour.md").read_text().split(mark)[1]
    return after.split("```")[1].partition("\n")[2]


def tour(folder):
    """The tour of the docs, on the three recorded pairs that are shipped."""
    shutil.copy(ROOT / "fixtures/records/ridgecrest.zip",
                folder / "records.zip")
    for name in ["objects.csv", "hazard.csv"]:
        (folder / name).write_text(of_tour(f"<!-- tour: {name} -->"))
    path = os.pathsep.join([str(BINARY.parent), os.environ["PATH"]])
    subprocess.run(
        ["bash", "-e", "-c", of_tour("<!-- tour -->")], cwd=folder,
        check=True, capture_output=True, env={**os.environ, "PATH": path})
    worst = 0.0
    with (folder / "objects.csv").open() as file:
        objects = list(csv.DictReader(file))
    assert len(objects) == len(openquake(folder / "objects.xml")) == 3
    for row in objects:
        fitted = json.loads(rocking(
            folder, "fit", "--sample", row["sample"], "--shift", "1",
            "--json"))["fitted"]
        # tan alpha is width over height.
        metres = float(row["width_m"]) / float(row["height_m"])
        worst = max(worst, compare(
            folder, row["id"], "objects.xml", "fragility.csv", fitted,
            metres, "PGA"))
    return worst


def states(folder, words, imt, unit="g", both=True):
    """The largest error of both readers over the limit states of a block."""
    run = [*words, "--out"]
    rocking(folder, *run, "out.xml", "--format", "nrml")
    rocking(folder, *run, "all.csv", "--format", "csv")
    if both:
        rocking(folder, *run, "out.csv", "--format", "pelicun")
    with (folder / "all.csv").open() as file:
        rows = list(csv.DictReader(file))
    model = openquake(folder / "out.xml")
    worst = 0.0
    for row in rows:
        assert row["unit"] == unit, row
        shift, median = float(row["shift"]), float(row["median"])
        law = {"shift": shift, "log_mean": math.log(median - shift),
               "dispersion": float(row["dispersion"])}
        ims = numpy.linspace(0.05, 5, 40) * median
        expected = numpy.array([truth(law, 1, im) for im in ims])
        found, functions = model[row["id"]]
        assert found == imt, found
        [function] = [one for one in functions
                      if one.limit_state == row["limit_state"]]
        worst = max(worst, abs(function(ims) - expected).max())
        if both:
            own = [one for one in rows if one["id"] == row["id"]]
            _, read = pelicun(folder / "out.csv", row["id"], ims,
                              own.index(row) + 1)
            worst = max(worst, abs(read - expected).max())
    print(f"{' '.join(map(str, words))}: {len(rows)} states, {worst:.1e}")
    return worst


def origins(folder):
    """Every origin, and spectral acceleration. What a fragility is, its own
    test knows; here, that both readers find the same in it."""
    head = "# Sample of {} at EDP 1, median crossing\n"
    numbers = [float(x) for x in SAMPLE]
    # A state has the dispersion of the next, above the shift or without it.
    for name, of, shift, factor in [
            ("leans.txt", "PGA/(g tan alpha)", 1, 0.9),
            ("leans-0.txt", "PGA/(g tan alpha)", 0, 0.9),
            ("falls.txt", "PGA/(g tan alpha)", 0, 1.0),
            ("sa.txt", "SA(0.5 s) (g)", 0, 0.2),
            ("avgsa.txt", "AvgSA(0.5, 1 s) (g)", 0, 0.2)]:
        text = [f"{shift + factor * (x - shift)}\n" for x in numbers]
        (folder / name).write_text(head.format(of) + "".join(text))
    # How many of 40 records overturn at each intensity.
    counts = ["0,40", "4,40", "6,40", "13,40", "20,40", "31,40"]
    lines = [f"{1.2 + 0.4 * k},{row}\n" for k, row in enumerate(counts)]
    (folder / "counts.csv").write_text("intensity,exceeded,n\n" + "".join(lines))
    shutil.copy(ROOT / "fixtures/records/ridgecrest.zip",
                folder / "records.zip")
    block = ["--alpha", ALPHA, "--p", P]
    rocking(folder, *block, "--suite", "records.zip", "--out", "ida.csv",
            of=["ida"])
    export = ["export", *block]
    two = ["--limit-state", "leans", "--limit-state", "falls"]
    worst = max(
        states(folder, [*export, "--sample", "leans.txt", "--sample",
                        "falls.txt", "--shift", 1, *two], "PGA"),
        states(folder, [*export, "--sample", "leans-0.txt", "--sample",
                        "falls.txt", *two], "PGA"),
        states(folder, [*export, "--sample", "sa.txt"], "SA(0.5)"),
        states(folder, [*export, "--sample", "avgsa.txt"], "AvgSA",
               both=False),
        states(folder, [*export, "--ida", "ida.csv", "--at", 1, "--shift", 1],
               "PGA"),
        states(folder, [*export, "--counts", "counts.csv", "--im", "pga"],
               "PGA"),
        states(folder, [*export, "--law"], "AvgSA", both=False))
    (folder / "blocks.csv").write_text(
        "id,alpha,p,sample\nshelf,0.15,3,leans.txt\nstatue,0.2,3,falls.txt\n")
    return max(worst, states(
        folder, ["export", "--blocks", "blocks.csv", "--shift", 1], "PGA"))


EXPOSURE = """<?xml version="1.0" encoding="UTF-8"?>
<nrml xmlns="http://openquake.org/xmlns/nrml/0.5">
<exposureModel id="e" category="contents" taxonomySource="none">
<description>one object</description>
<conversions><costTypes>
<costType name="contents" type="aggregated" unit="EUR"/>
</costTypes></conversions>
<assets>
<asset id="a1" number="100" taxonomy="object">
<location lon="0" lat="0"/>
<costs><cost type="contents" value="1"/></costs>
</asset>
</assets>
</exposureModel>
</nrml>
"""


def calculated(folder, **settings):
    """A real calculation of OpenQuake in a process of its own."""
    job = {"description": "test", "exposure_file": "exposure.xml",
           "contents_fragility_file": "object.xml", **settings}
    (folder / "job.ini").write_text("[general]\n" + "".join(
        f"{key} = {value}\n" for key, value in job.items()))
    return base.run_calc(str(folder / "job.ini")).datastore


def engine(folder):
    """scenario_damage and classical_damage with a shifted model."""
    os.environ["OQ_DATADIR"] = str(folder)
    logs.dbcmd("upgrade_db")
    (folder / "falls.txt").write_text("\n".join(SAMPLE) + "\n")
    words = ["--sample", "falls.txt", "--im", "pga", "--shift", 1]
    law = json.loads(rocking(folder, "fit", *words, "--json"))["fitted"]
    rocking(folder, "export", *words, "--alpha", ALPHA, "--p", P, "--id",
            "object", "--format", "nrml", "--out", "object.xml")
    (folder / "exposure.xml").write_text(EXPOSURE)
    unit = math.tan(ALPHA)
    pgas = numpy.linspace(0.05, 1.5, 30)
    rows = [f"0,{k},{pga:.17g}\n" for k, pga in enumerate(pgas)]
    (folder / "gmfs.csv").write_text("sid,eid,gmv_PGA\n" + "".join(rows))
    (folder / "sites.csv").write_text("0,0\n")
    store = calculated(
        folder, calculation_mode="scenario_damage", gmfs_file="gmfs.csv",
        sites_csv="sites.csv", number_of_ground_motion_fields=len(pgas),
        intensity_measure_types="PGA", discrete_damage_distribution="false")
    found = store.read_df("risk_by_event").query("agg_id == 0")
    found = found.sort_values("event_id")["dmg_1"].to_numpy() / 100
    expected = numpy.array([truth(law, unit, pga) for pga in pgas])
    worst = abs(found - expected).max()
    print(f"scenario_damage: {worst:.1e}")
    # Hazard of 400 points, H = 1e-4 x^-2.5 a year: OpenQuake interpolates
    # linearly, and leaves out what lies beyond the last point.
    ims = numpy.geomspace(0.02, 4, 400)
    rate = 1e-4 * ims ** -2.5
    names = ",".join(f"poe-{im:.9g}" for im in ims)
    poes = ",".join(f"{poe:.9g}" for poe in 1 - numpy.exp(-rate))
    (folder / "hazard.csv").write_text(
        "#,\"kind='mean', investigation_time=1.0, imt='PGA'\"\n"
        f"lon,lat,depth,{names}\n0,0,0,{poes}\n")
    store = calculated(
        folder, calculation_mode="classical_damage",
        hazard_curves_csv="hazard.csv", investigation_time=1,
        risk_investigation_time=1, maximum_distance=200,
        reference_vs30_value=760)
    found = float(store["damages-rlzs"][0, 0]["contents-exceeded"]) / 100
    fine = numpy.geomspace(ims[0], ims[-1], 200_001)
    law = numpy.array([truth(law, unit, im) for im in fine])
    frequency = -numpy.sum(
        0.5 * (law[1:] + law[:-1]) * numpy.diff(1e-4 * fine ** -2.5))
    expected = 1 - math.exp(-frequency)
    print(f"classical_damage: {found:.6f}, expected {expected:.6f}")
    assert abs(found / expected - 1) < 1e-3, (found, expected)
    return worst


def main():
    for each in [single, origins, tour, engine]:
        with tempfile.TemporaryDirectory() as folder:
            worst = each(Path(folder))
        assert worst < TOLERANCE, worst


if __name__ == "__main__":
    main()
