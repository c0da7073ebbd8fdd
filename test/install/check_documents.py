#!/usr/bin/python3
"""The installed documents.

check_documents.py PREFIX --source ROOT: prints, and fails for,
- relative links of installed Markdown files to missing files, out of PREFIX, or to a missing heading;
- files of the guide, the scenes and the examples in the checkout that are not installed;
- paths "$SUTURE/..." in commands of the guide that do not exist below PREFIX/share/suture.
"""
import argparse
import pathlib
import re
import subprocess
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent / "doc"))
import check_doc  # noqa: E402

# Tools for building the documents.
NOT_INSTALLED = {"doc/Doxyfile", "doc/parameters.py", "doc/materials_list.py", "doc/generated_page.py", "doc/html/render.py", "doc/html/style.css"}


def outside(prefix):
    """Links of installed pages that leave the installation."""
    problems = []
    for page in sorted(prefix.rglob("*.md")):
        for target in re.findall(r"\]\(([^)#\s]+)", page.read_text()):
            place = (page.parent / target).resolve()
            if not re.match(r"[a-z]+:", target) and place.exists() and prefix not in place.parents:
                problems.append(f"{page.relative_to(prefix)}: {target} leads out of the installation, to {place}")
    return problems


def missing(prefix, source):
    """Files of the checkout that must be in share/suture."""
    files = subprocess.run(["git", "-C", source, "ls-files", "doc", "input", "drivers/examples"], stdout=subprocess.PIPE, text=True).stdout.split()
    if not files:  # not a checkout
        files = [str(file.relative_to(source)) for file in source.glob("input/*/*.xml")]
    share = prefix / "share" / "suture"
    return [f"{file} is not installed" for file in files if file not in NOT_INSTALLED and (source / file).exists() and not (share / file).is_file()]


def commands(prefix):
    """Paths below $SUTURE in the guide's commands."""
    share, problems, paths = prefix / "share" / "suture", [], 0
    for page in sorted((prefix / "share/doc/suture/doc").rglob("*.md")):
        for path in re.findall(r'\$SUTURE/([\w./-]+)', page.read_text()):
            paths += 1
            if not path.startswith("build/") and not (share / path).exists():  # build results are installed elsewhere
                problems.append(f"{page.relative_to(prefix)}: $SUTURE/{path} does not exist in share/suture")
    return problems if paths > 20 else problems + [f"the installed guide has {paths} paths $SUTURE/..., more were expected"]


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("prefix", type=pathlib.Path)
    parser.add_argument("--source", type=pathlib.Path, required=True)
    options = parser.parse_args()
    prefix, source = options.prefix.resolve(), options.source.resolve()
    pages = list(prefix.rglob("*.md"))
    problems = check_doc.checkLinks(prefix) + outside(prefix) + missing(prefix, source) + commands(prefix)
    if len(pages) < 80:
        problems.append(f"only {len(pages)} Markdown files are installed")
    for problem in problems:
        print(problem)
    return 1 if problems else 0


if __name__ == "__main__":
    sys.exit(main())
