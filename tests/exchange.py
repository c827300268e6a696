"""Files of `rocking fragility export`, read back by their readers.

    python3 tests/exchange.py target/release/rocking

writes the fragility of a block as NRML and as a pelicun library, shifted and
unshifted, in PGA and in PGV; runs the README's tour from records to
decisions; reads all these files with openquake.engine 3.26 and pelicun 3.10;
and compares their probabilities with the lognormal's own at forty
intensities. Both come from PyPI. openquake.engine has dependencies that need
GDAL, none of which is used here:

    pip install --no-deps openquake.engine==3.26.2
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

import numpy
import pandas
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


def rocking(folder, *words):
    done = subprocess.run(
        [BINARY, "fragility", *words], cwd=folder, check=True,
        capture_output=True, text=True)
    return done.stdout


def truth(fitted, factor, im):
    """The lognormal's probability by the parameters that were printed."""
    excess = im / factor - fitted["shift"]
    if excess <= 0:
        return 0.0
    score = (math.log(excess) - fitted["log_mean"]) / fitted["dispersion"]
    return 0.5 * math.erfc(-score / math.sqrt(2))


def openquake(path):
    """Measure and probability of each block by its name."""
    model = nrml.to_python(str(path))
    found = {}
    for (imt, name), functions in model.items():
        [function] = functions.build(model.limitStates)
        found[name] = imt, function
    return found


def pelicun(path, name, im):
    """Probabilities as the reader's own random variables give them."""
    row = pandas.read_csv(path, index_col=0).loc[name]
    theta = row["LS1-Theta_0"], row["LS1-Theta_1"]
    if row["LS1-Family"] == "multilinear_CDF":
        parts = [numpy.array(part.split(","), dtype=float)
                 for part in theta[0].split("|")]
        theta = numpy.column_stack(parts)
    else:
        theta = numpy.array([float(t) for t in theta])
    kind = uq.rv_class_map(row["LS1-Family"])
    variable = kind(name="capacity", theta=theta)
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
    imt, function = openquake(folder / nrml_file)[name]
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


def of_readme(mark):
    """The fenced block after a mark in the README."""
    after = (ROOT / "README.md").read_text().split(mark)[1]
    return after.split("```")[1].partition("\n")[2]


def tour(folder):
    """The README's tour, on the three recorded pairs that are shipped."""
    shutil.copy(ROOT / "fixtures/records/ridgecrest.zip",
                folder / "records.zip")
    for name in ["objects.csv", "hazard.csv"]:
        (folder / name).write_text(of_readme(f"<!-- tour: {name} -->"))
    path = os.pathsep.join([str(BINARY.parent), os.environ["PATH"]])
    subprocess.run(
        ["bash", "-e", "-c", of_readme("<!-- tour -->")], cwd=folder,
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


def main():
    for each in [single, tour]:
        with tempfile.TemporaryDirectory() as folder:
            worst = each(Path(folder))
        assert worst < TOLERANCE, worst


if __name__ == "__main__":
    main()
