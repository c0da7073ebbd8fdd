"""Randomly mutated inputs: scenes, geometries, CAD files, meshes and checkpoints. The program must solve each of them, or refuse it within the time limit
with a message and an exit code of the contract; it never crashes, hangs, or executes commands from a file.

attack.py --solve PROGRAM --partition PROGRAM --mpirun "mpirun ..." --work DIR --input FOLDER [--count N] [--seed S] [--first I] [--both] [--keep]

Mutant i of a seed is reproducible: `--first i --count 1` repeats it. `--both` runs each mutant on one and on two ranks; otherwise they alternate.
"""
import argparse
import json
import os
import pathlib
import random
import re
import resource
import signal
import subprocess
import time

import harness
from harness import SANITIZED, SLOWER, arguments, check, finish

parser = argparse.ArgumentParser()
parser.add_argument("--count", type=int, default=30)
parser.add_argument("--seed", type=int, default=1)
parser.add_argument("--first", type=int, default=0)
parser.add_argument("--both", action="store_true")
parser.add_argument("--keep", action="store_true")
options = arguments("--solve", "--partition", "--input", parser=parser)
os.environ["SUTURE_MESH_CACHE"] = "off"  # damaged geometries occur once
work = options.work
INPUT = pathlib.Path(options.input).resolve()
ALLOWED = {0, 2, 3, 4, 5, 75}
SECONDS = 30 * SLOWER
MARK = work / "mark"  # created by any program that an input manages to start
FIFO = work / "fifo.xml"
os.mkfifo(FIFO)

NASTY = ["", " ", "nan", "inf", "-inf", "-1", "0", "1", "1e308", "-1e308", "1e-320", "1e999", "2147483647", "-2147483648", "99999999999", "0x10",
         "1,5", "{}", "{", "{,}", "{1, 2, 3}", "{1e300, 1e300}", "{1000000, 1000000}", "{0, 0}", "true", "None", "no such name", "A" * 1000,
         "A" * 1000000, "../../etc/passwd", "/dev/zero", "/dev/null", "%s%n%s", "&lt;&amp;", "x*x", "1/x", "sqrt(x", "((((((((((1))))))))))",
         "\u00e4\u00f6\u00fc\U0001f600", "a->b", "a/b", "a=b", "'", "1e5", "1e-12", "0.5", "0.49999999", str(FIFO)]
EVIL = [f'SystemCall "touch {MARK}";', f'NonBlockingSystemCall "touch {MARK}";', f'System "touch {MARK}";', "Exit;", "Abort;", f'Save "{MARK}";',
        f'Print "{MARK}";', f'Printf("x") > "{MARK}";', "For i In {1:1e12}\n x = i;\nEndFor", "Macro again\n Call again;\nReturn\nCall again;",
        'Merge "/etc/passwd";', 'Include "/dev/zero";', f'OnelabRun("touch", "touch {MARK}");', "Delete Model;", "NewModel;", "Mesh 3;",
        f'Field[9] = ExternalProcess; Field[9].CommandLine = "touch {MARK}"; Background Field = 9;', "Delete { Surface{:}; }",
        "Mesh.ElementOrder = 9;", "Mesh.MeshSizeMax = 1e-9;", "Mesh.Algorithm = 99;", "Recombine Surface{:};", "SetFactory(\"none\");",
        "General.AbortOnError = 3; x = y;", "Physical Surface(\"left\") = {99999};", "RefineMesh;", "Sleep 1e9;", "If (1)", "EndFor", "\"", "/*"]


def bytes_of(path):
    return pathlib.Path(path).read_bytes()


# Valid inputs from which the mutants are made, once.

def program(name, *words):
    done = subprocess.run([str(name), *map(str, words)], capture_output=True, text=True, timeout=120 * SLOWER)
    if done.returncode != 0:
        raise SystemExit(f"{name} {' '.join(map(str, words))}: {done.stdout}{done.stderr}")


