"""Parts of a self-contained web page without network access or scripts. The page is also well-formed XML."""
import base64
import html as _html
from pathlib import Path

STYLE = """
:root { --ink: #1d2329; --soft: #59636e; --line: #d5dae0; --good: #00694d; --bad: #b3261e; --accent: #0b4f9e; }
* { box-sizing: border-box; }
body { margin: 0 auto; max-width: 72rem; padding: 1.5rem 1.25rem 4rem; color: var(--ink); background: #fff;
  font: 16px/1.5 system-ui, "Segoe UI", "DejaVu Sans", sans-serif; overflow-wrap: anywhere; }
h1 { font-size: 1.9rem; line-height: 1.2; margin: 0 0 .25rem; }
h2 { font-size: 1.3rem; margin: 2.6rem 0 .6rem; padding-bottom: .25rem; border-bottom: 2px solid var(--line); }
h3 { font-size: 1.02rem; margin: 1.4rem 0 .4rem; }
p { margin: .5rem 0; max-width: 60rem; }
.soft, figcaption, caption { color: var(--soft); font-size: .92rem; }
nav { margin: 1rem 0; font-size: .92rem; line-height: 1.9; } nav a { margin-right: 1rem; color: var(--accent); white-space: nowrap; }
.verdict { border-left: .5rem solid var(--good); background: #eef7f3; padding: .6rem .9rem; margin: 1rem 0; }
.verdict.bad { border-color: var(--bad); background: #fcefee; } .verdict strong { display: block; font-size: 1.15rem; }
.figures { display: grid; grid-template-columns: repeat(auto-fill, minmax(13rem, 1fr)); gap: .7rem; margin: 1rem 0; padding: 0; }
.figures > div { border: 1px solid var(--line); border-radius: .4rem; padding: .6rem .8rem; }
.figures .name, .figures .where { color: var(--soft); font-size: .86rem; } .figures .value { font-size: 1.3rem; }
figure { margin: 1rem 0 1.6rem; } figure img { display: block; max-width: 100%; max-height: 50rem; width: auto; height: auto; } figcaption { margin-top: .3rem; max-width: 60rem; }
.wide { overflow-x: auto; margin: .6rem 0 1rem; }
table { border-collapse: collapse; font-size: .92rem; font-variant-numeric: tabular-nums; } caption { text-align: left; padding-bottom: .25rem; }
th, td { text-align: left; vertical-align: top; padding: .26rem 1rem .26rem 0; border-bottom: 1px solid var(--line); overflow-wrap: normal; }
th { font-weight: 600; } td.n, th.n { text-align: right; white-space: nowrap; } td.long { overflow-wrap: anywhere; min-width: 9rem; max-width: 32rem; }
.holds { color: var(--good); font-weight: 600; } .fails { color: var(--bad); font-weight: 700; }
.bar { display: block; height: .7rem; min-width: 1px; background: #56b4e9; } td.bars { width: 14rem; min-width: 6rem; }
pre { font-size: .8rem; line-height: 1.4; background: #f5f6f8; padding: .8rem; overflow-x: auto; white-space: pre-wrap; } code { font-size: .9em; }
details > summary { cursor: pointer; color: var(--accent); }
@media (max-width: 40rem) { body { padding: 1rem .8rem 3rem; font-size: 15px; } h1 { font-size: 1.5rem; }
  table { font-size: .84rem; } th, td { padding-right: .6rem; } td.long { min-width: 5.5rem; } }
@media print {
  body { max-width: none; padding: 0; font-size: 10pt; } nav { display: none; } h2, h3 { break-after: avoid; } h2 { margin-top: 1.4rem; }
  figure, tr, .verdict, .figures > div { break-inside: avoid; } figure img { max-height: 11cm; width: auto; }
  table { font-size: 8pt; } th, td { padding-right: .7rem; } .wide { overflow: visible; }
  * { print-color-adjust: exact; -webkit-print-color-adjust: exact; } @page { margin: 16mm 14mm; }
}
"""


def esc(text):
    """Escaped text. Control characters, which are not allowed in a page, are replaced."""
    clean = "".join(c if c in "\n\t" or ord(c) >= 32 else "\ufffd" for c in str(text))
    return _html.escape(clean)


def number(value, unit="", form=".4g"):
    """A number for readers, with all its digits for programs; null of summary.json is written in words."""
    if value is None:
        return '<span class="soft">not finite</span>'
    if isinstance(value, bool) or not isinstance(value, (int, float)):
        return esc(value)
    text = f"{value:,}" if isinstance(value, int) else f"{value:{form}}" if value else "0"
    return f'<data value="{value!r}">{text.replace("-", chr(0x2212), 1) if text.startswith("-") else text}</data>' + (f" {esc(unit)}" if unit else "")


def vector(values, unit=""):
    """A vector (1, 2) with units; "none" if there are no values."""
    if values is None:
        return '<span class="soft">none</span>'
    listed = ", ".join(number(value) for value in values)
    return (listed if len(values) == 1 else f"({listed})") + (f" {esc(unit)}" if unit else "")


def table(head, rows, caption="", numeric=(), long=()):
    """Cells are already markup. `numeric`, `long`: indices of columns that are right-aligned, and that may break within words."""
    def kind(i):
        return ' class="n"' if i in numeric else ' class="long"' if i in long else ""

    top = "".join(f"<th{kind(i)}>{esc(name)}</th>" for i, name in enumerate(head))
    body = "".join("<tr>" + "".join(f"<td{kind(i)}>{cell}</td>" for i, cell in enumerate(row)) + "</tr>\n" for row in rows)
    said = f"<caption>{esc(caption)}</caption>" if caption else ""
    first = f"<thead><tr>{top}</tr></thead>" if any(head) else ""
    return f'<div class="wide"><table>{said}{first}<tbody>\n{body}</tbody></table></div>\n'


def embedded(path):
    """The image file as it is, in full colour."""
    return base64.b64encode(Path(path).read_bytes()).decode()


def figure(picture, title):
    data = embedded(picture.path)
    return (f'<figure id="picture_{esc(picture.name)}"><img src="data:image/png;base64,{data}" alt="{esc(title)}: {esc(picture.name.replace("_", " "))}"/>'
            f"<figcaption>{esc(picture.caption)}</figcaption></figure>\n")


def page(title, header, sections):
    """`sections`: [(id, heading, markup)]"""
    links = "".join(f'<a href="#{key}">{esc(heading)}</a> ' for key, heading, _ in sections)
    body = "".join(f'<section id="{key}"><h2>{esc(heading)}</h2>\n{markup}</section>\n' for key, heading, markup in sections)
    return ('<!DOCTYPE html>\n<html lang="en">\n<head><meta charset="utf-8"/>'
            f'<title>{esc(title)}</title><meta name="viewport" content="width=device-width, initial-scale=1"/>\n<style>{STYLE}</style></head>\n'
            f"<body>\n<header>{header}</header>\n<nav>{links}</nav>\n<main>\n{body}</main>\n</body>\n</html>\n")
