#!/usr/bin/python3
"""The documentation is rendered to HTML with valid links; faults planted in pages, one at a time, are found. render_doc.py SOURCE FOLDER"""
import pathlib
import shutil
import subprocess
import sys

source, folder = pathlib.Path(sys.argv[1]), pathlib.Path(sys.argv[2])
check = pathlib.Path(__file__).with_name("check_html.py")
failed = False


def run(*command):
    done = subprocess.run([sys.executable, "-B", *map(str, command)], capture_output=True, text=True, timeout=60)
    return done.returncode, done.stdout + done.stderr


def expect(wanted, code, said):
    global failed
    if code != (0 if wanted is None else 1) or (wanted and wanted not in said):
        print(f"wanted: {wanted or 'no problem'}\nexit code {code}, said: {said}")
        failed = True


expect(None, *run(source / "doc/html/render.py", folder / "html", source))
code, said = run(check, folder / "html")
print(said)
expect(None, code, said)

SOUND = {"index.html": '<h2 id="a">A</h2><a href="b/page.html#c">b</a>', "b/page.html": '<h2 id="c">C</h2><a href="../index.html#a">a</a>'}
PLANTED = [({}, None), ({"b/page.html": "<p>no part</p>"}, "index.html: b/page.html has no part #c"),
           ({"index.html": '<a href="b/page.html">b</a><a href="gone.html">x</a>'}, "index.html: the link gone.html leads to no file"),
           ({"index.html": '<h2 id="a">A</h2>'}, "b/page.html: index.html does not lead here"),
           ({"b/page.html": '<p id="c"></p><img src="https://localhost/x.png">'}, "b/page.html: https://localhost/x.png comes from a network")]
for changed, wanted in PLANTED:
    shutil.rmtree(folder / "planted", ignore_errors=True)
    for name, text in {**SOUND, **changed}.items():
        (folder / "planted" / name).parent.mkdir(parents=True, exist_ok=True)
        (folder / "planted" / name).write_text(text)
    expect(wanted, *run(check, folder / "planted"))
sys.exit(failed)