BLOCKS = (INPUT / "two_blocks" / "two_blocks.xml").read_text()
TUNNEL = (INPUT / "tunnel" / "tunnel_open.xml").read_text()
MESHED = re.sub(r'<ParameterList name="Constants">.*?</ParameterList>', "", TUNNEL, flags=re.S)  # scene of a mesh file
GEO = (INPUT / "tunnel" / "tunnel.geo").read_text()
FEW = ["--set", "Mesh/Constants/scale=4"]
program(options.solve, INPUT / "two_blocks" / "two_blocks.xml", "--set", "Output/Checkpoint=true", "--quiet", "--output", work / "sound")
program(options.partition, INPUT / "tunnel" / "tunnel_open.xml", *FEW, "--no-cut", "--quiet", "--output", work / "whole.h5")
program(options.partition, INPUT / "tunnel" / "tunnel_open.xml", *FEW, "--quiet", "--output", work / "cut.h5")
(work / "sound.xml").write_text(MESHED)  # mutants of an invalid input would prove nothing
program(options.solve, work / "sound.xml", "--set", f"Mesh/File={work / 'whole.h5'}", "--quiet", "--output", work / "sound_whole")
program(options.solve, work / "sound.xml", "--set", f"Mesh/File={work / 'cut.h5'}", "--set", "Partition/Type=Partitioned Mesh", "--quiet", "--output",
        work / "sound_cut")


def two_rectangles(version):
    """Two stacked plates of 4 x 2 quadrilaterals each, in Gmsh's format."""
    nodes, elements = [], []
    for body, y in ((1, 0.0), (2, 1.0)):
        base = len(nodes)
        nodes += [(x / 2, y + z / 2, 0.0) for z in range(3) for x in range(5)]
        at = lambda i, j: base + 5 * j + i + 1
        elements += [(3, body, body, [at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)]) for j in range(2) for i in range(4)]
        elements += [(1, 10 * body + 1, 10 * body + 1, [at(i, 0), at(i + 1, 0)]) for i in range(4)]
        elements += [(1, 10 * body + 2, 10 * body + 2, [at(i, 2), at(i + 1, 2)]) for i in range(4)]
    names = [(2, 1, "lower"), (2, 2, "upper"), (1, 11, "lower_bottom"), (1, 12, "lower_top"), (1, 21, "upper_bottom"), (1, 22, "upper_top")]
    text = f"$MeshFormat\n{version} 0 8\n$EndMeshFormat\n$PhysicalNames\n{len(names)}\n"
    text += "".join(f'{d} {t} "{n}"\n' for d, t, n in names) + "$EndPhysicalNames\n"
    if version == "2.2":
        text += f"$Nodes\n{len(nodes)}\n" + "".join(f"{i + 1} {x} {y} {z}\n" for i, (x, y, z) in enumerate(nodes)) + "$EndNodes\n"
        text += f"$Elements\n{len(elements)}\n"
        text += "".join(f"{i + 1} {t} 2 {p} {e} {' '.join(map(str, n))}\n" for i, (t, p, e, n) in enumerate(elements)) + "$EndElements\n"
        return text
    tags = sorted({(1 if t == 1 else 2, e) for t, p, e, n in elements})
    curves, surfaces = [e for d, e in tags if d == 1], [e for d, e in tags if d == 2]
    text += f"$Entities\n0 {len(curves)} {len(surfaces)} 0\n" + "".join(f"{e} 0 0 0 2 2 0 1 {e} 0\n" for e in curves + surfaces) + "$EndEntities\n"
    text += f"$Nodes\n1 {len(nodes)} 1 {len(nodes)}\n2 1 0 {len(nodes)}\n" + "".join(f"{i + 1}\n" for i in range(len(nodes)))
    text += "".join(f"{x} {y} {z}\n" for x, y, z in nodes) + "$EndNodes\n"
    text += f"$Elements\n{len(tags)} {len(elements)} 1 {len(elements)}\n"
    number = 0
    for d, e in tags:
        own = [n for t, p, at, n in elements if (t == 1) == (d == 1) and at == e]
        text += f"{d} {e} {1 if d == 1 else 3} {len(own)}\n"
        for n in own:
            number += 1
            text += f"{number} {' '.join(map(str, n))}\n"
    return text + "$EndElements\n"


