"""The digits of every code on the reference data set, level by level.

    summary.py ROCKING fixtures/benchmark

scores each of its answers/CODE-SETTING.csv and writes codes.csv, which
`rocking score` shows beside a code, and the report as a table and a figure.
"""

import csv
import json
import subprocess
import sys
from pathlib import Path

rocking, folder = sys.argv[1], Path(sys.argv[2])
lines = [
    "code,setting,version,level,median_digits,worst_digits,fates_wrong,"
    "fates_answered"
]
with (folder / "tools.csv").open() as file:
    tools = {(row["code"], row["setting"]): row for row in csv.DictReader(file)}
for answers in sorted(folder.glob("answers/*.csv")):
    code, setting = answers.stem.split("-")
    version = tools[code, setting]["version"]
    words = [rocking, "score", str(answers), "--json"]
    found = json.loads(subprocess.check_output(words))
    for row in found["levels"]:
        digits = row["median_digits"], row["worst_digits"]
        if None not in digits:
            median, worst = (round(x, 2) for x in digits)
            wrong = row["fates_wrong"]
            cells = code, setting, version, row["level"], median, worst, wrong
            answered = wrong + row["fates_right"]
            lines.append(",".join(map(str, (*cells, answered))))
(folder / "codes.csv").write_text("\n".join(lines) + "\n")
