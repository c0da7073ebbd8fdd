#!/usr/bin/python3
"""Links of a folder of HTML pages. check_html.py FOLDER: prints, and fails for,
- links and pictures with a missing file or a missing fragment #...,
- pages not reachable from index.html, and pictures, styles or scripts from a network.
"""
import html.parser
import pathlib
import sys
import urllib.parse


class Page(html.parser.HTMLParser):
    def __init__(self, text):
        super().__init__()
        self.names, self.links, self.resources = set(), [], []
        self.feed(text)

    def handle_starttag(self, tag, attributes):
        values = dict(attributes)
        if "id" in values:
            self.names.add(values["id"])
        if tag == "a" and "href" in values:
            self.links.append(values["href"])
        for key in ("src", "href"):
            if tag != "a" and key in values:
                self.resources.append(values[key])


def main():
    folder = pathlib.Path(sys.argv[1]).resolve()
    pages = {file: Page(file.read_text()) for file in sorted(folder.rglob("*.html"))}
    problems, leads = [], {file: set() for file in pages}
    for file, page in pages.items():
        here = file.relative_to(folder)
        for link in page.links + page.resources:
            if urllib.parse.urlparse(link).scheme:
                if link in page.resources:
                    problems.append(f"{here}: {link} comes from a network")
                continue
            path, _, part = link.partition("#")
            goal = (file.parent / urllib.parse.unquote(path)).resolve() if path else file
            if not goal.is_file() or folder not in goal.parents:
                problems.append(f"{here}: the link {link} leads to no file")
            elif part and part not in pages[goal].names:
                problems.append(f"{here}: {goal.relative_to(folder)} has no part #{part}")
            elif goal in pages:
                leads[file].add(goal)
    reached, open_ = set(), [folder / "index.html"]
    while open_:
        file = open_.pop()
        if file in pages and file not in reached:
            reached.add(file)
            open_ += leads[file]
    problems += [f"{file.relative_to(folder)}: index.html does not lead here" for file in pages if file not in reached]
    print("\n".join(problems) or f"{len(pages)} pages, {sum(len(page.links) for page in pages.values())} links")
    return 1 if problems or not pages else 0


if __name__ == "__main__":
    sys.exit(main())