PLATES = """<ParameterList name="Suture">
  <ParameterList name="Mesh"><Parameter name="File" type="string" value="plates.msh"/></ParameterList>
  <ParameterList name="Bodies"><ParameterList name="lower"><Parameter name="Material" type="string" value="m"/></ParameterList>
    <ParameterList name="upper"><Parameter name="Material" type="string" value="m"/></ParameterList></ParameterList>
  <ParameterList name="Materials"><ParameterList name="m"><Parameter name="Type" type="string" value="Isotropic"/>
    <Parameter name="Young Modulus" type="double" value="1e5"/><Parameter name="Poisson Ratio" type="double" value="0.3"/></ParameterList></ParameterList>
  <ParameterList name="Boundary Conditions">
    <ParameterList name="ground"><Parameter name="Group" type="string" value="lower_bottom"/><Parameter name="Type" type="string" value="Displacement"/>
      <Parameter name="Value" type="Array(double)" value="{0.0, 0.0}"/></ParameterList>
    <ParameterList name="press"><Parameter name="Group" type="string" value="upper_top"/><Parameter name="Type" type="string" value="Displacement"/>
      <Parameter name="Value" type="Array(double)" value="{0.0, -0.01}"/></ParameterList></ParameterList>
  <ParameterList name="Contact"><ParameterList name="line"><Parameter name="Side A" type="string" value="lower_top"/>
    <Parameter name="Side B" type="string" value="upper_bottom"/></ParameterList></ParameterList>
</ParameterList>
"""


# A block with a hole from an IGES file, and an assembly from a STEP file, held and pulled.
CAD = pathlib.Path(__file__).resolve().parents[1] / "reader" / "cad"
CAD_BODIES = {"solid.igs": ("body_1",), "faces.igs": ("body_1",), "bolted_joint_in.step": ("base_plate_steel", "bolt_1", "bolt_2")}


def cad_scene(file, bodies):
    held = "".join(f"""<ParameterList name="{end} {body}"><Parameter name="Group" type="string" value="{body}_{end}"/>
      <Parameter name="Type" type="string" value="Displacement"/><Parameter name="Value" type="Array(double)" value="{{0, 0, {move}}}"/></ParameterList>"""
                   for body in bodies for end, move in (("bottom", 0), ("top", 1e-4)))
    return f"""<ParameterList name="Suture"><Parameter name="Units" type="string" value="mm, N, MPa"/>
  <ParameterList name="Mesh"><Parameter name="File" type="string" value="{file}"/></ParameterList>
  <ParameterList name="Bodies">{"".join(f'<ParameterList name="{b}"><Parameter name="Material" type="string" value="m"/></ParameterList>' for b in bodies)}
  </ParameterList><ParameterList name="Materials"><ParameterList name="m">
    <Parameter name="Young Modulus" type="double" value="1e5"/><Parameter name="Poisson Ratio" type="double" value="0.3"/></ParameterList></ParameterList>
  <ParameterList name="Boundary Conditions">{held}</ParameterList></ParameterList>
"""


# Mutations of text or bytes.

def attributes(text, name):
    return [m.span(1) for m in re.finditer(name + r'="([^"]*)"', text)]


def replaced(text, span, new):
    return text[:span[0]] + new + text[span[1]:]


