"""suture_solve --again: repeats a run from its summary.json, reports whether the results agree, and refuses changed inputs.

again.py --solve PROGRAM --plugin LIB.so --work DIR --input FOLDER --mpirun "mpirun ..."
"""
import copy
import csv
import json
import pathlib
import re
import shutil

from harness import arguments, check, finish, run, setting

options = arguments("--solve", "--plugin", "--input")
work, scenes = options.work.resolve(), pathlib.Path(options.input).resolve()


def solve(ranks, *words):
    return run(options.solve, ranks, *words)


def summaryOf(folder):
    return json.loads((folder / "summary.json").read_text())


# A separate scene with a .geo file, changed from the command line.
own = work / "own"
own.mkdir()
for name in ("bracket.xml", "bracket.geo"):
    shutil.copy(scenes / "bracket" / name, own)
scene, geometry, first = own / "bracket.xml", own / "bracket.geo", work / "first"
sceneText, geometryText = scene.read_text(), geometry.read_text()
code, _ = solve(1, scene, "--output", first, *setting("Outer Solver/Tolerance", "1e-9"), *setting("Mesh/Mesh Size Factor", "2"))
record = (first / "summary.json").read_bytes()
check("the first run", code, 0)
code, text = solve(1, "--again", first / "summary.json")
check("again on the same ranks: to the last bit", (code, "quantities to the last bit" in text), (0, True))
check("a new folder next to it, with the parameters of the record", summaryOf(work / "first_again")["parameters"]["Outer Solver"]["Tolerance"], "1e-9")
check("the record is as it was", (first / "summary.json").read_bytes() == record, True)
code, text = solve(2, "--again", first, "--output", work / "two")
check("on two ranks, by the name of the folder", (code, "1 rank then, 2 ranks now, tolerance 1.0e-09" in text,
      bool(re.search(r"agrees: all \d+ (compared )?quantities", text))), (0, True, True))
rows = {row["quantity"]: row for row in csv.DictReader((work / "two" / "comparison.csv").open())}
check("comparison.csv", rows["energy"]["agrees"], "true")
check("what is allowed: 100 times the tolerance", float(rows["energy"]["allowed"]), lambda x: abs(x / 1e-7 - 1) < 0.05)
code, text = solve(1, "--again", first, "--output", work / "silent", "--quiet")
check("--quiet", (code, text), (0, ""))

# Bodies removed and placed on the path: the record is that of the whole scene.
lined = pathlib.Path(__file__).resolve().parent / "lined_tunnel.xml"
code, _ = solve(1, lined, "--output", work / "lined")
check("a scene with phases", (code, summaryOf(work / "lined")["parameters"]["Load Steps"]["Removed"]), (0, {"core": 1.0}))
code, text = solve(1, "--again", work / "lined")
check("a scene with phases, again", (code, "quantities to the last bit" in text), (0, True))

# Records with changed figures: detected and ignored differences.
blocks = scenes / "two_blocks" / "two_blocks.xml"
solve(1, blocks, "--output", work / "blocks", *setting("Outer Solver/Tolerance", "1e-9"))
plain = summaryOf(work / "blocks")
contact = next(iter(plain["reactions"]["contacts"]))
largest = max(sum(f * f for f in one["force"]) ** 0.5 for kind in ("conditions", "contacts") for one in plain["reactions"][kind].values())


def planted(what, expected, change, said=""):
    other = copy.deepcopy(plain)
    change(other)
    folder = work / "planted"
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir()
    (folder / "summary.json").write_text(json.dumps(other))
    code, text = solve(1, "--again", folder, "--quiet")
    check(what, (code, said in text), (expected, True))


def scaled(by):
    return lambda s: s.update(energy=s["energy"] * by)


def pushed(part):
    def change(summary):
        summary["reactions"]["contacts"][contact]["force"][0] += part * largest
    return change


planted("an energy that differs by a tenth of what is allowed", 0, scaled(1 + 1e-8))
planted("an energy that differs by ten times that", 4, scaled(1 + 1e-6), "energy differs by 1.0e-06")
planted("a contact force that differs by a tenth of what is allowed", 0, pushed(1e-8))
planted("a contact force that differs by ten times that", 4, pushed(1e-6), f"contact force '{contact}' differs by 1.0e-06")
planted("a pair more is closed", 4, lambda s: s["contact"].update(active=s["contact"]["active"] + 1), "closed pairs differs")
planted("a pair more is closed, and one touches", 0, lambda s: s["contact"].update(active=s["contact"]["active"] + 1, touching_without_force=1))
planted("an iteration more", 0, lambda s: s["outer"].update(iterations=s["outer"]["iterations"] + 1))
planted("a number that is not finite", 4, lambda s: s.update(max_displacement=None), "largest displacement")
planted("a contact that the run has not", 4, lambda s: s["reactions"]["contacts"].update(ghost=s["reactions"]["contacts"][contact]), "ghost")
planted("a looser tolerance allows more", 0, lambda s: (scaled(1 + 1e-6)(s), s["parameters"]["Outer Solver"].update({"Tolerance": "1e-7"})))

