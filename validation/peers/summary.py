"""The digits of every code on the reference data set, level by level.

    summary.py ROCKING fixtures/benchmark

scores each of its answers/CODE-SETTING.csv and writes codes.csv, which
`rocking score` shows beside a code.
"""

import json
import subprocess
import sys
from pathlib import Path

rocking, folder = sys.argv[1], Path(sys.argv[2])
lines = ["code,level,median_digits,worst_digits"]
for answers in sorted(folder.glob("answers/*.csv")):
    words = [rocking, "score", str(answers), "--json"]
    found = json.loads(subprocess.check_output(words))
    for row in found["levels"]:
        digits = row["median_digits"], row["worst_digits"]
        if None not in digits:
            median, worst = (round(x, 2) for x in digits)
            lines.append(f"{answers.stem},{row['level']},{median},{worst}")
(folder / "codes.csv").write_text("\n".join(lines) + "\n")
