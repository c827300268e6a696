"""Each keyword of each public function changes the result, or is refused."""

import inspect
from collections.abc import Callable, Iterator
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest
import rocking as rk
from test_certify import PGA_G, graze
from test_pickles import bits

BLOCK = rk.Block(alpha=0.2, p=3.0)
SUITE = rk.embedded_suite("ordinary")[:20]
FEW = SUITE[:4]
MOTION = SUITE[0]
PAIR = rk.embedded_suite("pulse", component="both")[:2]
IDA = rk.ida(BLOCK, SUITE)
VALUES = [1.32, 1.41, 1.56, 1.77, 2.04, 2.31, 2.64, 3.1, 3.6, 4.2]
CENSORED = [*VALUES, np.inf]
FIT = rk.fit_fragility(VALUES)
LAW = FIT.fitted
VELOCITY = rk.BlockFragility(block=BLOCK, fit=FIT, im="pgv")
HAZARD = rk.Hazard("h", "pgv_m_s,annual_frequency\n0.1,0.01\n1,1e-5\n")
POE = "pga_g,probability_of_exceedance\n0.1,0.1\n1,1e-5\n"
SITES = "#,,\"investigation_time=50.0, imt='PGA'\"\n" + "\n".join(
    ["lon,lat,depth,poe-0.1,poe-0.4", "9,45,0,0.5,0.07", "8,45,0,0.6,0.08"]
)
OBJECT = rk.Object("vase", BLOCK)
NAMED = rk.Sample(VALUES, records=[*"abcdefghij"])
NEAR = rk.Sample([1.02 * x for x in VALUES], records=[*"bacdefghij"])

BY_PGA = sorted(SUITE, key=lambda record: record.pga_g)
MOTIONS = [*"abcdefghijabcdefghij"]
FELL = {7, 9, *range(12, 20)}
FATES: list[Any] = ["overturned" if k in FELL else "stood" for k in range(20)]
TESTS = [rk.ShakingTest(*test) for test in zip(BY_PGA, MOTIONS, FATES)]

LEVEL = 1.3 * np.tan(0.2) / MOTION.pga_g
FORMATS: list[Any] = ["nrml", "csv"]

Base = dict[str, Any]
Try = tuple[Base, Any]
"""What else is given, and another value of the keyword than there."""

NO_RESULT = {
    # The same bits for any number: test_work.py.
    "threads",
    # Called back: test_work.py.
    "progress",
    # Where a result goes.
    "ax",
    "path",
}


def files(folder: Path) -> dict[str, Path]:
    """A file without interval and unit, folders of such, hazard curves."""
    one, pair = folder / "one.txt", folder / "pair"
    one.write_text("0.0\n1.0\n-1.0\n0.0\n")
    pair.mkdir()
    for name in ("a-000.txt", "a-090.txt"):
        (pair / name).write_text("0.0\n1.0\n-1.0\n0.0\n")
    nested = folder / "nested"
    (nested / "inner").mkdir(parents=True)
    for name in ("outer.txt", "inner/inner.txt"):
        (nested / name).write_text("0.0\n1.0\n-1.0\n0.0\n")
    tests = pair / "tests.csv"
    rows = ["a-000.txt,A,1,0", "a-090.txt,B,0,1"]
    tests.write_text("\n".join(["file,motion,fate,fell", *rows]))
    poe, sites = folder / "poe.csv", folder / "sites.csv"
    poe.write_text(POE)
    sites.write_text(SITES + "\n")
    return {
        "one": one,
        "pair": pair,
        "nested": nested,
        "tests": tests,
        "poe": poe,
        "sites": sites,
    }


def without_event(record: rk.Record) -> rk.Record:
    return rk.Record(record.acc_g, record.dt, units="g", name=record.name)


def trace(name: str = "given") -> SimpleNamespace:
    stats = SimpleNamespace(delta=0.01)
    return SimpleNamespace(data=MOTION.acc_g, stats=stats, id=name)