# Refused inputs.
planted("another version of the format", 3, lambda s: s["format"].update(version=2), "has format 2")
planted("the summary of an earlier Suture", 3, lambda s: s.pop("format"), "an earlier version")
planted("a summary without its record", 3, lambda s: s.pop("record"), "damaged")
planted("a scene made in C++", 3, lambda s: s["record"].update(scene=None), "is not a file")
planted("a run that was stopped", 3, lambda s: s.update(exit_code=75), "--restart")
planted("another mesh", 3, lambda s: s.update(mesh_hash="0123456789abcdef"), "is not the mesh of the run")
for name, content in (("no JSON", "<xml/>"), ("JSON, but a list", "[1, 2]"), ("JSON, but no summary", '{"a": 1}'), ("an empty file", "")):
    (work / "strange.json").write_text(content)
    code, text = solve(2, "--again", work / "strange.json")
    check(name, (code, text.count("strange.json"), "expected the summary.json of a run" in text), (3, 2, True))
check("a folder without a summary", solve(1, "--again", own)[0], 3)
check("nothing there", solve(1, "--again", work / "nothing")[0], 3)
(work / "link").symlink_to(first)
for name, words in (("its own folder", ["--output", first]), ("a link to it", ["--output", work / "link"]), ("--set", setting("Output/Fields", "false")),
                    ("a scene", [scene]), ("--restart", ["--restart", "c.h5"]), ("--check", ["--check"]), ("--plugin", ["--plugin", "p.so"])):
    code, text = solve(1, "--again", first, *words)
    check(f"command line: with {name}", (code, "another folder" in text or "excludes" in text), (2, True))
check("the record is as it was", (first / "summary.json").read_bytes() == record, True)

# Changed files.
scene.write_text(sceneText + "<!-- changed -->\n")
code, text = solve(1, "--again", first)
check("a scene file with a comment more", (code, "none of its parameters" in text), (0, True))
scene.write_text(sceneText.replace('"Young Modulus" type="double" value="', '"Young Modulus" type="double" value="1'))
check("(the scene of this test is another now)", scene.read_text() != sceneText, True)
code, text = solve(2, "--again", first)
check("a parameter that has changed is named", (code, " in the scene now, " in text and " in the original run" in text), (3, True))
scene.unlink()
code, text = solve(2, "--again", first)
check("a scene that is gone", (code, "bracket.xml: cannot be read" in text), (3, True))
scene.write_text(sceneText)
geometry.write_text(geometryText + "// changed\n")
check("a geometry with a comment more", solve(1, "--again", first)[0], 0)
geometry.write_text(geometryText + "Mesh.MeshSizeFactor = 1.5;\n")
code, text = solve(2, "--again", first)
check("another geometry", (code, "is not the mesh of the run" in text and "'bracket.geo'" in text), (3, True))

# A run continued from a checkpoint, with a plugin.
plugin = work / "plugin.so"
shutil.copy(options.plugin, plugin)
solve(1, blocks, "--output", work / "before", *setting("Output/Checkpoint", "true"))
solve(1, blocks, "--output", work / "after", "--restart", work / "before" / "checkpoint.h5", "--plugin", plugin)
code, text = solve(1, "--again", work / "after")
check("with restart and plugin", (code, "quantities to the last bit" in text), (0, True))
with plugin.open("ab") as file:
    file.write(b"\0")
code, text = solve(1, "--again", work / "after")
check("a plugin that has changed is noted", (code, "note: the plugin" in text), (0, True))
plugin.unlink()
code, text = solve(2, "--again", work / "after")
check("a plugin that is gone", (code, "plugin.so' cannot be read" in text), (3, True))
shutil.copy(options.plugin, plugin)
shutil.copy(work / "first" / "summary.json", work / "before" / "checkpoint.h5")
code, text = solve(2, "--again", work / "after")
check("a checkpoint that has changed", (code, "has changed since the run started from it" in text), (3, True))
finish()
