"""Turns that are planted in a small tree are found by check_words.py, each with its place; plain text is not. planted_words.py SCRIPT WORK"""
import pathlib
import shutil
import subprocess
import sys

script, work = sys.argv[1], pathlib.Path(sys.argv[2])
failed = False


def check(name, file, text, wanted):
    global failed
    shutil.rmtree(work, ignore_errors=True)
    path = work / file
    path.parent.mkdir(parents=True)
    path.write_text(text)
    done = subprocess.run([sys.executable, "-B", script, str(work)], capture_output=True, text=True, timeout=60)
    if (done.returncode, wanted in done.stdout) != (1 if wanted != "0 turns found" else 0, True):
        print(f"{name}: wanted {wanted!r}, exit code {done.returncode}, printed {done.stdout!r}")
        failed = True


check("a plain page", "README.md", "One row per pair, in 3D, except for obstacles.\n", "0 turns found")
check("a page", "README.md", "A row a pair.\n", 'README.md:1: "row a pair": write per, for each')
check("over two lines", "doc/x.md", "Bodies in\nspace.\n", 'doc/x.md:1: "in space": write 3D, in 3D')
check("code on a page", "doc/x.md", "```\nin space\n```\n", "0 turns found")
check("a header's comment", "packages/a/A.hpp", "/// Of each node.\nint a;\n", 'packages/a/A.hpp:1: "Of": write subject first')
check("a comment over two lines", "packages/a/A.hpp", "// forces of\n// their own\nint a;\n", "of their own")
check("a message", "packages/a/A.cpp", 'throw Error("the scene asks for it");\n', 'packages/a/A.cpp:1: "asks for": write requests')
check("a source's comment", "packages/a/A.cpp", "// in space\nint a;\n", "0 turns found")
check("a docstring", "python/a.py", '"""What is told."""\n', 'python/a.py:1: "told": write reports')
sys.exit(failed)
