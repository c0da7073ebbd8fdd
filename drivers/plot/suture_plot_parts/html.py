"""Parts of a self-contained web page without network access. The page is also well-formed XML."""
import base64
import html as _html
import io
from pathlib import Path

STYLE = """
:root { --ink: #1d2329; --soft: #59636e; --line: #d5dae0; --good: #00694d; --bad: #b3261e; --warn: #8a5300; --accent: #0b4f9e; }
* { box-sizing: border-box; }
body { margin: 0 auto; max-width: 72rem; padding: 1.5rem 1.25rem 4rem; color: var(--ink); background: #fff;
  font: 16px/1.5 system-ui, "Segoe UI", "DejaVu Sans", sans-serif; overflow-wrap: anywhere; }
h1 { font-size: 1.9rem; line-height: 1.2; margin: 0 0 .25rem; }
h2 { font-size: 1.3rem; margin: 2.6rem 0 .6rem; padding-bottom: .25rem; border-bottom: 2px solid var(--line); }
h3 { font-size: 1.02rem; margin: 1.4rem 0 .4rem; } h2 + h3 { margin-top: .8rem; }
h2.part { font-size: 1.5rem; border-bottom: 4px solid var(--line); margin-top: 3.4rem; }
p { margin: .5rem 0; max-width: 60rem; }
.soft, figcaption, caption { color: var(--soft); font-size: .92rem; }
nav { margin: 1rem 0; font-size: .92rem; line-height: 1.9; } nav a { margin-right: 1rem; color: var(--accent); white-space: nowrap; }
.fields { display: flex; flex-wrap: wrap; gap: .2rem 2rem; margin: .5rem 0; } .fields div { min-width: 7rem; } .fields dt { color: var(--soft); font-size: .86rem; }
.fields dd { margin: 0; font-weight: 600; }
.verdict { border-left: .5rem solid var(--good); background: #eef7f3; padding: .6rem .9rem; margin: 1rem 0; }
.verdict.bad { border-color: var(--bad); background: #fcefee; } .verdict strong { display: block; font-size: 1.15rem; }
.verdict.coarse { border-color: #f0a000; background: #fff6e0; } .verdict.coarse strong { color: var(--warn); }
.verdict.bad strong { color: var(--bad); font-size: 1.35rem; }
.warnings { border-left: .5rem solid #f0a000; background: #fff6e0; padding: .6rem .9rem; margin: 1rem 0; }
.warnings strong { color: var(--warn); } .warnings ul { margin: .2rem 0 0; padding-left: 1.2rem; }
.figures { display: grid; grid-template-columns: repeat(auto-fill, minmax(13rem, 1fr)); gap: .7rem; margin: 1rem 0; padding: 0; }
.figures > div { border: 1px solid var(--line); border-radius: .4rem; padding: .6rem .8rem; }
.figures .name, .figures .where { color: var(--soft); font-size: .86rem; } .figures .value { font-size: 1.3rem; }
.invalid { border: 2px dashed var(--bad); padding: 0 .8rem .6rem; margin: 1rem 0; } .invalid .value { color: var(--bad); text-decoration: line-through; }
.invalid > h2 { border-color: var(--bad); color: var(--bad); }
figure { position: relative; margin: 1rem 0 1.6rem; } figure img { display: block; max-width: 100%; max-height: 50rem; width: auto; height: auto; }
figcaption { margin-top: .3rem; max-width: 60rem; }
.invalid figure::after { content: "NOT A RESULT"; position: absolute; left: 4%; top: 30%; font-size: 3.4rem; font-weight: 800; color: var(--bad); opacity: .35;
  transform: rotate(-18deg); pointer-events: none; white-space: nowrap; }
.wide { overflow-x: auto; margin: .6rem 0 1rem; }
table { border-collapse: collapse; font-size: .92rem; font-variant-numeric: tabular-nums; } caption { text-align: left; padding-bottom: .25rem; }
th, td { text-align: left; vertical-align: top; padding: .26rem 1rem .26rem 0; border-bottom: 1px solid var(--line); overflow-wrap: normal; }
th { font-weight: 600; } td.n, th.n { text-align: right; white-space: nowrap; } td.long { overflow-wrap: anywhere; min-width: 9rem; max-width: 32rem; }
.holds { color: var(--good); font-weight: 600; } .fails { color: var(--bad); font-weight: 700; }
.near { color: var(--warn); font-weight: 700; }
.v { white-space: nowrap; }
.bar { display: block; height: .7rem; min-width: 1px; background: #56b4e9; } td.bars { width: 14rem; min-width: 6rem; }
pre { font-size: .8rem; line-height: 1.4; background: #f5f6f8; padding: .8rem; overflow-x: auto; white-space: pre-wrap; } code { font-size: .9em; }
details > summary { cursor: pointer; color: var(--accent); }
.printed { display: none; }
@media (max-width: 40rem) { body { padding: 1rem .8rem 3rem; font-size: 15px; } h1 { font-size: 1.5rem; }
  table { font-size: .84rem; } th, td { padding-right: .6rem; } td.long { min-width: 5.5rem; } .invalid figure::after { font-size: 1.8rem; } }
@media print {
  body { max-width: none; padding: 0; font-size: 8.5pt; line-height: 1.35; } nav, .screen, details { display: none; } .printed { display: block; }
  h1 { font-size: 15pt; } h2 { font-size: 11.5pt; margin: 4mm 0 1mm; } h2.part { font-size: 13pt; margin-top: 6mm; } h3 { font-size: 9.5pt; margin: 2.5mm 0 .5mm; }
  h2, h3, caption, thead { break-after: avoid; } p { margin: 1mm 0; orphans: 3; widows: 3; } .verdict, .warnings { padding: 1.5mm 2.5mm; margin: 2mm 0; }
  .verdict strong, .verdict.bad strong { font-size: 10.5pt; } .fields dt, .figures .name, .figures .where { font-size: 7.5pt; }
  tr, figure, .verdict, .warnings, .figures, .keep { break-inside: avoid; } .soft, figcaption, caption { font-size: 7.5pt; }
  .figures { grid-template-columns: repeat(auto-fit, minmax(32mm, 1fr)); gap: 2mm; margin: 2mm 0; } .figures > div { padding: 1.5mm 2mm; }
  .figures .value { font-size: 10.5pt; }
  figure { margin: 1mm 0 3mm; } figure img { max-height: 104mm; max-width: 100%; margin: 0 auto; }
  #error, #convergence, #cost, #provenance { display: inline-block; width: 48%; vertical-align: top; } #convergence, #provenance { margin-left: 2.5%; }
  #cost table, #provenance table, #convergence li { font-size: 7pt; } #checks th:nth-child(5), #checks td:nth-child(5) { display: none; } #checks td:nth-child(2) { width: 56mm; }
  #checks td.long { width: 70mm; max-width: 70mm; } main { orphans: 1; widows: 1; } table.short { break-inside: avoid; }
  table { font-size: 7.5pt; width: 100%; } th, td { padding: .3mm 2mm .3mm 0; line-height: 1.25; } ul { margin: 1mm 0; padding-left: 4mm; } td.long { min-width: 15mm; max-width: 70mm; } .wide { overflow: visible; margin: 1mm 0 2mm; }
  table.cut tbody tr:nth-child(n+25) { display: none; } td.bars { display: none; } .bars { display: none; } .invalid figure::after { font-size: 20pt; }
  * { print-color-adjust: exact; -webkit-print-color-adjust: exact; }
  @page { size: A4; margin: 13mm 13mm 14mm; @bottom-right { content: counter(page) " / " counter(pages); font: 8pt sans-serif; color: #59636e; } }
}
"""
# Browsers enforce that the page loads nothing from anywhere.
POLICY = "default-src 'none'; img-src data:; style-src 'unsafe-inline'; script-src 'unsafe-inline'"
SHORT = 8  # rows of a table that is not broken over pages
MOST_PRINTED = 24  # rows of a table on paper; all are on the screen, and in the files of the run


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
    text = f"{value:,}" if isinstance(value, int) else plain(value, form) if value else "0"
    return f'<data value="{value!r}">{text.replace("-", chr(0x2212), 1) if text.startswith("-") else text}</data>' + (f" {esc(unit)}" if unit else "")


