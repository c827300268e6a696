"""What comes back from a pickle, or is copied, does what the original does:
every public attribute and method of every class is tried."""

import copy
import dataclasses
import inspect
import pickle
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import rocking as rk

PULSE = rk.Pulse("one-sine", amplitude_g=0.3, omega=6.0)
BLOCK = rk.Block(alpha=0.2, p=3.0)
HAZARD = rk.Hazard("h.csv", "pga_g,annual_frequency\n0.1,0.01\n1,1e-5\n")
LAW = rk.Fragility(shift=1.0, log_mean=0.0, dispersion=0.5, median=2.0)
FLOOR = rk.Floor("roof", 0.5, 0.05, 1.3)
SUITE = rk.embedded_suite("pulse")[:8]
FATES: list[Any] = ["stood", "overturned"] * 4
# Shares that rise with the demand over the capacity.
RANKED = np.argsort(
    [one.pga_g for one in SUITE] / rk.ida(BLOCK, SUITE).capacities(np.inf)
)
TESTS = [
    rk.ShakingTest(SUITE[k], SUITE[k].name, fate)
    for k, fate in zip(RANKED.tolist(), FATES)
]
VALUES = [1.3, 1.6, 1.7, 2.0, 2.1, 2.5, 2.6, 3.1, 3.4, 4.2]


def solve(scene: dict[str, Any]) -> dict[str, Any]:
    return {"fate": "rocked"}


@pytest.fixture(scope="module")
def made() -> list[object]:
    """Objects of every class."""
    ida = rk.ida(BLOCK, SUITE)
    fit = rk.fit_fragility(ida.sample(0.5), n_resamples=9, band=[2.0])
    names = [*"abcdefghij"]
    pairs = [rk.Sample(VALUES, records=names)] * 2
    pair = rk.embedded_suite("pulse", component="both")[:2]
    box = rk.summarise(VALUES)
    cloud = rk.cloud(rk.Block(alpha=0.2, p=2.0), SUITE, [0.5], n_resamples=9)
    return [
        PULSE,
        BLOCK,
        HAZARD,
        LAW,
        FLOOR,
        SUITE,
        SUITE[0],
        ida,
        ida.against("arias", SUITE),
        ida.against("pgv"),
        ida.sample(0.5),
        fit,
        rk.Object("vase", BLOCK, floor=FLOOR),
        rk.respond(BLOCK, SUITE[0], im=1.3, history_dt=0.1),
        rk.assess(rk.Object("a", BLOCK), SUITE, n_resamples=9),
        rk.assess(rk.Object("a", BLOCK), SUITE, n_resamples=9).objects[0],
        rk.BlockFragility(block=BLOCK, fit=fit, im="pga"),
        rk.fit_stripes([(1.0, 1, 10), (2.0, 5, 10), (4.0, 9, 10)]),
        rk.compare(*pairs),
        rk.contrast(VALUES, VALUES, n_resamples=9),
        ida.summarise(),
        ida.pivot_forces(SUITE, [0.3]),
        *ida.levels([0.5]),
        *ida.fit([0.5]),
        *ida.stripes([1.2], edp=0.5),
        *ida.crossings(ida.records[0], [0.5]),
        rk.rank_ims(ida, SUITE, ims=["pga", "pgv"], n_resamples=9),
        cloud,
        *cloud.levels,
        rk.intensity_measures(SUITE[0]),
        rk.velocity_pulse(*pair),
        rk.test_normality(VALUES, shift=0.0),
        box,
        box.boxplot,
        rk.Reason("no result"),
        rk.risk(HAZARD, {"law": LAW}),
        rk.law_fragility(rk.Block(alpha=0.15, p=3.0)),
        rk.score(solve),
        TESTS[0],
        rk.compare_with_tests(TESTS, BLOCK, ims=["pga"], n_resamples=9),
    ]


CALLS: dict[str, tuple[tuple[Any, ...], dict[str, Any]]] = {
    "against": (("pgv",), {}),
    "capacities": (([0.5, np.inf],), {}),
    "cdf": ((1.5,), {}),
    "count": ((SUITE[1],), {}),
    "crossings": (("pulse-01-a", [0.5]), {}),
    "demands": ((1.0,), {}),
    "fit": (([0.5],), {"shift": 1.0}),
    "fit_stripes": (([1.2, 1.5, 2.0],), {"edp": 0.5, "n_resamples": 9}),
    "index": ((SUITE[1],), {}),
    "levels": (([0.5],), {}),
    "pdf": ((1.5,), {}),
    "pivot_forces": ((SUITE, [0.3]), {}),
    "ppf": ((0.3,), {}),
    "rvs": ((3,), {"rng": 1}),
    "sample": ((0.5,), {}),
    "sf": ((1.5,), {}),
    "stripes": (([1.2],), {"edp": 0.5}),
}
WRITES = {"save", "to_csv"}


