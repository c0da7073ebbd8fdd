"""The WebGL library of the interactive view: three.js as Debian packages it (libjs-three), in the form of classic scripts."""
import os
import re
from pathlib import Path

FOLDERS = ("/usr/share/javascript/three", "/usr/share/nodejs/three")
PARTS = (("three.min.js", "build/three.min.js", "three.js", "build/three.js"), ("examples/js/controls/OrbitControls.js",))
LICENCE = """Copyright \u00a9 2010-2019 three.js authors

Permission is hereby granted, free of charge, to any person obtaining a copy of this software and associated documentation files (the
"Software"), to deal in the Software without restriction, including without limitation the rights to use, copy, modify, merge, publish,
distribute, sublicense, and/or sell copies of the Software, and to permit persons to whom the Software is furnished to do so, subject to
the following conditions:

The above copyright notice and this permission notice shall be included in all copies or substantial portions of the Software.

THE SOFTWARE IS PROVIDED "AS IS", WITHOUT WARRANTY OF ANY KIND, EXPRESS OR IMPLIED, INCLUDING BUT NOT LIMITED TO THE WARRANTIES OF
MERCHANTABILITY, FITNESS FOR A PARTICULAR PURPOSE AND NONINFRINGEMENT. IN NO EVENT SHALL THE AUTHORS OR COPYRIGHT HOLDERS BE LIABLE FOR
ANY CLAIM, DAMAGES OR OTHER LIABILITY, WHETHER IN AN ACTION OF CONTRACT, TORT OR OTHERWISE, ARISING FROM, OUT OF OR IN CONNECTION WITH THE
SOFTWARE OR THE USE OR OTHER DEALINGS IN THE SOFTWARE."""


def library():
    """(revision, text of the scripts), or None if the library is not installed. SUTURE_THREE names another folder with three.js."""
    own = os.environ.get("SUTURE_THREE")
    for folder in [own] if own is not None else FOLDERS:
        found = [next((Path(folder, name) for name in names if Path(folder, name).is_file()), None) for names in PARTS]
        if None in found:
            continue
        texts = [path.read_text(encoding="utf-8") for path in found]
        # Modules without classic scripts (from revision 148 on) do not work in a page opened from a file.
        revision = re.search(r"REVISION *= *[\"'](\d+)", texts[0])
        if "THREE.OrbitControls" in texts[1] and "exports" in texts[0]:
            return (revision.group(1) if revision else "of unknown revision"), "\n".join(texts)
    return None