def plain(value, form):
    """The text of a number; large numbers have thousands separators instead of an exponent."""
    text = f"{value:{form}}"
    return f"{float(text):,.0f}" if form == ".4g" and 1e4 <= abs(float(text)) < 1e7 else text


def vector(values, unit=""):
    """A vector (1, 2) with units; "none" if there are no values."""
    if values is None:
        return '<span class="soft">none</span>'
    listed = ", ".join(number(value) for value in values)
    return (listed if len(values) == 1 else f'<span class="v">({listed})</span>') + (f" {esc(unit)}" if unit else "")


def table(head, rows, caption="", numeric=(), long=(), key=""):
    """Cells are already markup. `numeric`, `long`: indices of columns that are right-aligned, and that may break within words; `key`: id"""
    def kind(i):
        return ' class="n"' if i in numeric else ' class="long"' if i in long else ""

    top = "".join(f"<th{kind(i)}>{esc(name)}</th>" for i, name in enumerate(head))
    body = "".join("<tr>" + "".join(f"<td{kind(i)}>{cell}</td>" for i, cell in enumerate(row)) + "</tr>\n" for row in rows)
    said = f"<caption>{esc(caption)}</caption>" if caption else ""
    first = f"<thead><tr>{top}</tr></thead>" if any(head) else ""
    more = len(rows) - MOST_PRINTED
    left_out = f'<p class="soft printed">{number(more)} more row{"s" if more > 1 else ""}: on the screen.</p>' if more > 0 else ""
    marks = (f' id="{key}"' if key else "") + (' class="cut"' if more > 0 else ' class="short"' if len(rows) <= SHORT else "")
    return f'<div class="wide"><table{marks}>{said}{first}<tbody>\n{body}</tbody></table>{left_out}</div>\n'