def bits(value: Any) -> Any:
    """Something that is equal where the values are, to the last bit."""
    if isinstance(value, np.ndarray):
        return value.dtype.str, value.shape, value.tobytes()
    if isinstance(value, (tuple, list)):
        return [bits(one) for one in value]
    if isinstance(value, dict) or hasattr(value, "items") and not hasattr(
        value, "columns"
    ):
        return {str(key): bits(one) for key, one in value.items()}
    if hasattr(value, "to_csv") and hasattr(value, "columns"):
        return value.to_csv()
    if isinstance(value, rk.Ida):
        return bits(value.to_pandas())
    if dataclasses.is_dataclass(value):
        fields = {f.name: getattr(value, f.name) for f in dataclasses.fields(value)}
        return type(value).__name__, bits(fields)
    if type(value).__module__.startswith("scipy"):
        return bits({k: v for k, v in vars(value).items() if k in ("args", "kwds")})
    if hasattr(value, "has_data"):
        return value.has_data(), len(value.lines)
    return repr(value)


def names_of(one: object) -> list[str]:
    """Public attributes and methods, class methods apart."""
    kind = type(one)

    def is_own(name: str) -> bool:
        found = inspect.getattr_static(one, name)
        return not isinstance(found, (classmethod, staticmethod))

    return [name for name in dir(one) if name[0] != "_" and is_own(name)]


def asked(one: Any, name: str, folder: Path) -> Any:
    """What an attribute is, or a method gives; what is refused, by its
    words."""
    value = getattr(one, name)
    if not callable(value):
        return bits(value)
    arguments, keywords = CALLS.get(name, ((), {}))
    try:
        if name in WRITES:
            value(folder / name)
            place = folder / name
            files = [place] if place.is_file() else sorted(place.iterdir())
            return [(file.name, file.read_bytes()) for file in files]
        return bits(value(*arguments, **keywords))
    except ValueError as error:
        return str(error)


AGAIN: dict[str, Callable[[Any], Any]] = {
    "pickle": lambda one: pickle.loads(pickle.dumps(one)),
    "deepcopy": copy.deepcopy,
    "copy": copy.copy,
}


def test_every_class_is_tried(made: list[object]) -> None:
    kinds = {getattr(rk, name) for name in rk.__all__}
    classes = {kind for kind in kinds if inspect.isclass(kind)}
    assert {type(one) for one in made} >= classes


@pytest.mark.parametrize("way", AGAIN)
def test_every_method_gives_the_same_again(
    way: str, made: list[object], tmp_path: Path
) -> None:
    pyplot: Any = pytest.importorskip("matplotlib.pyplot")
    pyplot.switch_backend("agg")
    tried = 0
    for one in made:
        again = AGAIN[way](one)
        assert again == one, type(one)
        for name in names_of(one):
            expected = asked(one, name, tmp_path)
            assert asked(again, name, tmp_path) == expected, (type(one), name)
            tried += 1
    pyplot.close("all")
    assert tried > 350
    # The methods that need the run are not refused alike.
    [ida] = [one for one in made if isinstance(one, rk.Ida)]
    again = AGAIN[way](ida)
    assert again.summarise().records == 8
    assert again.pivot_forces(SUITE, [0.3]).analyses > 8


def test_arrays_stay_read_only(made: list[object]) -> None:
    held = 0
    for one in made:
        for same in (one, *(again(one) for again in AGAIN.values())):
            for name, value in vars(same).items():
                if name[0] != "_" and isinstance(value, np.ndarray):
                    assert not value.flags.writeable, (type(one), name)
                    held += 1
    assert held >= 4 * 5


def test_objects_of_two_classes_are_not_equal(made: list[object]) -> None:
    for i, one in enumerate(made):
        for other in made[:i]:
            if type(one) is not type(other):
                assert one != other and other != one
    twin: Any = dataclasses.make_dataclass(
        "Twin", ["values", "limits", "events", "records"]
    )
    sample = rk.Sample([1.0])
    assert sample != twin(sample.values, sample.limits, (), ())

    class Other(rk.Sample):
        pass

    assert rk.Sample([1.0]) == rk.Sample([1.0])
    assert Other([1.0]) != rk.Sample([1.0])
