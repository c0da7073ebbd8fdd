"""The contract's checks find every kind of change, on modified copies of a run's files.

test_contract.py --solve PROGRAM --work DIR --input FOLDER --mpirun "mpirun ..."
"""
import copy
import json
import pathlib
import shutil
import sys

HERE = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent / "drivers"))
import contract
import harness
from harness import arguments, check, finish

options = arguments("--solve", "--input")
run = options.work / "run"
scene = pathlib.Path(options.input) / "sliding_pad" / "sliding_pad.xml"
code, text = harness.run(options.solve, 1, scene, "--output", run)
summary = json.loads((run / "summary.json").read_text())
check("an unchanged run", (code, contract.folderProblems(run)), (0, []))


def planted(what, change):
    """A change of the summary that must be found."""
    changed = copy.deepcopy(summary)
    change(changed)
    check("summary: " + what, len(contract.summaryProblems(changed)), lambda n: n > 0)


def rename(keys, old, new):
    keys[new] = keys.pop(old)


piece = next(iter(summary["contact"]["by_piece"]))
planted("a key renamed", lambda s: rename(s, "energy", "potential_energy"))
planted("a key removed", lambda s: s.pop("mesh_hash"))
planted("a key added", lambda s: s.update(novelty=1))
planted("a key of a list renamed", lambda s: rename(s["outer"], "pcg_total", "pcg"))
planted("a key of a contact piece removed", lambda s: s["contact"]["by_piece"][piece].pop("max_gap"))
planted("a key of friction added", lambda s: s["contact"]["friction"].update(rolling=0.0))
planted("a number became a text", lambda s: s.update(dofs=str(s["dofs"])))
planted("an integer became a fraction", lambda s: s["contact"].update(active=1.5))
planted("a truth became a number", lambda s: s.update(converged=1))
planted("a vector became a number", lambda s: s["equilibrium"].update(applied=0.0))
planted("an exit code that no run has", lambda s: s.update(exit_code=1))
planted("another version", lambda s: s["format"].update(version=2))
planted("another version of a table", lambda s: s["format"]["tables"].update(history=2))
planted("a quantity of the verdict renamed", lambda s: rename(s["verification"], "residual", "residue"))
check("summary: the schema takes nulls of numbers that are not finite", contract.summaryProblems({**summary, "energy": None}), [])


def plantedTable(what, name, kind, change):
    path = options.work / name
    path.write_text(change((run / name).read_text()))
    check(f"{name}: {what}", len(contract.tableProblems(path, kind, summary)), lambda n: n > 0)


plantedTable("a column renamed", "history.csv", "history", lambda t: t.replace("iteration,pcg", "iteration,applications", 1))
plantedTable("two columns exchanged", "history.csv", "history", lambda t: t.replace("iteration,pcg", "pcg,iteration", 1))
plantedTable("a column added", "history.csv", "history", lambda t: "".join(line + ",1\n" for line in t.splitlines()))
plantedTable("a field too few", "history.csv", "history", lambda t: t.rstrip("\n").rsplit(",", 1)[0] + "\n")
plantedTable("a fraction where a count stood", "history.csv", "history", lambda t: t.replace("\n1,", "\n1.5,", 1))
plantedTable("a word that a status never was", "contact.csv", "contact", lambda t: t.replace(",closed", ",shut"))
plantedTable("an empty number", "reactions.csv", "reactions", lambda t: t.splitlines()[0] + "\na,load,,,,0,0,0,0,0,,,,\n")

expected = {"exit_code": 0, "files": contract.filesOf(run)}
check("files as expected", contract.runProblems(expected, 0, run), [])
check("another exit code", contract.runProblems(expected, 4, run), lambda p: len(p) == 1 and "exit code 4" in p[0])
shutil.copy(run / "history.csv", run / "novelty.csv")
check("a file more", contract.runProblems(expected, 0, run), lambda p: len(p) == 1 and "novelty.csv" in p[0])
check("a table without a schema", contract.folderProblems(run), lambda p: len(p) == 1 and "novelty.csv" in p[0])
(run / "novelty.csv").unlink()
(run / "reactions.csv").unlink()
check("a file less", contract.runProblems(expected, 0, run), lambda p: len(p) == 1 and "reactions.csv" in p[0])
help_ = "Options:\n  -h,--help      Print\n  --set PATH=VALUE ...   Change\n"
check("options as expected", contract.optionProblems("p", ["--help", "--set PATH=VALUE"], help_), [])
check("an option renamed", len(contract.optionProblems("p", ["--help", "--put PATH=VALUE"], help_)), 2)
check("the value of an option renamed", len(contract.optionProblems("p", ["--help", "--set NAME=VALUE"], help_)), 2)
finish()