def embedded(path, compress):
    """(type, base64) of an image file: as it is, or a PNG file in lossless WebP, which needs half the space and 0.5 s."""
    if not compress or Path(path).suffix != ".png":
        return Path(path).suffix[1:], base64.b64encode(Path(path).read_bytes()).decode()
    from PIL import Image
    small = io.BytesIO()
    with Image.open(path) as image:
        image.convert("RGB").save(small, "WEBP", lossless=True, method=1)
    return "webp", base64.b64encode(small.getvalue()).decode()


def figure(picture, title, kind="", compress=False):
    """`kind`: class of the element, such as screen for a picture that is not printed; `compress`: see embedded()"""
    form, data = embedded(picture.path, compress)
    own = f' class="{kind}"' if kind else ""
    return (f'<figure id="picture_{esc(picture.name)}"{own}><img src="data:image/{form};base64,{data}" alt="{esc(title)}: {esc(picture.name.replace("_", " "))}"/>'
            f"<figcaption>{esc(picture.caption)}</figcaption></figure>\n")


def section(key, heading, markup, kind="", level=""):
    """A section of the page. `kind`, `level`: classes of the section and of its heading"""
    own, of_heading = (f' class="{name}"' if name else "" for name in (kind, level))
    return f'<section id="{key}"{own}><h2{of_heading}>{esc(heading)}</h2>\n{markup}</section>\n'


def page(title, header, sections):
    """`sections`: [(id, heading, markup, class of the section, class of the heading)], the classes may be left out"""
    links = "".join(f'<a href="#{key}">{esc(heading)}</a> ' for key, heading, *_ in sections)
    body = "".join(section(*parts) for parts in sections)
    return ('<!DOCTYPE html>\n<html lang="en">\n<head><meta charset="utf-8"/>'
            f'<meta http-equiv="Content-Security-Policy" content="{POLICY}"/>'
            f'<title>{esc(title)}</title><meta name="viewport" content="width=device-width, initial-scale=1"/>\n<style>{STYLE}</style></head>\n'
            f"<body>\n<header>{header}</header>\n<nav>{links}</nav>\n<main>\n{body}</main>\n</body>\n</html>\n")
