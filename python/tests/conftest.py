"""The command line as the reference, and a suite that it wrote."""

import os
import subprocess
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest
import rocking as rk

ROOT = Path(__file__).resolve().parents[2]
Command = Callable[..., str]


@pytest.fixture(scope="session")
def program() -> Path:
    """The command line."""
    built = ROOT / "target" / "release" / "rocking"
    path = Path(os.environ.get("ROCKING_COMMAND", built))
    assert path.is_file(), f"{path}: build it by cargo build --release"
    return path


@pytest.fixture(scope="session")
def command(program: Path) -> Command:
    """Runs the command line and gives what it printed."""

    def run(*arguments: object) -> str:
        words = [str(word) for word in arguments]
        done = subprocess.run(
            [str(program), *words], capture_output=True, text=True
        )
        assert done.returncode == 0, done.stderr
        return done.stdout

    return run


@pytest.fixture(scope="session")
def suites(command: Command, tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Folder of the embedded suites as files."""
    folder = tmp_path_factory.mktemp("export") / "suites"
    command("suite", "export", "--out", folder)
    return folder


@pytest.fixture(scope="session")
def suite(suites: Path) -> rk.Suite:
    return rk.read_suite(suites / "ordinary.csv")


@pytest.fixture(scope="session")
def block() -> rk.Block:
    return rk.Block(alpha=0.2, p=3.0)


@pytest.fixture(scope="session")
def ida(block: rk.Block, suite: rk.Suite) -> rk.Ida:
    return rk.ida(block, suite)


@pytest.fixture()
def packet() -> rk.Record:
    """A wave packet of 8 s."""
    t = np.arange(800) * 0.01
    acc = 0.3 * np.sin(7.0 * t) * np.exp(-0.5 * (t - 3.0) ** 2)
    return rk.Record(acc, 0.01, units="g", name="packet")
