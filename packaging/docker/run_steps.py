#!/usr/bin/python3
"""Executes the steps of the Dockerfile in this folder without Docker.

sudo python3 run_steps.py ROOT [PACKAGES]

Each stage is a bare Debian 12 in ROOT/<number> (debootstrap, with the apt sources of this machine), in which the lines COPY, RUN, ENV,
WORKDIR and USER are executed in order on the sources of the last commit. Prints each step with its seconds and stops at the first one that
fails. At the end the last stage solves and plots the tunnel as its user; the pictures are in ROOT/<number>/work/out. With PACKAGES, a
folder of .deb files, the first stage is skipped, and files that other stages copy from it are taken from PACKAGES. Needs root, debootstrap
and git.
"""
import glob
import os
import pathlib
import re
import shlex
import shutil
import subprocess
import sys
import time

HERE = pathlib.Path(__file__).resolve().parent
SOURCE = HERE.parent.parent
FINAL = "suture_solve /usr/share/suture/input/tunnel/tunnel.xml --output out && suture_plot out"


class Stage:
    def __init__(self, root, image):
        if image != "debian:bookworm":
            sys.exit(f"run_steps.py knows the image debian:bookworm, not {image}")
        self.root, self.folder, self.user, self.environment = root, "/", "root", {}
        if not root.exists():
            subprocess.run(["debootstrap", "--variant=minbase", "bookworm", root, os.environ.get("MIRROR", "http://deb.debian.org/debian")], check=True,
                           stdout=subprocess.DEVNULL)
            (root / "etc/apt/sources.list").unlink(missing_ok=True)
            shutil.copytree("/etc/apt", root / "etc/apt", dirs_exist_ok=True)
            shutil.copy("/etc/resolv.conf", root / "etc/resolv.conf")

    def run(self, command):
        home = "/root" if self.user == "root" else f"/home/{self.user}"  # as in Docker
        variables = {"HOME": home, "PATH": "/usr/local/sbin:/usr/local/bin:/usr/sbin:/usr/bin:/sbin:/bin", "DEBIAN_FRONTEND": "noninteractive", **self.environment}
        words = [f"{name}={value}" for name, value in variables.items()]
        log = self.root.parent / "last_step.log"
        with open(log, "w") as output:
            subprocess.run(["mount", "-t", "proc", "proc", self.root / "proc"], check=True)
            try:
                code = subprocess.run(["chroot", f"--userspec={self.user}", self.root, "/usr/bin/env", "-i", *words, "sh", "-c", f"cd {self.folder} && {command}"],
                                      stdin=subprocess.DEVNULL, stdout=output, stderr=subprocess.STDOUT).returncode
            finally:
                subprocess.run(["umount", self.root / "proc"], check=True)
        if code:
            sys.exit(f"exit code {code}\n" + "\n".join(log.read_text().splitlines()[-30:]))
        return log.read_text()

    def place(self, path):
        return self.root / path.lstrip("/")

    def copy(self, sources, target):
        for source in sources:
            found = glob.glob(str(source))
            if not found:
                sys.exit(f"COPY: there is no {source}")
            for file in found:
                shutil.copy2(file, self.place(target))


def instructions(text):
    text = re.sub(r"^#.*\n", "", text, flags=re.M)
    for line in re.sub(r"\\\n", " ", text).splitlines():
        if line.strip():
            yield line.strip().split(None, 1)


def main():
    root = pathlib.Path(sys.argv[1]).resolve()
    packages = pathlib.Path(sys.argv[2]).resolve() if len(sys.argv) > 2 else None
    root.mkdir(parents=True, exist_ok=True)
    stages, names = [], {}
    for word, rest in instructions((HERE / "Dockerfile").read_text()):
        begin = time.time()
        skipped = packages and len(stages) == (0 if word == "FROM" else 1)
        print(f"{word} {rest}" + ("    skipped" if skipped else ""), flush=True)
        if word == "FROM":
            image, *name = rest.split()
            if skipped:
                stages.append(None)
                names[name[1]] = None
                continue
            stages.append(Stage(root / str(len(stages)), image))
            names[name[1] if name else str(len(stages) - 1)] = stages[-1]
            continue
        if skipped:
            continue
        stage = stages[-1]
        if word == "COPY":
            *sources, target = shlex.split(rest)
            if sources[0].startswith("--from="):
                made = names[sources[0][7:]]
                stage.copy([made.place(path) if made else packages / pathlib.Path(path).name for path in sources[1:]], target)
            elif sources == ["."]:
                shutil.rmtree(stage.place(target), ignore_errors=True)
                subprocess.run(["git", "clone", "-q", "--no-hardlinks", SOURCE, stage.place(target)], check=True)
            else:
                stage.copy([SOURCE / path for path in sources], target)
        elif word == "RUN":
            stage.run(rest)
        elif word == "ENV":
            stage.environment.update(pair.split("=", 1) for pair in shlex.split(rest))
        elif word == "WORKDIR":
            stage.folder = rest
            stage.place(rest).mkdir(parents=True, exist_ok=True)
        elif word == "USER":
            stage.user = rest
        elif word != "CMD":
            sys.exit(f"run_steps.py does not know {word}")
        if word in ("COPY", "RUN"):
            print(f"    {time.time() - begin:.0f} s", flush=True)
    stage = stages[-1]
    stage.place(stage.folder).chmod(0o777)  # like a mounted folder of the user
    print(f"{stage.user}$ {FINAL}")
    print(stage.run(FINAL))


if __name__ == "__main__":
    main()
