"""Files of `rocking fragility --export`, read back by their readers.

    python3 tests/exchange.py target/release/rocking

writes the fragility of a block as NRML and as a pelicun library, shifted and
unshifted, in PGA and in PGV; reads them with openquake.engine 3.26 and
pelicun 3.10; and compares their probabilities with the lognormal's own at
forty intensities. Both come from PyPI. openquake.engine has dependencies that
need GDAL, none of which is used here:

    pip install --no-deps openquake.engine==3.26.2
    pip install pelicun==3.10.0 toml psutil pyzmq h5py shapely pyproj numba \
        requests docutils "h3<4" fiona matplotlib decorator alpha_shapes
"""

import json
import math
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
ALPHA, P, GRAVITY = 0.15, 3.0, 9.80665
SAMPLE = """1.32 1.41 1.56 1.63 1.77 1.9 2.04 2.1 2.31 2.5 2.64 2.77 2.92
3.1 3.3 3.43 3.6 3.88 4.2 4.5 4.9 5.3 6.1 7.2 9.4""".split()
# What the points hold, and what is cut off at the ends of a range.
TOLERANCE = 5e-4


def rocking(folder, *flags):
    done = subprocess.run(
        [BINARY, "fragility", "--sample", "sample.txt", *flags],
        cwd=folder, check=True, capture_output=True, text=True)
    return done.stdout


def truth(fitted, factor, im):
    """The lognormal's probability by the parameters that were printed."""
    excess = im / factor - fitted["shift"]
    if excess <= 0:
        return 0.0
    score = (math.log(excess) - fitted["mu"]) / fitted["beta"]
    return 0.5 * math.erfc(-score / math.sqrt(2))


def openquake(path, im):
    model = nrml.to_python(str(path))
    [((imt, _), functions)] = model.items()
    [function] = functions.build(model.limitStates)
    return imt, function(numpy.array(im))


def pelicun(path, im):
    """Probabilities as the reader's own random variables give them."""
    row = pandas.read_csv(path, index_col=0).iloc[0]
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


def damaged(path, demand, im, sample_size=20_000):
    """The share of damaged components in a whole assessment."""
    row = pandas.read_csv(path, index_col=0).iloc[0]
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


def main():
    worst = 0.0
    with tempfile.TemporaryDirectory() as folder:
        folder = Path(folder)
        (folder / "sample.txt").write_text("\n".join(SAMPLE) + "\n")
        threshold = math.tan(ALPHA)
        for measure, shift in [
                ("pga", "0"), ("pga", "1"), ("pgv", "0"), ("pgv", "0.4")]:
            fitted = json.loads(rocking(folder, "--shift", shift, "--json"))
            block = ["--shift", shift, "--im", measure, "--alpha", str(ALPHA),
                     "--p", str(P)]
            pga = measure == "pga"
            metres = threshold if pga else threshold * GRAVITY / P
            name = f"{measure}-{shift}"
            rocking(folder, *block, "--export", "nrml", "--out",
                    f"{name}.xml")
            rocking(folder, *block, "--export", "pelicun", "--out",
                    f"{name}.csv")
            library = json.loads((folder / f"{name}.json").read_text())
            assert len(library) == 1
            units = numpy.linspace(0.05, 12, 40)
            expected = numpy.array([
                truth(fitted, metres, x * metres) for x in units])
            percent = 1 if pga else 100
            imt, found = openquake(
                folder / f"{name}.xml", units * metres * percent)
            assert imt == measure.upper(), imt
            error = abs(found - expected).max()
            unit, found = pelicun(folder / f"{name}.csv", units * metres)
            assert unit == ("g" if pga else "mps"), unit
            other = abs(found - expected).max()
            print(f"{name}: openquake {error:.1e}, pelicun {other:.1e}")
            worst = max(worst, error, other)
            # Four standard errors of 20,000 draws.
            x = 3.0 * metres
            share = damaged(folder / f"{name}.csv", imt, x)
            p = truth(fitted, metres, x)
            bound = TOLERANCE + 4 * math.sqrt(p * (1 - p) / 20_000)
            print(f"{name}: assessment {share:.5f}, expected {p:.5f}")
            assert abs(share - p) < bound, (share, p)
    assert worst < TOLERANCE, worst


if __name__ == "__main__":
    main()
