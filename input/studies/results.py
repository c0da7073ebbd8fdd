#!/usr/bin/python3
"""Runs studies and puts their tables into README.md of this folder.

    input/studies/results.py [--ranks 2] [--program build/drivers/suture_study] [--no-run] [STUDY...]

Without names: all studies of this folder. Results go to build/studies_out/<study>/; a table.md found there is put between the lines
"<!-- results: STUDY -->" and "<!-- end -->", and a matrix of it between "<!-- matrix: STUDY ROWS x COLUMN: CELLS -->" (sweeps, sweep, columns) and "<!-- end -->"; a picture
NAME.png of the study is copied to STUDY_NAME.png of this folder if the README shows it. Returns 1 when a study missed a band.
"""
import argparse
import csv
import os
import re
import shutil
import subprocess
import sys
from pathlib import Path

HERE = Path(__file__).resolve().parent
ROOT = HERE.parent.parent
READMES = [HERE / "README.md"]
ENVIRONMENT = {"OMPI_ALLOW_RUN_AS_ROOT": "1", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1", "OPENBLAS_NUM_THREADS": "1", "OMP_NUM_THREADS": "1"}


def body(table):
    """Without the title: the README has its own."""
    return table.split("\n", 2)[2].strip()


def shown(row, cells):
    """The figures of a run, three digits; a run without a solution has none."""
    return " / ".join(f"{float(row[cell]):.3g}" for cell in cells) if row["exit_code"] == "0" else "-"


def matrix(study, rows, column, cells):
    """One line for each combination of the sweeps `rows`, one column for each label of the sweep `column`."""
    with open(study / "table.csv") as file:
        runs = list(csv.DictReader(file))
    labels = list(dict.fromkeys(run[column] for run in runs))
    lines = {}
    for run in runs:
        lines.setdefault(tuple(run[row] for row in rows), {})[run[column]] = shown(run, cells)
    table = [" | ".join(rows + labels), "|".join(["---"] * (len(rows) + len(labels)))]
    table += [" | ".join([*line, *(found.get(label, "") for label in labels)]) for line, found in lines.items()]
    return "\n".join(f"| {line} |" for line in table)


def insert(readme, results):
    text = readme.read_text()

    def replace(match):
        study = match.group(1)
        table = results / study / "table.md"
        return f"<!-- results: {study} -->\n\n{body(table.read_text())}\n\n<!-- end -->" if table.exists() else match.group(0)

    changed = re.sub(r"<!-- results: (\w+) -->.*?<!-- end -->", replace, text, flags=re.S)

    def draw(match):
        study, rows, column, cells = match.groups()
        if not (results / study / "table.csv").exists():
            return match.group(0)
        made = matrix(results / study, rows.split(", "), column, cells.split(", "))
        return f"<!-- matrix: {study} {rows} x {column}: {cells} -->\n\n{made}\n\n<!-- end -->"

    changed = re.sub(r"<!-- matrix: (\w+) (.+?) x (.+?): (.+?) -->.*?<!-- end -->", draw, changed, flags=re.S)
    if changed != text:
        readme.write_text(changed)
        print(f"{readme.relative_to(ROOT)}: tables renewed")
    for study, picture in re.findall(r"!\[[^\]]*\]\((\w+?)__(\w+\.png)\)", changed):
        drawn = results / study / picture
        if readme.parent == HERE and drawn.exists():
            shutil.copy(drawn, HERE / f"{study}__{picture}")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("studies", nargs="*", metavar="STUDY")
    parser.add_argument("--ranks", type=int, default=2)
    parser.add_argument("--program", default=str(ROOT / "build" / "drivers" / "suture_study"))
    parser.add_argument("--results", default=str(ROOT / "build" / "studies_out"))
    parser.add_argument("--no-run", action="store_true", help="only put the tables that exist into the READMEs")
    options = parser.parse_args()
    known = sorted(path.stem for path in HERE.glob("*.xml") if 'name="Study"' in path.read_text())
    unknown = sorted(set(options.studies) - set(known))
    if unknown:
        sys.exit(f"results.py: no such study: {', '.join(unknown)}. Known here: {', '.join(known)}")
    missed = []
    results = Path(options.results)
    for study in (options.studies or known) if not options.no_run else []:
        command = ["mpirun", "--oversubscribe", "-np", str(options.ranks), options.program, str(HERE / f"{study}.xml"), "--output", str(results / study)]
        print("$", " ".join(command), flush=True)
        if subprocess.run(command, env={**ENVIRONMENT, **os.environ}).returncode != 0:
            missed.append(study)
    for readme in READMES:
        insert(readme, results)
    if missed:
        sys.exit(f"results.py: missed: {', '.join(missed)}")


if __name__ == "__main__":
    main()
