#!/usr/bin/python3
"""check_doc.py itself: a clean tree passes, and each violation planted in it, one at a time, is reported.

planted.py CHECK FOLDER
"""
import pathlib
import shutil
import subprocess
import sys

check, tree = sys.argv[1], pathlib.Path(sys.argv[2])
failed = False

HEADER = """#pragma once
namespace suture {
/// Not declared: class Ghost { int spirit(); }; int phantom(int);
class Bridge : public Way {
 public:
  explicit Bridge(int length) : length_(length) {}
  double load() const { return weigh(length_); }
  virtual std::vector<double> loads(const Bridge& other,
                                    int count) const = 0;

 private:
  int length_;
};
class Forward;
struct Plain {
  int number = 0;
};
double span(const Bridge& bridge);
inline double twice(double x) { return reckon(x); }
}  // namespace suture
"""
UNIT = """#include <Teuchos_UnitTestHarness.hpp>
#define PLANT(Name, scene) \\
  TEUCHOS_UNIT_TEST(Bridge, Name) { run(scene); }
TEUCHOS_UNIT_TEST(Bridge, CarriesItsLoad) { TEST_ASSERT(true); }
TEUCHOS_UNIT_TEST(Plain, IsPlain) { TEST_ASSERT(true); }
// TEUCHOS_UNIT_TEST(Bridge, IsCommentedOut) {}
PLANT(HoldsWhatIsPlanted, small())
"""
CMAKE = """suture_test(way Bridge RANKS 1)
# suture_test(way Loose)
add_test(NAME way.whole COMMAND x)  # add_test(NAME way.gone COMMAND x)
suture_run_table(way.case ${CMAKE_CURRENT_SOURCE_DIR}/cases.json RANKS 2)
"""
HEAD = ["| equation | meaning | code | test |", "|---|---|---|---|"]
RIGHT = ["| (1) | a class | `Bridge` | `way/Bridge.CarriesItsLoad` |", "| (2) | a member | `Bridge::loads` | `way/Bridge.Plain.IsPlain` |",
         "| (3) | a function | `span` | `way/Bridge.HoldsWhatIsPlanted` |", "| (4) | inline | `twice` | `ctest way.whole` |",
         "| (5) | a structure | `Plain` | `ctest way.case.one` |", "| (6) | a member | `Bridge::load` | `ctest validation.v1` |"]


def clean(rows=RIGHT, head=HEAD, page="[theory](doc/theory.md#the-table), [the web](https://localhost/none), [here](#a-heading)"):
    shutil.rmtree(tree, ignore_errors=True)
    for name, text in {"packages/way/Bridge.hpp": HEADER, "test/way/Bridge.cpp": UNIT, "test/way/CMakeLists.txt": CMAKE,
                       "test/way/Loose.cpp": "TEUCHOS_UNIT_TEST(Loose, IsNotBuilt) {}",
                       "test/way/cases.json": '{"cases": {"one": {}}}', "input/validation/v1/checks.json": "{}",
                       "doc/theory.md": "\n".join(["# The table", ""] + head + rows + [""]),
                       "README.md": f"# A heading\n\n{page}\n\n```\n[code](nowhere)\n```\n"}.items():
        file = tree / name
        file.parent.mkdir(parents=True, exist_ok=True)
        file.write_text(text)


def run():
    done = subprocess.run([sys.executable, "-B", check, str(tree)], capture_output=True, text=True, timeout=60)
    return done.returncode, done.stdout + done.stderr


def expect(problem, **planted):
    """With the planted error the check fails and reports only this error."""
    global failed
    clean(**planted)
    code, said = run()
    if code != 1 or said.strip().split("\n") != [problem]:
        print(f"wanted: {problem}\nexit code {code}, said: {said}")
        failed = True


def row(code, test):
    return {"rows": RIGHT + [f"| (7) | planted | {code} | {test} |"]}


clean()
code, said = run()
if code != 0 or said:
    print(f"a clean tree does not pass:\n{said}")
    failed = True
HERE = "doc/theory.md:11: "
GOOD_CODE, GOOD_TEST = "`Bridge`", "`way/Bridge.CarriesItsLoad`"
for name in ["Forward", "Ghost", "phantom", "weigh", "reckon", "spam", "load"]:
    expect(HERE + f"no header of packages/ has a class or function {name}", **row(f"`{name}`", GOOD_TEST))
expect(HERE + "no header of packages/ has a class Brigde", **row("`Brigde::load`", GOOD_TEST))
for name in ["lord", "weigh", "span", "length_"]:
    expect(HERE + f"class Bridge has no member {name}()", **row(f"`Bridge::{name}`", GOOD_TEST))
for name in ["CarriesNothing", "IsCommentedOut", "IsPlain", "Name"]:
    expect(HERE + f"test/way/Bridge.cpp has no TEUCHOS_UNIT_TEST(Bridge, {name})", **row(GOOD_CODE, f"`way/Bridge.{name}`"))
expect(HERE + "test/way/Loose.cpp is not named in its CMakeLists.txt", **row(GOOD_CODE, "`way/Loose.IsNotBuilt`"))
expect(HERE + "there is no test/way/Road.cpp", **row(GOOD_CODE, "`way/Road.CarriesItsLoad`"))
for name in ["way.gone", "way.case.two", "validation.v2"]:
    expect(HERE + f"ctest has no test {name}", **row(GOOD_CODE, f"`ctest {name}`"))
expect(HERE + "nothing is neither folder/File.Test nor ctest name", **row(GOOD_CODE, "`nothing`"))
for bad in [("Bridge", GOOD_TEST), (GOOD_CODE, ""), (GOOD_CODE, f"{GOOD_TEST} | more")]:
    expect(HERE + "not a row of equation, meaning, `code`, `test`", **row(*bad))
expect("doc/theory.md has no table with the header equation | meaning | code | test", rows=[])
expect("doc/theory.md has no table with the header equation | meaning | code | test", head=["| a | b | c | d |", "|---|---|---|---|"])
expect("README.md:3: the link doc/practice.md leads to no file", page="[practice](doc/practice.md)")
expect("README.md:3: doc/theory.md has no heading #the-chair", page="[theory](doc/theory.md#the-chair)")
expect("README.md:3: README.md has no heading #another", page="[here](#another)")
shutil.rmtree(tree, ignore_errors=True)
sys.exit(failed)
