"""The mesh of a geometry is kept for later runs (SUTURE_MESH_CACHE, Mesh/Cache): the same results with and without it, on any number of ranks,
from several processes at once, with damaged files and without a folder.

mesh_cache.py --solve PROGRAM --mpirun "mpirun ..." --work DIR --input FOLDER
"""
import json
import os
import pathlib
import resource
import subprocess

import harness
from harness import SLOWER, arguments, check, finish, setting

options = arguments("--solve", "--input")
BRACKET = pathlib.Path(options.input) / "bracket" / "bracket.xml"
home, folder = options.work / "home", options.work / "meshes"
home.mkdir()
BARE = {name: value for name, value in os.environ.items() if name not in ("SUTURE_MESH_CACHE", "XDG_CACHE_HOME")}


def solve(name, *words, ranks=1, **environment):
    """Exit code, mesh and energy of a run, and its processor time."""
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    done = subprocess.run(harness.command(options.solve, ranks, BRACKET, "--quiet", "--output", options.work / name, *words), capture_output=True,
                          text=True, timeout=120 * SLOWER, env={**BARE, "HOME": str(home), **environment})
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    summary = json.loads((options.work / name / "summary.json").read_text()) if done.returncode == 0 else {}
    return (done.returncode, done.stderr, summary.get("mesh_hash"), summary.get("energy")), after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime


def kept(where=folder):
    return sorted(path.name for path in where.glob("*")) if where.exists() else []


own = {"SUTURE_MESH_CACHE": str(folder)}
expected, without = solve("without", SUTURE_MESH_CACHE="off")
check("a run without a cache", (expected[0], kept(home / ".cache"), kept()), (0, [], []))
check("Mesh/Cache = false", (solve("no_cache", *setting("Mesh/Cache", "false"), **own)[0], kept()), (expected, []))
first, _ = solve("first", **own)
check("the first run stores the mesh", (first, len(kept())), (expected, 1))
times = []
for again in range(2):
    second, seconds = solve(f"second_{again}", **own)
    times.append(seconds)
    check("a later run is the same", second, expected)
check("a later run does not start Gmsh", min(times) / without, lambda part: part < 0.6)
check("two ranks", (solve("two", ranks=2, **own)[0][:3], len(kept())), (expected[:3], 1))
check("another load has the same mesh", (solve("load", *setting("Boundary Conditions/load/Value", "{0, -6}"), **own)[0][2], len(kept())), (expected[2], 1))
check("another size has another one", (solve("size", *setting("Mesh/Mesh Size Factor", "2"), **own)[0][2] != expected[2], len(kept())), (True, 2))

# Damaged, and several at once.
for name in kept():
    content = bytearray((folder / name).read_bytes())
    content[len(content) // 2] ^= 1
    (folder / name).write_bytes(content)
check("a damaged file", solve("damaged", **own)[0], expected)
check("it is replaced", solve("replaced", **own)[1] / without, lambda part: part < 0.6)
for name in kept():
    (folder / name).unlink()
processes = [subprocess.Popen(harness.command(options.solve, 1, BRACKET, "--quiet", "--output", options.work / f"at_once_{k}"), env={**BARE, **own},
                              stderr=subprocess.PIPE, text=True) for k in range(4)]
ends = [(process.communicate(timeout=240 * SLOWER)[1], process.returncode) for process in processes]
meshes = {json.loads((options.work / f"at_once_{k}" / "summary.json").read_text())["mesh_hash"] for k in range(4)}
check("four runs at once", (ends, meshes, len(kept())), ([("", 0)] * 4, {expected[2]}, 1))

# Folders: below the home, and one that cannot be made.
check("the default folder", (solve("home")[0], len(kept(home / ".cache" / "suture" / "meshes"))), (expected, 1))
(options.work / "file").write_text("in the way")
check("no folder can be made", solve("in_the_way", SUTURE_MESH_CACHE=str(options.work / "file" / "below"))[0], expected)
finish()
