"""Tables of `rocking sweep merge` as Parquet, read back by other readers.

    python3 tests/parquet.py target/release/rocking target/debug/rocking

The first program runs a sweep of three blocks and merges it as CSV; the
second, built with `--features parquet`, merges it as Parquet. Every cell that
pyarrow reads must be the CSV's, bit by bit; so must what Polars and DuckDB
read, where Python has them. Python's own `csv` and `float` read the CSV.

    pip install pyarrow polars duckdb
"""

import csv
import importlib.util
import json
import struct
import subprocess
import sys
import tempfile
from pathlib import Path

import pyarrow
from pyarrow import parquet

ROCKING, WITH_PARQUET = (Path(name).resolve() for name in sys.argv[1:3])
BLOCKS = "alpha,p,eta\n0.3,4,0.92\n0.25,6,0.9\n0.35,5,0.92\n"
COUNTS = {"records", "reached", "unresolved", "analyses"}
FLAGS = {"refined", "resolved"}


def run(program, folder, *words):
    return subprocess.run([program, "sweep", *words], cwd=folder, text=True,
                          capture_output=True, check=False)


def done(program, folder, *words):
    found = run(program, folder, *words)
    assert found.returncode == 0, found.stderr
    return found.stdout


def bits(x):
    """A cell such that equal means equal bits."""
    return struct.pack("<d", x) if isinstance(x, float) else x


def typed(name, table, cell):
    """What a cell of the CSV is."""
    if name in FLAGS:
        return {"true": True, "false": False}[cell]
    if name in COUNTS:
        return int(cell)
    if name == "record" or (name == "im" and table == "fragilities"):
        return cell
    return bits(float(cell)) if cell else None


def expected(path, table):
    with path.open(newline="") as file:
        header, *rows = csv.reader(file)
    columns = zip(*rows)
    return {name: [typed(name, table, cell) for cell in cells]
            for name, cells in zip(header, columns)}


def others(path):
    """The columns as other readers give them."""
    if importlib.util.find_spec("polars"):
        import polars
        frame = polars.read_parquet(path)
        yield "polars", frame.to_dict(as_series=False)
    if importlib.util.find_spec("duckdb"):
        import duckdb
        relation = duckdb.sql(f"SELECT * FROM '{path}'")
        yield "duckdb", dict(zip(
            relation.columns, zip(*relation.fetchall())))


def compare(folder, table):
    csv_path = folder / f"{table}.csv"
    path = folder / f"{table}.parquet"
    truth = expected(csv_path, table)
    file = parquet.ParquetFile(path)
    about = {key.decode(): value.decode()
             for key, value in file.metadata.metadata.items()}
    assert about["rocking.table"] == table, about
    assert len(about["rocking.plan_sha256"]) == 64, about
    version = about["rocking.software"].split()[1]
    by = file.metadata.created_by
    assert by.startswith(f"rocking version {version} (build "), by
    settings = json.loads(about["rocking.settings"])
    assert settings["levels"] == {"step_im": 0.02}, settings
    assert str(folder).encode() not in path.read_bytes()
    for field in file.schema_arrow:
        kind = {bool: pyarrow.bool_(), int: pyarrow.int64(),
                str: pyarrow.string(), bytes: pyarrow.float64(),
                type(None): pyarrow.float64()}[type(truth[field.name][0])]
        assert field.type == kind, field
    readers = [("pyarrow", file.read().to_pydict()), *others(path)]
    for reader, found in readers:
        assert list(found) == list(truth), (reader, list(found))
        for name, cells in found.items():
            cells = [bits(cell) for cell in cells]
            assert cells == truth[name], (reader, table, name)
    names = ", ".join(reader for reader, _ in readers)
    rows = file.metadata.num_rows
    sizes = [p.stat().st_size / rows for p in (csv_path, path)]
    print(f"{table}: {rows} rows equal in {names}; bytes a row "
          f"{sizes[0]:.1f} as CSV, {sizes[1]:.1f} as Parquet")


def main():
    with tempfile.TemporaryDirectory() as folder:
        folder = Path(folder)
        (folder / "blocks.csv").write_text(BLOCKS)
        subprocess.run([ROCKING, "suite", "export", "--out", "suites"],
                       cwd=folder, check=True, capture_output=True)
        for name, tasks in [("sweep", ["0/1"]), ("twice", ["1/2", "0/2"])]:
            done(ROCKING, folder, "plan", "--blocks", "blocks.csv", "--suite",
                 "suites/ordinary.csv", "--rows", "--tile-minutes", "1e-9",
                 "--out", name)
            for task in tasks:
                task, of = task.split("/")
                done(ROCKING, folder, "run", name, "--task", task, "--of", of)
        for table in ["fragilities", "capacities", "rows"]:
            merge = ["merge", "sweep", "--what", table, "--out"]
            done(ROCKING, folder, *merge, f"{table}.csv")
            done(WITH_PARQUET, folder, *merge, f"{table}.parquet")
            compare(folder, table)
            # The number of tasks is not in the bytes.
            merge[1] = "twice"
            done(WITH_PARQUET, folder, *merge, "again.parquet")
            first = (folder / f"{table}.parquet").read_bytes()
            assert (folder / "again.parquet").read_bytes() == first
        # A damaged tile is named, and the file of before stays.
        tile = folder / "sweep/tiles/rows-00001.csv"
        tile.write_bytes(tile.read_bytes().replace(b"0.25", b"0.24", 1))
        found = run(WITH_PARQUET, folder, "merge", "sweep", "--what", "rows",
                    "--out", "rows.parquet")
        assert found.returncode == 2, found
        assert "rows-00001.csv: damaged" in found.stderr, found.stderr
        assert (folder / "rows.parquet").read_bytes() == first


if __name__ == "__main__":
    main()
