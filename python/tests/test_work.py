"""Long calls: threads, progress, pickling."""

import os
import pickle
import threading
import time

import pytest
import rocking as rk


def test_the_number_of_threads_changes_no_bit(
    block: rk.Block, suite: rk.Suite, ida: rk.Ida
) -> None:
    for threads in (1, 2, 3):
        assert rk.ida(block, suite, threads=threads) == ida


def test_two_python_threads_work_at_once(
    block: rk.Block, suite: rk.Suite, ida: rk.Ida
) -> None:
    found: list[rk.Ida] = []

    def work() -> None:
        found.append(rk.ida(block, suite, threads=1))

    workers = [threading.Thread(target=work) for _ in range(2)]
    for worker in workers:
        worker.start()
    # The interpreter is free: this loop turns while they work.
    turns = 0
    while any(worker.is_alive() for worker in workers):
        turns += 1
        time.sleep(0.001)
    assert turns > 20
    assert found == [ida] * 2


def test_progress_is_reported_in_the_calling_thread(
    block: rk.Block, suite: rk.Suite
) -> None:
    reported: list[tuple[int, int]] = []
    threads: set[int] = set()

    def progress(done: int, total: int) -> None:
        reported.append((done, total))
        threads.add(threading.get_ident())

    rk.ida(block, suite, progress=progress)
    assert reported[-1] == (86, 86)
    assert reported == sorted(reported)
    assert threads == {threading.get_ident()}


def test_what_progress_raises_ends_the_work(
    block: rk.Block, suite: rk.Suite
) -> None:
    class Enough(Exception):
        pass

    def progress(done: int, total: int) -> None:
        raise Enough

    begin = time.monotonic()
    with pytest.raises(Enough):
        rk.ida(block, suite, step_g=2e-4, progress=progress)
    # Progress is reported once a curve is done; the whole takes longer.
    assert time.monotonic() - begin < 30.0


def test_everything_comes_back_from_a_pickle(
    block: rk.Block, suite: rk.Suite, ida: rk.Ida, packet: rk.Record
) -> None:
    pulse = rk.Pulse("one-sine", amplitude_g=0.3, omega=6.0)
    for same in (block, suite, pulse, packet):
        assert pickle.loads(pickle.dumps(same)) == same
    response = rk.respond(block, packet, im=2.0, history_dt=0.01)
    other = rk.respond(block, packet, im=2.0, history_dt=0.02)
    sample = ida.sample(0.5)
    fit = rk.fit_fragility(sample, n_resamples=50)
    for one in (ida, ida.against("pgv"), response, sample, fit):
        again = pickle.loads(pickle.dumps(one))
        assert again == one and hash(again) == hash(one)
    assert response != other and ida != response
    again = pickle.loads(pickle.dumps(ida))
    assert again.capacities(0.5).tolist() == ida.capacities(0.5).tolist()


def test_results_are_frozen_after_a_pickle_too(
    packet: rk.Record, ida: rk.Ida
) -> None:
    for record in (packet, pickle.loads(pickle.dumps(packet))):
        with pytest.raises(ValueError, match="read-only"):
            record.acc_g[0] = 1.0
        with pytest.raises(AttributeError):
            record.dt = 1.0  # type: ignore[misc]
    for one in (ida, pickle.loads(pickle.dumps(ida))):
        with pytest.raises(ValueError, match="read-only"):
            one.sample(0.5).values[0] = 1.0


def test_a_forked_process_works(block: rk.Block, packet: rk.Record) -> None:
    expected = rk.ida(block, packet)
    child = os.fork()
    if child == 0:
        found = rk.ida(block, packet)
        os._exit(0 if found == expected else 1)
    _, status = os.waitpid(child, 0)
    assert status == 0