def mutate_xml(rng, text):
    kind = rng.choice(["value", "value", "value", "value", "name", "type", "delete", "double", "nest", "encoding", "characters", "lines", "numbers"])
    values, names, types = (attributes(text, a) for a in ("value", " name", "type"))
    element = [m.span() for m in re.finditer(r"<Parameter [^>]*/>", text)]
    if kind == "value":
        return replaced(text, rng.choice(values), rng.choice(NASTY)).encode()
    if kind == "name":
        span = rng.choice(names)
        old = text[span[0]:span[1]]
        return replaced(text, span, rng.choice(["", old[:-1], old + "x", old.swapcase(), rng.choice(NASTY)])).encode()
    if kind == "type":
        return replaced(text, rng.choice(types), rng.choice(["int", "double", "bool", "string", "Array(int)", "Array(double)", "", "float"])).encode()
    if kind == "delete":
        return replaced(text, rng.choice(element), "").encode()
    if kind == "double":
        span = rng.choice(element)
        return replaced(text, (span[1], span[1]), text[span[0]:span[1]]).encode()
    if kind == "nest":
        depth = rng.choice([10, 60, 5000, 20000, 200000])
        span = rng.choice(element)
        return replaced(text, (span[1], span[1]), '<ParameterList name="n">' * depth + "</ParameterList>" * rng.choice([depth, depth - 1, 0])).encode()
    if kind == "encoding":
        how = rng.choice(["utf-16", "utf-32", "zero", "bom", "latin"])
        if how in ("utf-16", "utf-32"):
            return text.encode(how)
        at = rng.randrange(len(text))
        return {"zero": text[:at].encode() + b"\0" + text[at:].encode(), "bom": b"\xef\xbb\xbf" + text.encode(),
                "latin": text[:at].encode() + b"\xe4\xff" + text[at:].encode()}[how]
    if kind == "numbers":
        spans = [m.span() for m in re.finditer(r"(?<![\w.])-?\d+\.?\d*(?:e-?\d+)?", text)]
        return replaced(text, rng.choice(spans), rng.choice(["0", "-1", "1e30", "-1e30", "1e-30", "1e300", "2147483647", "7", "0.5"])).encode()
    return mutate_lines(rng, text) if kind == "lines" else mutate_bytes(rng, text.encode())


def mutate_lines(rng, text):
    lines = text.split("\n")
    i, j = rng.randrange(len(lines)), rng.randrange(len(lines))
    what = rng.choice(["drop", "swap", "double", "cut"])
    if what == "drop":
        del lines[i]
    elif what == "swap":
        lines[i], lines[j] = lines[j], lines[i]
    elif what == "double":
        lines.insert(i, lines[j])
    else:
        lines = lines[:i]
    return "\n".join(lines).encode()


def mutate_numbers(rng, text):
    for _ in range(rng.choice([1, 1, 3])):
        spans = [m.span() for m in re.finditer(r"-?\d+\.?\d*(?:e-?\d+)?", text)]
        text = replaced(text, rng.choice(spans), rng.choice(["0", "-1", "1", "2", "7", "34", "84", "222", "1e30", "nan", "-1e300", "4000000000", "2147483648", "x"]))
    return text.encode()


def mutate_bytes(rng, data):
    data = bytearray(data)
    what = rng.choice(["flip", "flip", "cut", "zeros", "insert"])
    if what == "flip":
        for _ in range(rng.choice([1, 1, 8, 64])):
            data[rng.randrange(len(data))] ^= 1 << rng.randrange(8)
    elif what == "cut":
        del data[rng.randrange(len(data)):]
    elif what == "zeros":
        at = rng.randrange(len(data))
        size = min(rng.choice([4, 64, 512]), len(data) - at)
        data[at:at + size] = bytes(size)
    else:
        at = rng.randrange(len(data))
        data[at:at] = bytes(rng.randrange(256) for _ in range(16))
    return bytes(data)


def mutate_hdf5(rng, data):
    # Headers are a small part of a file: half of the mutants change them.
    if rng.random() < 0.5:
        head = min(len(data), 4096)
        return mutate_bytes(rng, data[:head]) + data[head:] if rng.random() < 0.9 else data[:head]
    return mutate_bytes(rng, data)


