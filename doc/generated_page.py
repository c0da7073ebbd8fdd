"""Pages that a program prints: the frame of the scripts parameters.py and materials_list.py, SCRIPT SUTURE_SCHEMA [--check]."""
import difflib
import pathlib
import subprocess
import sys


def markdown(*options):
    """What suture_schema prints with these options."""
    return subprocess.run([sys.argv[1], *options, "--format", "markdown"], capture_output=True, text=True, check=True).stdout


def show_or_check(script, page):
    """Prints the page, or with --check compares it with the file beside the script. Returns the exit code."""
    if "--check" not in sys.argv:
        sys.stdout.write(page)
        return 0
    file = pathlib.Path(script).with_suffix(".md")
    name = f"doc/{file.name}"
    difference = list(difflib.unified_diff(file.read_text().splitlines(), page.splitlines(), name, "suture_schema", lineterm=""))
    if difference:
        print("\n".join(difference))
        print(f"{name} differs from the output of suture_schema; renew it: python3 doc/{pathlib.Path(script).name} build/drivers/suture_schema > {name}")
    return 1 if difference else 0
