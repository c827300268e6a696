"""A sweep on a Dask cluster of processes on this machine."""

import os
import signal
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import rocking as rk

distributed: Any = pytest.importorskip("distributed")

Content = tuple[list[str], list[str]]

BLOCKS = [
    rk.Block(alpha=alpha, p=p)
    for alpha in (0.1, 0.2, 0.3)
    for p in (1.5, 3.0, 4.5)
]


@pytest.fixture()
def client(tmp_path: Path) -> Iterator[Any]:
    """Two processes; one that dies is started anew."""
    with (
        distributed.LocalCluster(
            n_workers=2,
            threads_per_worker=1,
            processes=True,
            dashboard_address=None,
            local_directory=str(tmp_path),
        ) as cluster,
        distributed.Client(cluster) as client,
    ):
        yield client


@pytest.fixture(scope="module")
def alone(suites: Path) -> Content:
    """The sweep in this process."""
    suite = rk.read_suite(suites / "ordinary.csv")[::2]
    idas = [rk.ida(block, suite) for block in BLOCKS]
    samples = [ida.capacities(np.inf) for ida in idas]
    fits = [rk.fit_fragility(sample, shift=1.0) for sample in samples]
    return content(idas, fits)


def content(
    idas: Sequence[rk.Ida], fits: Sequence[rk.FragilityFit]
) -> Content:
    """Every bit of the results, in the order of the blocks."""
    tables = [ida.to_pandas().to_csv() for ida in idas]
    return tables, [fit.to_json() for fit in fits]


def every_second(suite: rk.Suite) -> rk.Suite:
    return suite[::2]


def start(client: Any, suites: Path) -> tuple[list[Any], list[Any]]:
    """The sweep as tasks. The suite is one too: who lost it reads it."""
    whole = client.submit(rk.read_suite, suites / "ordinary.csv")
    suite = client.submit(every_second, whole)
    idas = client.map(rk.ida, BLOCKS, suite=suite, threads=1)
    samples = client.map(rk.Ida.capacities, idas, edp=np.inf)
    return idas, client.map(rk.fit_fragility, samples, shift=1.0)


def test_a_cluster_gives_the_bytes_of_one_process(
    client: Any, suites: Path, alone: Content
) -> None:
    idas, fits = start(client, suites)
    found = content(client.gather(idas), client.gather(fits))
    assert found == alone
    # Both took part.
    holders = client.who_has(idas).values()
    assert len({worker for some in holders for worker in some}) == 2


def test_a_worker_killed_in_mid_run_changes_no_byte(
    client: Any, suites: Path, alone: Content
) -> None:
    before = client.run(os.getpid)
    idas, fits = start(client, suites)
    first = next(distributed.as_completed(idas))
    [holder, *_] = client.who_has([first])[first.key]
    # It holds a result and works on the next.
    assert client.processing()[holder]
    os.kill(before[holder], signal.SIGKILL)
    assert not all(future.done() for future in idas)
    found = content(client.gather(idas), client.gather(fits))
    assert found == alone
    after = client.run(os.getpid)
    assert before[holder] not in after.values()