def mutate_evil(rng, text):
    """Statements of Gmsh in a file of another kind."""
    lines = text.split("\n")
    lines.insert(rng.choice([0, rng.randrange(len(lines))]), rng.choice(EVIL))
    return "\n".join(lines).encode()


def mutate_geo(rng, text):
    kind = rng.choice(["evil", "evil", "evil", "numbers", "lines", "bytes"])
    if kind == "evil":
        lines = text.split("\n")
        lines.insert(rng.randrange(len(lines)), rng.choice(EVIL))
        return "\n".join(lines).encode()
    return {"numbers": mutate_numbers, "lines": mutate_lines}[kind](rng, text) if kind != "bytes" else mutate_bytes(rng, text.encode())


def mutant(i, folder):
    """Writes the files of mutant i. Returns its command-line arguments."""
    rng = random.Random(f"{options.seed}/{i}")
    kind = ["xml blocks", "geo", "msh", "mesh h5", "checkpoint", "xml blocks", "cut h5", "xml tunnel", "command line", "cad"][i % 10]
    scene = folder / "scene.xml"
    words = ["--set", "Mesh/Time Limit=20"] if kind in ("geo", "msh", "xml tunnel", "cad") else []
    if kind == "xml blocks":
        scene.write_bytes(mutate_xml(rng, BLOCKS))
    elif kind == "xml tunnel":
        scene.write_bytes(mutate_xml(rng, TUNNEL))
        (folder / "tunnel.geo").write_text(GEO)
        words += FEW
    elif kind == "geo":
        scene.write_text(TUNNEL)
        (folder / "tunnel.geo").write_bytes(mutate_geo(rng, GEO))
        words += FEW
    elif kind == "cad":
        name = rng.choice(sorted(CAD_BODIES))
        scene.write_text(cad_scene(name, CAD_BODIES[name]))
        mutation = rng.choice([mutate_numbers, mutate_numbers, mutate_lines, lambda r, t: mutate_bytes(r, t.encode()), mutate_evil, lambda r, t: t.encode()])
        (folder / name).write_bytes(mutation(rng, (CAD / name).read_text()))
        words += ["--set", "Mesh/Order=1", "--set", "Mesh/Mesh Size Factor=2"]
    elif kind == "msh":
        scene.write_text(PLATES)
        text = two_rectangles(rng.choice(["2.2", "4.1"]))
        (folder / "plates.msh").write_bytes(rng.choice([mutate_numbers, mutate_lines, lambda r, t: mutate_bytes(r, t.encode())])(rng, text))
    elif kind in ("mesh h5", "cut h5"):
        scene.write_text(MESHED)
        whole = kind == "mesh h5"
        (folder / "tunnel.h5").write_bytes(mutate_hdf5(rng, bytes_of(work / ("whole.h5" if whole else "cut.h5"))))
        words += ["--set", "Mesh/File=tunnel.h5"] + ([] if whole else ["--set", "Partition/Type=Partitioned Mesh"])
    elif kind == "checkpoint":
        scene.write_text(BLOCKS)
        (folder / "checkpoint.h5").write_bytes(mutate_hdf5(rng, bytes_of(work / "sound" / "checkpoint.h5")))
        words += ["--restart", str(folder / "checkpoint.h5")]
    else:
        scene.write_text(BLOCKS)
        path = rng.choice(["Outer Solver/Tolerance", "Mesh/Boxes/upper/Cells", "Contact/joint/Side B", "Outer Solver/Chord/Anderson Depth", "Output/Folder",
                           "Partition/METIS/Subdomains", "Partition/METIS/Seed", "Bodies/upper/Material", "", "/", "a/b/c", "Preconditioner/Type"])
        words += rng.choice([["--set", f"{path}={rng.choice(NASTY)[:100000]}"], ["--restart", rng.choice(["/dev/zero", str(FIFO), "/dev/null", str(work)])],
                             ["--plugin", rng.choice(["/dev/null", "none.so"])], [rng.choice(["--no-such", "--restart", "--output"])]])
    return kind, scene, words


