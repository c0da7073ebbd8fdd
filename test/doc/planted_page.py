#!/usr/bin/python3
"""run_page.py itself: a correct page passes, and each fault planted in it, one at a time, is found. planted_page.py FOLDER"""
import pathlib
import shutil
import subprocess
import sys

folder = pathlib.Path(sys.argv[1]).resolve()
shutil.rmtree(folder, ignore_errors=True)
folder.mkdir(parents=True)
PICTURE = bytes.fromhex("89504e470d0a1a0a0000000d49484452000000640000003208000000")  # the head of a PNG of 100 x 50
(folder / "shown.png").write_bytes(PICTURE)
(folder / "scene.xml").write_text('<ParameterList name="a"><Parameter name="b" type="int" value="1"/></ParameterList>')
(folder / "main.cpp").write_text("int main() {}\n")
(folder / "CMakeLists.txt").write_text("add_executable(a main.cpp)\n")
RIGHT = """# A page

```sh
echo "converged: 3 outer, residual 2.0e-09; 9 of 1,041 pairs closed, 0.5,1.25,7"; \\
  test "$SUTURE"
printf '{picture}' > made.png
```

```text
converged:  3 outer, residual 3.1e-09; ... pairs closed, 0.5,1.249,7
converged: ... 9 of 1,041 ...,7
```

```xml
<Parameter name="b" type="int" value="1"/>
```

from [scene](scene.xml), [program](main.cpp)

```cpp
int main() {}
```

![a picture](shown.png "made.png")
""".replace("{picture}", "".join(f"\\{byte:03o}" for byte in PICTURE))
PLANTED = [("", "", None), ("test \"$SUTURE\"", "false", "exit code 1"), ("3 outer, residual 3.1e-09", "4 outer, residual 3.1e-09", "no command above prints"),
           ("3.1e-09", "3.1e-07", "no command above prints"), ("0.5,1.249", "0.5,1.2", "no command above prints"), ("...,7", "...,8", "no command above prints"),
           ('value="1"', 'value="2"', "no linked scene"), ("int main() {}", "int main();", "no linked source"), ("> made.png", "> other.png", "no picture made.png"),
           ("\\000\\000\\000\\062", "\\000\\000\\000\\162", "not made.png"), ("```", "~~~", "nothing to run")]
failed = False
for right, wrong, wanted in PLANTED:
    (folder / "page.md").write_text(RIGHT.replace(right, wrong) if right else RIGHT)
    command = [sys.executable, "-B", pathlib.Path(__file__).with_name("run_page.py"), folder / "page.md", "--source", folder, "--drivers", folder, "--work", folder / "work"]
    done = subprocess.run([str(word) for word in command], capture_output=True, text=True, timeout=60)
    if (done.returncode != 0) != (wanted is not None) or (wanted or "") not in done.stderr:
        print(f"planted {wrong!r}, wanted: {wanted or 'no failure'}\nexit code {done.returncode}: {done.stderr}")
        failed = True
sys.exit(failed)
