"""The order of collectives (see README.md) sees every planted mismatch, names both places, and lets a right program be.

planted.py --program PROGRAM --mpirun "mpirun ... -x LD_PRELOAD=LIBRARY" --work DIR
"""
import os
import pathlib
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent / "drivers"))
import check_run  # noqa: E402
from harness import arguments, check, command, finish  # noqa: E402

options = arguments("--program")
os.environ["MPI_ORDER_PATIENCE"] = "0.75"
SEEN = 97
CASES = {  # what the message must name
    "function": ["MPI_Allreduce, 8 bytes, SUM", "MPI_Bcast, 8 bytes, root 0", "sumOf", "fromRoot"],
    "size": ["MPI_Allreduce, 8 bytes", "MPI_Allreduce, 16 bytes", "sumOf"],
    "root": ["root 0", "root 1", "fromRoot"],
    "place": ["oneWay", "otherWay"],
    "message": ["no rank has moved", "MPI_Allreduce", "MPI_Recv", "sumOf"],
    "communicators": ["no rank has moved", "MPI_Barrier", "meet"],
}


def run(ranks, case):
    return check_run.run(command(options.program, ranks, case), 60)


for ranks in (2, 5):
    check(f"sound on {ranks} ranks", run(ranks, "sound"), ("", 0))
for case, texts in CASES.items():
    text, code = run(3, case)
    # Open MPI's launcher sometimes hangs when its ranks have ended like this: None.
    check(f"{case}: exit code", code, lambda c: c in (SEEN, None))
    check(f"{case}: the message", text, lambda t: "rank 2" in t and all(part in t for part in texts))
finish()
