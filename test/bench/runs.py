"""Meshes and runs: scenes, numbers of ranks, and results of each run."""
import json
import math
import os
import shutil
import statistics
import subprocess
import sys
import time
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

HERE = Path(__file__).resolve().parent
ROOT = HERE.parent.parent

PLANE, SPACE = ("tunnel", "hertz"), ("press",)

# Mesh source of each scene, and the setting for a given size.
GEOMETRY = {
    "tunnel": ("input/tunnel/tunnel_metis.xml", lambda scale: [f"Mesh/Constants/scale={scale}"]),
    "hertz": ("input/hertz/hertz.xml", lambda resolution: [f"Mesh/Constants/resolution={resolution}"]),
    "press": ("input/press/press.xml", lambda n: [f"Mesh/Boxes/{box}/Cells={{{n}, {n}, {n // 2}}}" for box in ("lower", "upper")]),
}
SIZES = {
    "10k": {"tunnel": 1.0, "hertz": 26},
    "30k": {"press": 20},
    "60k": {"tunnel": 0.4, "hertz": 79},
    "100k": {"tunnel": 0.316, "hertz": 101},
    "110k": {"press": 32},
    "360k": {"press": 48},
    "1M": {"tunnel": 0.1, "hertz": 343, "press": 68},
    "4M": {"tunnel": 0.05, "hertz": 696},
}
# The memory of a 3D factorisation grows with the 4/3 power of the unknowns: 14 to 25 GB and minutes for a million.
WITHOUT_REFERENCE = {("press", "1M")}
# Closed pairs and force of the scene press by n: petsc_gamg.py, and a measurement elsewhere.
PRESS = {20: (181, 1.634890e-3), 32: (441, 1.635129e-3), 48: (991, 1.635860e-3), 68: (1957, 1.635756e-3)}


def fail(message):
    sys.exit(f"bench.py: {message}")


