#!/usr/bin/python3
"""Runs studies and inserts their tables into the pages of this folder.

    input/studies/results.py [--ranks 2] [--program build/drivers/suture_study] [--no-run] [STUDY...]

Without names: all studies of this folder. Results go to build/studies_out/<study>/. A page (*.md) holds each table between a line

    <!-- results: STUDY -->                          all runs and bands (table.md)
    <!-- bands: STUDY -->                            bands only
    <!-- matrix: STUDY ROWS x COLUMN: CELLS -->      one row per combination of labels of the sweeps ROWS, one column per label of the
                                                     sweep COLUMN, the columns CELLS of table.csv in each cell
    <!-- matrix: STUDY SWEEP=LABEL|LABEL; ROWS x COLUMN: CELLS -->     only the runs with these labels

and a line "<!-- end -->". If a page shows the picture NAME.png of its study, it is copied to STUDY_NAME.png in this folder. Returns 1
when a study missed a band or has no page <study>.md.
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
ENVIRONMENT = {"OMPI_ALLOW_RUN_AS_ROOT": "1", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1", "OPENBLAS_NUM_THREADS": "1", "OMP_NUM_THREADS": "1"}


def body(table):
    """Text of a table.md without its title, since the page has one."""
    return table.split("\n", 2)[2].strip()


def bands(table):
    """Provenance and bands of a table.md, without its runs."""
    provenance, *rest = body(table).split("\n\n")
    return "\n\n".join([provenance, *(part for part in rest if part.startswith("| band |"))])


def figure(text):
    """Counts unchanged, other numbers with three digits."""
    return text if text.isdecimal() else f"{float(text):.3g}"


def shown(row, cells):
    """Results of a run; '-' for a run without a solution."""
    return " / ".join(figure(row[cell]) for cell in cells) if row["exit_code"] == "0" else "-"


def matrix(study, where, rows, column, cells):
    """One row per combination of the sweeps `rows`, one column per label of the sweep `column`, for the runs with the labels `where`."""
    with open(study / "table.csv") as file:
        runs = list(csv.DictReader(file))
    if where:
        sweep, wanted = where.split("=", 1)
        runs = [run for run in runs if run[sweep] in wanted.split("|")]
    labels = list(dict.fromkeys(run[column] for run in runs))
    lines = {}
    for run in runs:
        lines.setdefault(tuple(run[row] for row in rows), {})[run[column]] = shown(run, cells)
    table = [rows + labels, ["---"] * (len(rows) + len(labels))]
    table += [[*line, *(found.get(label, "") for label in labels)] for line, found in lines.items()]
    return "\n".join(f"| {' | '.join(line)} |" for line in table)


def insert(page, results, studies):
    text = page.read_text()

    def fill(match):
        head, kind, study, rest = match.group(1, 2, 3, 4)
        folder = results / study
        if not (folder / "table.md").exists():
            return match.group(0)
        if kind == "matrix":
            where, rows, column, cells = re.fullmatch(r"(?:(.+?); )?(.+?) x (.+?): (.+)", rest.strip()).groups()
            made = matrix(folder, where, rows.split(", "), column, cells.split(", "))
        else:
            table = (folder / "table.md").read_text()
            made = body(table) if kind == "results" else bands(table)
        return f"{head}\n\n{made}\n\n<!-- end -->"

    changed = re.sub(r"(<!-- (results|bands|matrix): (\w+)( .*?)? -->).*?<!-- end -->", fill, text, flags=re.S)
    if changed != text:
        page.write_text(changed)
        print(f"{page.relative_to(ROOT)}: tables renewed")
    for picture in re.findall(r"!\[[^\]]*\]\((\w+\.png)\)", changed):
        for study in studies:
            drawn = results / study / picture[len(study) + 1:]
            if picture.startswith(f"{study}_") and drawn.is_file():
                shutil.copy(drawn, HERE / picture)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("studies", nargs="*", metavar="STUDY")
    parser.add_argument("--ranks", type=int, default=2)
    parser.add_argument("--program", default=str(ROOT / "build" / "drivers" / "suture_study"))
    parser.add_argument("--results", default=str(ROOT / "build" / "studies_out"))
    parser.add_argument("--no-run", action="store_true", help="only insert existing tables into the pages")
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
    for page in sorted(HERE.glob("*.md")):
        insert(page, results, known)
    without = [study for study in known if not (HERE / f"{study}.md").is_file()]
    if without:
        print(f"results.py: no page for: {', '.join(without)}", file=sys.stderr)
    if missed:
        print(f"results.py: missed: {', '.join(missed)}", file=sys.stderr)
    return 1 if missed or without else 0


if __name__ == "__main__":
    sys.exit(main())