def tries(at: dict[str, Path]) -> dict[str, tuple[Callable[..., Any], Base, dict[str, Any]]]:
    """By function: the function, arguments, and for each keyword another
    value, or a `Try` with arguments of its own."""
    one: Base = {"path": at["one"], "dt": 0.01, "units": "m/s2"}
    all_: Base = {"path": at["pair"], "dt": 0.01, "units": "m/s2"}
    fit: dict[str, Any] = {
        "shift": 1.0,
        "method": "moment",
        "quantile_type": 7,
        "c": 0.5,
        "n_resamples": 20,
        "rng": ({"n_resamples": 20}, 1),
        "band": ({"n_resamples": 20}, [2.0]),
    }
    few: Base = {"n_resamples": 20}
    physics: dict[str, Any] = {
        "eta": 0.8,
        "model": "linearized",
        "overturn": ({"im": 40.0}, "half-pi"),
    }
    counts = [(1.0, 1, 10), (2.0, 4, 10), (4.0, 9, 10)]
    law = LAW
    return {
        "respond": (
            rk.respond,
            {"block": BLOCK, "excitation": MOTION},
            {
                **physics,
                "eta": ({"im": 1.5}, "housner"),
                "model": ({"im": 1.5}, "linearized"),
                "im": 1.5,
                "pga_g": 0.4,
                "scale": 3.0,
                "history_dt": 0.1,
                "certify": True,
            },
        ),
        "peak": (
            rk.peak,
            {"blocks": BLOCK, "excitations": MOTION, "levels": [1.5]},
            {
                "levels": [1.6],
                "by": "pga_g",
                "eta": 0.8,
                "model": "linearized",
                # A block that leans beyond alpha may come back.
                "overturn": (
                    {"excitations": SUITE, "levels": np.linspace(1.2, 9.0, 200)},
                    "half-pi",
                ),
            },
        ),
        "rocking_spectrum": (
            rk.rocking_spectrum,
            {"record": MOTION, "alpha": 0.2, "p": [3.0], "level": LEVEL},
            {"level": 0.99 * LEVEL, "eta": 0.8, "model": "linearized", "alpha": 0.19, "p": [2.9]},
        ),
        "ida": (
            rk.ida,
            {"block": BLOCK, "suite": FEW},
            {
                "step_g": 0.02,
                "step_im": 0.1,
                "refine": None,
                "by": "slenderness-adjustment",
                "eta": "housner",
                "model": "linearized",
                "overturn": "half-pi",
                "certify": (
                    {
                        "block": rk.Block(alpha=0.15, p=3.0),
                        "suite": graze(),
                        "step_g": PGA_G,
                        "highest_im": 2.0,
                    },
                    True,
                ),
                "highest_im": 1.5,
                "resurrections_to": True,
                "gravity": 9.81,
            },
        ),
        "cloud": (
            rk.cloud,
            {"block": BLOCK, "suite": SUITE, "edp": [0.5], "im": "pgv", **few},
            {
                "edp": [0.4],
                "im": "sa:1",
                "shift": 0.1,
                "eta": 0.8,
                "model": "linearized",
                "gravity": 9.81,
                "n_resamples": 21,
                "rng": 1,
            },
        ),
        "rank_ims": (
            rk.rank_ims,
            {"ida": IDA, "suite": SUITE, "ims": ["pga", "pgv"], "edp": 0.5, **few},
            {
                "ims": ["pga"],
                "edp": 0.4,
                "rule": "last",
                "magnitude": "mw",
                "distance": "rrup_km",
                "n_resamples": 21,
                "rng": 1,
            },
        ),
        "read_record": (
            rk.read_record,
            one,
            {"dt": 0.02, "units": "g", "gravity": 9.81},
        ),
        "read_suite": (
            rk.read_suite,
            all_,
            {
                "dt": 0.02,
                "units": "g",
                "gravity": 9.81,
                "component": "both",
                "recursive": ({"path": at["nested"]}, True),
            },
        ),
        "read_tests": (
            rk.read_tests,
            {**one, "path": at["tests"]},
            {"fate": "fell", "dt": 0.02, "units": "g", "gravity": 9.81},
        ),
        "compare_with_tests": (
            rk.compare_with_tests,
            {"tests": TESTS, "block": BLOCK, "ims": ["pgv"], **few},
            {
                "block": rk.Block(alpha=0.15, p=3.0),
                "p": ({"block": None, "p": 3.0}, 2.5),
                "eta": "housner",
                "model": "linearized",
                "ims": ["pga"],
                "n_resamples": 21,
                "rng": 1,
                "gravity": 9.81,
            },
        ),
        "embedded_suite": (
            rk.embedded_suite,
            {"name": "pulse"},
            {"component": "both"},
        ),
        "read_hazard": (
            rk.read_hazard,
            {"path": at["poe"], "years": 50.0},
            {
                "years": 30.0,
                "site": ({"path": at["sites"], "site": (9.0, 45.0)}, (8.0, 45.0)),
            },
        ),
        "risk": (
            rk.risk,
            {"hazard": HAZARD, "fragilities": {"a": VELOCITY}, **few},
            {
                "years": 30.0,
                "gravity": 9.81,
                "n_resamples": 21,
                "rng": 1,
                "model_dispersion": 0.1,
                "model_bias": "fitted",
            },
        ),
        "law_fragility": (
            rk.law_fragility,
            {"block": BLOCK},
            {
                "eta": "housner",
                "edp": 0.5,
                "model_dispersion": 0.1,
                "model_bias": "fitted",
            },
        ),
        "export": (
            rk.export,
            {"blocks": [VELOCITY], "format": "csv"},
            {
                "format": "nrml",
                "gravity": 9.81,
                "model_dispersion": (0.1, 0.0, 0.2),
                "model_bias": 1.1,
            },
        ),
        "assess": (
            rk.assess,
            {"objects": OBJECT, "suite": FEW, **few},
            {
                "suite": SUITE[4:8],
                "model_dispersion": 0.1,
                "model_bias": 1.1,
                "hazard": rk.Hazard("h", "pga_g,annual_frequency\n0.1,0.01\n1,1e-5\n"),
                "years": (
                    {"hazard": rk.Hazard("h", "pga_g,annual_frequency\n0.1,0.01\n1,1e-5\n")},
                    30.0,
                ),
                "target": (
                    {"hazard": rk.Hazard("h", "pga_g,annual_frequency\n0.1,0.01\n1,1e-5\n")},
                    300.0,
                ),
                "sliding_share": (
                    {"objects": rk.Object("vase", BLOCK, friction=0.1)},
                    0.999,
                ),
                "certify": (
                    {
                        "objects": rk.Object("a", rk.Block(alpha=0.15, p=3.0)),
                        "suite": [graze(), *map(without_event, FEW)],
                    },
                    True,
                ),
                "n_resamples": 21,
                "rng": 1,
                "gravity": 9.9,
            },
        ),
        "intensity_measures": (
            rk.intensity_measures,
            {"record": MOTION},
            {"periods": [0.3], "damping": 0.02, "gravity": 9.81},
        ),
        "response_spectrum": (
            rk.response_spectrum,
            {"record": MOTION, "periods": [0.3]},
            {"periods": [0.2], "damping": 0.02},
        ),
        "rotd": (
            rk.rotd,
            {"first": PAIR[0], "second": PAIR[1]},
            {
                "percentile": 100.0,
                "periods": [0.3],
                "damping": 0.02,
                "gravity": 9.81,
            },
        ),
        "velocity_pulse": (
            rk.velocity_pulse,
            {"first": PAIR[0], "second": PAIR[1]},
            {"gravity": 9.81},
        ),
        "fit_fragility": (
            rk.fit_fragility,
            {"sample": VALUES},
            fit,
        ),
        "test_normality": (
            rk.test_normality,
            {"sample": VALUES},
            {"shift": 1.0, "n_mc": 99, "rng": ({"n_mc": 999}, 1), "level": 0.1},
        ),
        "summarise": (
            rk.summarise,
            {"sample": VALUES},
            {"probabilities": [0.3], "quantile_type": 7},
        ),
        "compare": (rk.compare, {"a": NAMED, "b": NEAR}, {"margin": 0.1}),
        "contrast": (
            rk.contrast,
            {"a": VALUES, "b": VALUES[:6], **few},
            {"n_resamples": 21, "rng": 1},
        ),
        "fit_stripes": (rk.fit_stripes, {"stripes": counts}, {"shift": 0.5}),
        "Block.from_dimensions": (
            rk.Block.from_dimensions,
            {"width_m": 0.3, "height_m": 1.5},
            {"width_m": 0.4, "height_m": 1.6, "gravity": 9.81},
        ),
        "Block.dimensions": (BLOCK.dimensions, {}, {"gravity": 9.81}),
        "Block": (rk.Block, {"alpha": 0.2, "p": 3.0}, {"alpha": 0.3, "p": 2.0}),
        "Record": (
            rk.Record,
            {"acc": MOTION.acc_g, "dt": 0.01, "units": "m/s2"},
            {
                "units": "g",
                "name": "a",
                "gravity": 9.81,
                "attributes": {"mw": "7"},
            },
        ),
        "Record.of": (
            rk.Record.of,
            {"trace": trace(), "units": "m/s2"},
            {"units": "g", "name": "a", "gravity": 9.81},
        ),
        "Sample": (
            rk.Sample,
            {"values": CENSORED},
            {
                "limits": [np.nan] * 10 + [5.0],
                "events": [*"aabbccddeef"],
                "records": [*"abcdefghijk"],
            },
        ),
        "Object": (
            lambda **given: rk.assess(rk.Object(**given), FEW, n_resamples=9),
            {"id": "a", "block": BLOCK},
            {
                "eta": 0.8,
                "friction": 0.25,
                "limit_ratio": 0.4,
                "floor": rk.Floor("roof", 0.5, 0.05, 1.3),
                "notes": {"room": "12"},
                "position_m": (1.0, 2.0),
            },
        ),
        "Hazard": (
            lambda **given: rk.Hazard(**given).points,
            {"place": "h", "text": POE, "years": 50.0},
            {
                "years": 30.0,
                "site": ({"text": SITES, "site": (9.0, 45.0)}, (8.0, 45.0)),
            },
        ),
        "BlockFragility": (
            lambda **given: [
                rk.export([rk.BlockFragility(**given)], format=form)
                for form in FORMATS
            ],
            {"block": BLOCK, "fit": FIT, "im": "pga"},
            {
                "block": rk.Block(alpha=0.3, p=3.0),
                "fit": rk.fit_fragility(VALUES[:5]),
                "im": "pgv",
                "id": "vase",
                "limit_states": ["fallen"],
                "eta": 0.92,
                "model": "linearized",
                "origin": "here",
            },
        ),
        "Fragility.rvs": (law.rvs, {"rng": 1}, {"size": 3, "rng": 2}),
        "Ida.sample": (IDA.sample, {"edp": 0.5}, {"rule": "last"}),
        "Ida.capacities": (IDA.capacities, {"edp": 0.5}, {"rule": "last"}),
        "Ida.levels": (IDA.levels, {"edp": [0.5]}, {"rule": "last"}),
        "Ida.stripes": (IDA.stripes, {"ims": [1.1]}, {"edp": 0.1}),
        "Ida.fit": (
            IDA.fit,
            {"edp": [0.5, 0.3]},
            {**fit, "rule": "last", "dispersion": "common"},
        ),
        "Ida.fit_stripes": (
            IDA.fit_stripes,
            {"ims": [1.5, 2.0, 3.0], "edp": 0.5, **few},
            {"edp": 0.4, "shift": 1.0, "n_resamples": 21, "rng": 1},
        ),
        "Ida.against": (
            lambda **given: IDA.against(**given).capacities(0.5),
            {"im": "sa:1", "suite": SUITE},
            {"suite": SUITE[:3]},
        ),
    }