def processor_seconds(session):
    """CPU seconds used by the processes of a session, including those that have ended."""
    ticks = 0
    for stat in pathlib.Path("/proc").glob("[0-9]*/stat"):
        try:
            words = stat.read_text().rsplit(")", 1)[1].split()
        except OSError:
            continue
        if int(words[3]) == session:
            ticks += sum(map(int, words[11:15]))
    return ticks / os.sysconf("SC_CLK_TCK")


def outcome(process):
    """Output and exit code; "no end" after SECONDS of CPU time, or ten times as many of wall clock."""
    begin = time.time()
    while True:
        try:
            return process.communicate(timeout=SECONDS)[0].decode(errors="replace"), process.returncode
        except subprocess.TimeoutExpired:
            if processor_seconds(process.pid) < SECONDS / 2 and time.time() - begin < 10 * SECONDS and os.getloadavg()[0] > os.cpu_count():
                continue
            os.killpg(process.pid, signal.SIGKILL)
            return process.communicate()[0].decode(errors="replace"), "no end"


def limits():
    size = 8 << 30
    if not SANITIZED:
        resource.setrlimit(resource.RLIMIT_AS, (size, size))
    resource.setrlimit(resource.RLIMIT_CORE, (0, 0))


def attack(i, ranks):
    folder = work / f"{i:05d}.np{ranks}"
    folder.mkdir()
    kind, scene, words = mutant(i, folder)
    out = folder / "out"
    words = [str(scene), *words, *([] if "--output" in words or "Output/Folder" in " ".join(words)[:2000] else ["--output", str(out)])]
    line = [options.solve, *words] if ranks == 1 else harness.command(options.solve, ranks, *words)
    begin = time.time()
    process = subprocess.Popen(line, cwd=folder, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, preexec_fn=limits,
                               start_new_session=True)
    text, code = outcome(process)
    wrong = []
    if code not in ALLOWED:
        wrong.append(f"exit code {code}")
    if code == 0:
        summary = out / "summary.json"
        if not summary.exists():
            summary = next(folder.glob("**/summary.json"), summary)
        if not summary.exists() or not json.loads(summary.read_text())["converged"]:
            wrong.append("exit code 0 without a result that converged")
    elif not text.strip():
        wrong.append("no message")
    if len(text) > 100000:
        wrong.append(f"{len(text)} characters of messages")
    if MARK.exists():
        wrong.append("a program ran, or a file was written")
        MARK.unlink()
    if wrong:
        (folder / "output.txt").write_text(text)
        check(f"mutant {i} ({kind}) on {ranks}: " + " ".join(words)[:300], (wrong, text[-400:]), lambda _: False)
    elif not options.keep:
        subprocess.run(["rm", "-rf", str(folder)])
    return kind, code, time.time() - begin


counts, longest = {}, 0.0
try:
    for i in range(options.first, options.first + options.count):
        for ranks in (1, 2) if options.both else (1 + i // 10 % 2,):
            kind, code, seconds = attack(i, ranks)
            counts[kind, code] = counts.get((kind, code), 0) + 1
            longest = max(longest, seconds)
except KeyboardInterrupt:
    check(f"all mutants: interrupted at {i}", False, True)
for (kind, code), count in sorted(counts.items(), key=str):
    print(f"{kind:14} exit {code}: {count}")
runs = sum(counts.values())
print(f"{runs} runs of mutants {options.first} to {options.first + options.count - 1} of seed {options.seed}; the longest took {longest:.1f} s")
check("some were refused and some were solved", {code for _, code in counts}, lambda codes: options.count < 20 or {0, 3} <= codes)
finish()