def environment(threads=1):
    """Sets OpenBLAS threads per rank, overriding the environment. One OpenMP thread: more do not speed up CHOLMOD (input/studies/README.md)."""
    fixed = {"OPENBLAS_NUM_THREADS": str(threads), "OMP_NUM_THREADS": "1"}
    return {**os.environ, **fixed, "OMPI_ALLOW_RUN_AS_ROOT": "1", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1"}


def execute(command, threads=1, expected=(0,), extra=None):
    """The output of a command, both streams."""
    done = subprocess.run(command, env={**environment(threads), **(extra or {})}, stdin=subprocess.DEVNULL, capture_output=True, text=True)
    if done.returncode not in expected:
        fail(f"exit code {done.returncode} of: {' '.join(command)}\n{done.stdout[-2000:]}{done.stderr[-4000:]}")
    return done.stdout + done.stderr


def has_mesh(scene, size):
    return scene in SIZES[size]


def mesh_of(scene, size, options):
    source, settings = GEOMETRY[scene]
    value = SIZES[size][scene]
    mesh = options.output / "meshes" / f"{scene}_{value:g}.h5"
    # Another version may number differently.
    made_from = [*(ROOT / source).parent.glob("*.geo"), ROOT / source, options.programs / "suture_partition"]
    if mesh.exists() and all(mesh.stat().st_mtime > file.stat().st_mtime for file in made_from):
        return mesh
    mesh.parent.mkdir(parents=True, exist_ok=True)
    command = [str(options.programs / "suture_partition"), "--no-cut", str(ROOT / source), "--output", str(mesh)]
    for text in settings(value):
        command += ["--set", text]
    text = execute(command)
    print(f"meshed {text.strip()}", flush=True)
    return mesh


def cut_of(scene, mesh, options):
    """The same mesh, partitioned once for all runs by the current program, as a user would who varies a load."""
    cut = mesh.with_name(mesh.stem + "_cut.h5")
    program = options.programs / "suture_partition"
    if not cut.exists() or cut.stat().st_mtime < max(mesh.stat().st_mtime, program.stat().st_mtime):
        execute([str(program), str(HERE / f"{scene}.xml"), "--set", f"Mesh/File={mesh}", "--output", str(cut)])
    return cut


def configurations(scene="tunnel", size="10k", implicit=False):
    """Ranks, threads and settings (other than the mesh) by name."""
    runs = {f"suture_{ranks}": {"ranks": ranks, "set": []} for ranks in (1, 2)}
    # The machine's speed for two processes that never wait for each other: the reference for the gain of two ranks.
    runs["copies_1"] = {"ranks": 1, "copies": 2, "set": []}
    runs["suture_cut_2"] = {"ranks": 2, "cut": True, "set": ["Partition/Type=Partitioned Mesh"]}
    # Linear, all pairs closed, to the final tolerance: ends unconverged before the contact iteration.
    bonded = ["Outer Solver/Maximum Iterations=0", "Outer Solver/Active Set/Inner Tolerance=1e-8"]
    runs["bonded_2"] = {"ranks": 2, "set": bonded, "expected": (0, 4)}
    if implicit:
        runs["implicit_2"] = {"ranks": 2, "set": ["Subdomain/Schur Complement=Implicit"]}
    if (scene, size) in WITHOUT_REFERENCE:
        return runs
    for ordering in ("METIS",) if scene in SPACE else ("AMD", "METIS"):  # AMD has several times more fill-in in 3D
        chosen = ["Outer Solver/Type=Monolithic", f"Outer Solver/Monolithic/Ordering={ordering}", "Partition/METIS/Subdomains=2"]
        for threads in (1, 2):
            runs[f"reference_{ordering.lower()}_{threads}"] = {"ranks": 1, "threads": threads, "set": chosen}
    return runs


def is_reference(name):
    return name.startswith("reference")


def is_bonded(name):
    return name.startswith("bonded")


def command_of(run, scene, mesh, folder, options):
    settings = [f"Mesh/File={cut_of(scene, mesh, options) if run.get('cut') else mesh}"] + run["set"]
    command = ["mpirun", "--oversubscribe", "-np", str(run["ranks"])] if run["ranks"] > 1 else []
    command += [str(options.programs / "suture_solve"), str(HERE / f"{scene}.xml"), "--output", str(folder)]
    for text in settings:
        command += ["--set", text]
    return command


def busy_seconds():
    """Busy seconds of all cores, of all programs."""
    user, nice, system, _, _, irq, softirq, steal = (int(word) for word in Path("/proc/stat").read_text().split("\n")[0].split()[1:9])
    return (user + nice + system + irq + softirq + steal) / os.sysconf("SC_CLK_TCK")


def measure(name, run, scene, size, mesh, options):
    """One run, or the mean of simultaneous copies: seconds, memory and counts, and the load by other programs meanwhile."""
    folders = [options.output / "runs" / (f"{scene}_{size}_{name}" + (f"_{copy + 1}" if copy else "")) for copy in range(run.get("copies", 1))]
    for folder in folders:
        shutil.rmtree(folder, ignore_errors=True)
    commands = [command_of(run, scene, mesh, folder, options) for folder in folders]
    begin, before, own = time.monotonic(), busy_seconds(), sum(os.times()[2:4])
    with ThreadPoolExecutor(len(commands)) as pool:
        list(pool.map(lambda command: execute(command, run.get("threads", 1), run.get("expected", (0,))), commands))
    wall, busy, own = time.monotonic() - begin, busy_seconds() - before, sum(os.times()[2:4]) - own
    summaries = [json.loads((folder / "summary.json").read_text()) for folder in folders]
    summary, command = summaries[0], commands[0]
    seconds = statistics.mean(one["seconds"] for one in summaries)
    phases = {phase: statistics.mean(one["phases"][phase]["max"] for one in summaries) for phase in summary["phases"]}
    return {
        "seconds": seconds,
        # The reference needs no partition: its partitioning time is not counted.
        "charged": seconds - (phases["partition"] if is_reference(name) else 0.0),
        "from_assembled": phases["factor"] + phases["solve"],
        "phases": phases,
        "memory_mb": sum(one["peak_memory_mb"]["sum"] for one in summaries),
        "memory_rank_mb": summary["peak_memory_mb"]["max"],
        "data_mb": summary.get("solver_data_mb", {}).get("sum"),  # read by an iteration; older programs do not report it
        "iteration_seconds": summary["auxiliary"].get("iteration_seconds"),  # nor this
        "energy": summary["energy"],
        "unknowns": summary["dofs"],
        "elements": summary["elements"],
        "pairs": summary["contact"]["pairs"],
        "closed": summary["contact"]["active"],
        "force": sum(math.hypot(*force) for force in summary["contact"]["force"].values()),
        "counts": {
            "outer": summary["outer"]["iterations"],
            "pcg": summary["outer"]["pcg_total"],
            "auxiliary": summary["auxiliary"]["iterations"],
        },
        "wall": wall,
        "cpu_seconds": own,
        "cores_of_others": max(0.0, busy - own) / wall,
        "versions": summary["versions"],
        "command": " ".join(f'"{word}"' if " " in word else word for word in command),
    }


def multigrid(n, options):
    """The scene press by PETSc's smoothed aggregation on two ranks, timed after assembly; None if PETSc is not installed."""
    path = options.output / "runs" / "multigrid.json"
    path.parent.mkdir(parents=True, exist_ok=True)
    path.unlink(missing_ok=True)
    command = ["mpirun", "--oversubscribe", "-np", "2", sys.executable, "-B", str(HERE / "petsc_gamg.py"), str(n), "--json", str(path)]
    text = execute(command, expected=range(256))
    if "No module named 'petsc4py'" in text:
        return None
    if not path.exists():
        fail(f"no result of: {' '.join(command)}\n{text[-4000:]}")
    return json.loads(path.read_text())[0]