def options(call: Callable[..., Any]) -> Iterator[str]:
    """Parameters that may be left out, or are given by their names alone."""
    for name, one in inspect.signature(call).parameters.items():
        is_option = one.default is not one.empty or one.kind is one.KEYWORD_ONLY
        if is_option and one.kind is not one.VAR_KEYWORD:
            yield name


def public() -> dict[str, set[str]]:
    """The keywords of functions, methods and constructors; the fields of a
    result are its content."""
    found = {}
    for name in rk.__all__:
        kind = getattr(rk, name)
        if not callable(kind):
            continue
        if not inspect.isclass(kind):
            found[name] = set(options(kind))
            continue
        is_given = not issubclass(kind, rk.Reason.__mro__[1])
        if is_given and name not in ("Ida", "ImCurves", "Response", "Suite"):
            found[name] = set(options(kind))
        for key, method in inspect.getmembers(kind):
            if key[0] != "_" and callable(method):
                owner = "Ida" if name == "ImCurves" else name
                own = set(options(method)) - {"self"}
                found[f"{owner}.{key}"] = own
    return {
        name: some - NO_RESULT
        for name, some in found.items()
        if some - NO_RESULT
    }


IGNORED = {
    # Methods of `Sequence`.
    "Suite.index",
    # It needs a package: test_recorded.py.
    "recorded_suite",
}


def result(call: Callable[..., Any], given: Base) -> Any:
    try:
        return bits(call(**given))
    except (ValueError, TypeError) as error:
        return "refused", str(error)


@pytest.mark.filterwarnings("ignore::UserWarning")
def test_each_keyword_changes_the_result_or_is_refused(tmp_path: Path) -> None:
    all_tries = tries(files(tmp_path))
    wanted = {k: v for k, v in public().items() if k not in IGNORED}
    missing = {
        name: sorted(some - set(all_tries.get(name, ((), {}, {}))[2]))
        for name, some in wanted.items()
    }
    assert {k: v for k, v in missing.items() if v} == {}
    silent = []
    for name, (call, base, changed) in all_tries.items():
        for keyword, other in changed.items():
            given = base
            if isinstance(other, tuple) and len(other) == 2 and isinstance(
                other[0], dict
            ):
                given, other = {**base, **other[0]}, other[1]
            before = result(call, given)
            assert before[0] != "refused", (name, keyword, before)
            if result(call, {**given, keyword: other}) == before:
                silent.append(f"{name}({keyword}={other!r})")
    assert not silent, "\n".join(silent)
