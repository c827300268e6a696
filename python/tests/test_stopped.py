"""Every long call ends by Ctrl-C, within half a second."""

import os
import signal
import threading
import time
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

import numpy as np
import pytest
import rocking as rk

WITHIN_S = 0.5
SLACK_S = 0.5
"""For a machine that has other things to do."""

MANY = 20_000_000


@dataclass
class Given:
    block: rk.Block
    suite: rk.Suite
    ida: rk.Ida
    folder: Path


Call = Callable[[], object]
LONG: list[Callable[[Given], Call]] = []
"""What prepares a call that takes seconds, and gives the call. A native
function that may take long is to be among them."""


def long(prepare: Callable[[Given], Call]) -> Callable[[Given], Call]:
    LONG.append(prepare)
    return prepare


def noise(count: int) -> rk.Record:
    """Shaking under which a block rocks on and rounding errors grow."""
    acc = 0.12 * np.random.default_rng(0).standard_normal(count)
    return rk.Record(acc, 0.02, units="g", name="noise")


@long
def ida(given: Given) -> Call:
    unnamed = [rk.Record(one.acc_g, one.dt, units="g") for one in given.suite]
    return lambda: rk.ida(given.block, unnamed * 50)


@long
def ida_of_long_curves(given: Given) -> Call:
    return lambda: rk.ida(given.block, given.suite, step_g=1e-5)


@long
def ida_of_a_long_record(given: Given) -> Call:
    record = noise(10_000_000)
    return lambda: rk.ida(given.block, record)


@long
def ida_certified(given: Given) -> Call:
    record = noise(100_000)
    return lambda: rk.ida(given.block, record, certify=True)


@long
def peak(given: Given) -> Call:
    levels = np.linspace(1.1, 3.0, 2000)
    return lambda: rk.peak(given.block, given.suite, levels=levels)


@long
def respond_certified(given: Given) -> Call:
    record = noise(100_000)
    return lambda: rk.respond(given.block, record, certify=True)


@long
def capacities(given: Given) -> Call:
    levels = np.linspace(0.01, 0.99, 300_000)
    return lambda: given.ida.capacities(levels)


@long
def demands(given: Given) -> Call:
    ims = np.linspace(1.01, 1.1, 2_000_000)
    return lambda: given.ida.demands(ims)


@long
def intensity_measures(given: Given) -> Call:
    record, periods = noise(100_000), np.linspace(0.05, 10.0, 5000)
    return lambda: rk.intensity_measures(record, periods=periods)


@long
def rotd(given: Given) -> Call:
    record, periods = noise(20_000), np.linspace(0.05, 10.0, 500)
    return lambda: rk.rotd(record, record, periods=periods)


@long
def rank_ims(given: Given) -> Call:
    ims = [f"sa:{period}" for period in np.linspace(0.05, 10.0, 2000)]
    return lambda: rk.rank_ims(given.ida, given.suite, ims=ims)


@long
def fit_fragility(given: Given) -> Call:
    sample = given.ida.capacities(0.5)
    return lambda: rk.fit_fragility(sample, n_resamples=1_000_000)


@long
def jackknife(given: Given) -> Call:
    sample = np.exp(np.random.default_rng(0).standard_normal(30_000))
    return lambda: rk.fit_fragility(sample, n_resamples=2)


@long
def normality(given: Given) -> Call:
    sample = given.ida.capacities(0.5)
    return lambda: rk.test_normality(sample, shift=0.0, n_mc=50_000_000)


@long
def normality_above_the_smallest(given: Given) -> Call:
    sample = given.ida.capacities(0.5)
    return lambda: rk.test_normality(sample, shift="min", n_mc=50_000_000)


@long
def compare(given: Given) -> Call:
    a, b = np.exp(np.random.default_rng(0).standard_normal((2, 9000)))
    names = [f"r{k}" for k in range(9000)]
    both = [rk.Sample(values, records=names) for values in (a, b)]
    return lambda: rk.compare(*both)


