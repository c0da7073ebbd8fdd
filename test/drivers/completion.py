"""Bash completion: options from --help, values of options, files. completion.py --script FILE --drivers FOLDER"""
import argparse
import os
import subprocess
import sys

parser = argparse.ArgumentParser()
parser.add_argument("--script", required=True)
parser.add_argument("--drivers", required=True)
options = parser.parse_args()
failures = []


def completed(*words):
    text = f"""source {options.script}
COMP_WORDS=({' '.join("'" + word + "'" for word in words)}); COMP_CWORD={len(words) - 1}; _suture; printf '%s\\n' "${{COMPREPLY[@]}}" """
    environment = {**os.environ, "PATH": f"{options.drivers}:{os.environ['PATH']}"}
    done = subprocess.run(["bash", "-c", text], capture_output=True, text=True, env=environment, cwd=os.path.dirname(options.script))
    return done.stdout.split()


def expect(words, found):
    if (was := completed(*words)) != found:
        failures.append(f"{words}: {was}, expected {found}")


expect(("suture_solve", "--qu"), ["--quiet"])
expect(("suture_solve", "scene.xml", "--re"), ["--restart"])
expect(("suture_solve", "--ag"), ["--again"])
expect(("suture_solve", "--again", "sut"), ["suture.bash"])
expect(("suture_partition", "--no"), ["--no-cut"])
expect(("suture_schema", "--format", "m"), ["markdown"])
expect(("suture_schema", "--format", ""), ["text", "xml", "markdown"])
expect(("suture_plot", "--an"), ["--animation"])
expect(("suture_solve", "sut"), ["suture.bash"])
expect(("suture_solve", "--output", "sut"), ["suture.bash"])
if "--set" not in completed("suture_study", "--"):
    failures.append("suture_study does not offer --set")
sys.exit("\n".join(failures) if failures else 0)
