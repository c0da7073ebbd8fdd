#!/usr/bin/python3
"""The documentation as HTML, by cmark-gfm (Debian's package of that name) and no network.

render.py OUT [ROOT]: writes into OUT, which is emptied, the page doc/README.md as index.html and every page and file of the repository that
it leads to, in the folders where they stand there. A README.md becomes index.html (the first one: overview.html), X.md X.html, a source
X.hpp the page X.hpp.html; pictures are copied. Links to folders lead to their README.md.
"""
import html
import pathlib
import re
import shutil
import subprocess
import sys

PICTURES = {".png", ".svg", ".jpg", ".gif"}
PAGE = """<!DOCTYPE html>
<html lang="en">
<head>
<meta charset="utf-8">
<meta name="viewport" content="width=device-width, initial-scale=1">
<title>{title}</title>
<link rel="stylesheet" href="{up}style.css">
</head>
<body>
<nav>
{navigation}
</nav>
<main>
{body}
<footer>{source}</footer>
</main>
</body>
</html>
"""


def slug(heading, taken):
    """Name of a heading, as Markdown pages on the web make it: a second one of the same words gets -1."""
    name = re.sub(r"\s", "-", re.sub(r"[^\w\s-]", "", heading.lower().strip()))
    taken[name] = taken.get(name, -1) + 1
    return name if taken[name] == 0 else f"{name}-{taken[name]}"


def converted(text):
    """HTML of a Markdown text, with a name for each heading."""
    command = ["cmark-gfm", "--extension", "table", "--extension", "strikethrough"]
    done = subprocess.run(command, input=text, capture_output=True, text=True, check=True)
    taken = {}

    def named(found):
        words = html.unescape(re.sub(r"<[^>]+>", "", found[2]))
        return f'<h{found[1]} id="{slug(words, taken)}">{found[2]}</h{found[1]}>'

    text = re.sub(r"<!-- raw HTML omitted -->\n?", "", done.stdout)
    text = re.sub(r"<table>.*?</table>", r'<div class="wide">\g<0></div>', text, flags=re.S)
    return re.sub(r"<h([1-6])>(.*?)</h\1>", named, text, flags=re.S)


class Site:
    def __init__(self, root, out):
        self.root, self.out = root, out
        self.front = root / "doc" / "README.md"
        self.wanted = [self.front] + sorted((root / "doc").rglob("*.md")) + [root / "README.md"]
        self.problems = []

    def place(self, file):
        """Path in OUT of what is made of a file."""
        inside = file.relative_to(self.root)
        if file == self.front:
            return pathlib.Path("index.html")
        if file == self.root / "README.md":
            return pathlib.Path("overview.html")
        if file.name == "README.md":
            return inside.with_name("index.html")
        if file.suffix == ".md":
            return inside.with_suffix(".html")
        return inside if file.suffix in PICTURES else inside.with_name(inside.name + ".html")

    def target(self, link, page, place):
        """Link of a page, as a link of what is made of it at `place`."""
        if re.match(r"[a-z]+:", link) or link.startswith("#"):
            return link
        path, _, part = link.partition("#")
        file = (page.parent / path).resolve()
        if file.is_dir():
            file /= "README.md"
        if not file.is_file() or self.root not in file.parents:
            self.problems.append(f"{page.relative_to(self.root)}: the link {link} leads to no file")
            return link
        self.wanted.append(file)
        up = "../" * (len(place.parts) - 1)
        return up + self.place(file).as_posix() + ("#" + part if part else "")

    def linked(self, text, page, place):
        def replaced(found):
            return f'{found[1]}="{html.escape(self.target(html.unescape(found[2]), page, place))}"'
        return re.sub(r'\b(href|src)="([^"]*)"', replaced, text)

    def navigation(self, place):
        """Headings and links of the front page, on every page."""
        text = self.front.read_text()
        lines = []
        for line in text.splitlines():
            if line.startswith("## "):
                lines += ["", f"**{line[3:]}**", ""]
            for label, link in re.findall(r"^(?:- |\| )\[([^\]]+)\]\(([^)]+)\)", line):
                lines.append(f"- [{label}]({link})")
        top = f'<p><a href="{"../" * (len(place.parts) - 1)}index.html"><strong>Suture</strong></a></p>\n'
        return top + self.linked(converted("\n".join(lines)), self.front, place)

    def write(self, file):
        place = self.place(file)
        goal = self.out / place
        goal.parent.mkdir(parents=True, exist_ok=True)
        if file.suffix in PICTURES:
            shutil.copyfile(file, goal)
            return
        text = file.read_text()
        inside = file.relative_to(self.root)
        if file.suffix == ".md":
            body = self.linked(converted(text), file, place)
            heading = re.search(r"^# (.+)$", text, re.M)
            title = heading[1] if heading else str(inside)
        else:
            title = str(inside)
            body = f"<h1>{html.escape(file.name)}</h1>\n<pre><code>{html.escape(text)}</code></pre>"
        goal.write_text(PAGE.format(title=html.escape(title), up="../" * (len(place.parts) - 1), navigation=self.navigation(place), body=body,
                                    source=html.escape(str(inside))))

    def make(self):
        done = set()
        while self.wanted:
            file = self.wanted.pop()
            if file not in done:
                done.add(file)
                self.write(file)
        shutil.copyfile(pathlib.Path(__file__).with_name("style.css"), self.out / "style.css")
        return len(done)


def main():
    out = pathlib.Path(sys.argv[1])
    root = pathlib.Path(sys.argv[2] if len(sys.argv) > 2 else pathlib.Path(__file__).parents[2]).resolve()
    if not shutil.which("cmark-gfm"):
        print("render.py: there is no cmark-gfm; Debian: apt-get install cmark-gfm", file=sys.stderr)
        return 5
    shutil.rmtree(out, ignore_errors=True)
    out.mkdir(parents=True)
    site = Site(root, out)
    count = site.make()
    for problem in sorted(set(site.problems)):
        print(problem, file=sys.stderr)
    print(f"{count} pages and pictures; begin with {out}/index.html")
    return 1 if site.problems else 0


if __name__ == "__main__":
    sys.exit(main())