@long
def contrast(given: Given) -> Call:
    a, b = given.ida.capacities([0.3, 0.5])
    return lambda: rk.contrast(a, b, n_resamples=1_000_000)


@long
def contrast_of_large_samples(given: Given) -> Call:
    a, b = np.exp(np.random.default_rng(0).standard_normal((2, 3000)))
    return lambda: rk.contrast(a, b, n_resamples=1_000_000)


@long
def summarise(given: Given) -> Call:
    sample = np.random.default_rng(0).random(2 * MANY)
    return lambda: rk.summarise(sample)


@long
def fit_stripes(given: Given) -> Call:
    ims = np.linspace(1.2, 4.0, 20)
    fit = given.ida.fit_stripes
    return lambda: fit(ims, edp=0.5, n_resamples=1_000_000)


@long
def risk(given: Given) -> Call:
    hazard = rk.Hazard("h.csv", "pga_g,annual_frequency\n0.1,0.01\n1,1e-5\n")
    fit = rk.fit_fragility(given.ida.capacities(0.5))
    return lambda: rk.risk(hazard, {"fit": fit}, n_resamples=1_000_000)


@long
def read_ida(given: Given) -> Call:
    path = given.folder / "ida.csv"
    given.ida.to_csv(path)
    head, *rows = path.read_text().splitlines()
    rows = [row.replace(",", f"-{k},", 1) for k in range(500) for row in rows]
    path.write_text("\n".join([head, *rows]) + "\n")
    return lambda: rk.read_ida(path)


@long
def pivot_forces(given: Given) -> Call:
    ida = rk.ida(given.block, given.suite, step_g=1e-3)
    return lambda: ida.pivot_forces(given.suite, [0.3])


@long
def cdf(given: Given) -> Call:
    law, x = (
        rk.fit_fragility([1.5, 2.0, 3.0]).fitted,
        np.linspace(0.1, 9.0, MANY),
    )
    return lambda: law.cdf(x)


@long
def ppf(given: Given) -> Call:
    law, q = (
        rk.fit_fragility([1.5, 2.0, 3.0]).fitted,
        np.linspace(0.1, 0.9, MANY),
    )
    return lambda: law.ppf(q)


@long
def read_record(given: Given) -> Call:
    path = given.folder / "long.txt"
    path.write_text("0.125\n-0.25\n" * MANY)
    return lambda: rk.read_record(path, dt=0.01, units="g")


@long
def read_suite(given: Given) -> Call:
    one = given.folder / "one.txt"
    one.write_text("0.125\n-0.25\n" * 10_000)
    for k in range(20_000):
        (given.folder / f"{k}.txt").symlink_to(one)
    return lambda: rk.read_suite(given.folder, dt=0.01, units="g")


@long
def embedded_suite(given: Given) -> Call:
    # One takes a second on two processors.
    return lambda: [rk.embedded_suite("ordinary") for _ in range(50)]


@pytest.mark.parametrize("prepare", LONG, ids=lambda call: call.__name__)
def test_ctrl_c_ends_every_long_call(
    prepare: Callable[[Given], Call],
    block: rk.Block,
    suite: rk.Suite,
    ida: rk.Ida,
    tmp_path: Path,
) -> None:
    call = prepare(Given(block, suite, ida, tmp_path))
    sent: list[float] = []

    def interrupt() -> None:
        sent.append(time.monotonic())
        os.kill(os.getpid(), signal.SIGINT)

    # A shell that runs this in the background ignores the signal.
    signal.signal(signal.SIGINT, signal.default_int_handler)
    timer = threading.Timer(0.3, interrupt)
    timer.start()
    with pytest.raises(KeyboardInterrupt):
        # On a fast machine one call may be over before the signal.
        for _ in range(50):
            call()
        # No signal may reach the next test.
        timer.cancel()
        pytest.fail("all calls were over before the signal")
    took = time.monotonic() - sent[0]
    assert took < WITHIN_S + SLACK_S, f"ended after {took:.2f} s"
