#!/bin/sh
# Checks the packages on a bare Debian 12: installs them, solves and plots the tunnel, builds downstream projects, removes the packages.
#   sudo sh packaging/deb/check.sh PACKAGES ROOT
# PACKAGES is the folder of the .deb files (build/packages_deb); ROOT holds the bare system, created by debootstrap if it does not exist.
# Needs root, debootstrap and the Debian archive (MIRROR, http://deb.debian.org/debian). Prints the commands run in the bare system and
# leaves the pictures in ROOT/root/tunnel_out.
set -eu
[ $# -eq 2 ] && [ -d "$1" ] || { echo "usage: sh packaging/deb/check.sh PACKAGES ROOT" >&2; exit 2; }
[ "$(id -u)" -eq 0 ] || { echo "check.sh: debootstrap and chroot need root" >&2; exit 5; }
source=$(CDPATH='' cd -- "$(dirname -- "$0")/../.." && pwd)
packages=$1
root=$2

if [ ! -d "$root" ]; then
  debootstrap --variant=minbase bookworm "$root" "${MIRROR:-http://deb.debian.org/debian}" >"$root.log" || { tail "$root.log" >&2; exit 5; }
  rm -f "$root/etc/apt/sources.list" # replaced by those of this machine
  cp -a /etc/apt/. "$root/etc/apt/"
  cp /etc/resolv.conf "$root/etc/"
fi
if [ ! -r "$root/proc/self" ]; then
  mount -t proc proc "$root/proc"
  trap 'umount "$root/proc"' EXIT
fi

# Prints a command as typed, then runs it in the bare system; stops if it fails.
inside() {
  echo "# $1"
  chroot "$root" /usr/bin/env -i PATH=/usr/sbin:/usr/bin:/sbin:/bin HOME=/root LANG=C.UTF-8 DEBIAN_FRONTEND=noninteractive \
    OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1 HWLOC_HIDE_ERRORS=2 sh -c "cd /root && $1" </dev/null
}
# Also checks that the output contains a pattern.
prints() {
  inside "$1" >"$root/root/printed" 2>&1 || { cat "$root/root/printed"; exit 1; }
  cat "$root/root/printed"
  grep -q "$2" "$root/root/printed" || { echo "check.sh: expected '$2'" >&2; exit 1; }
}

rm -rf "$root/root/tunnel_out" "$root/root/projects"
cp "$packages"/*suture*.deb "$root/root/"
inside "apt-get update -q"

echo "== Two commands to a picture"
inside "apt-get install -y -q --no-install-recommends ./suture_*.deb"
prints "suture_solve /usr/share/suture/input/tunnel/tunnel.xml --output tunnel_out && suture_plot tunnel_out" "87 of 89 pairs closed"
[ -s "$root/root/tunnel_out/principal_stress.png" ] || { echo "check.sh: no picture of the stresses" >&2; exit 1; }
prints "mpirun --oversubscribe -np 2 suture_solve /usr/share/suture/input/tunnel/tunnel.xml --output tunnel_2_out" "87 of 89 pairs closed"
prints "ldd /usr/bin/suture_solve /usr/lib/suture/suture_mesher | grep -c 'not found' || true" "^0$"

echo "== Python"
inside "apt-get install -y -q --no-install-recommends ./python3-suture_*.deb"
prints "mpirun --oversubscribe -np 2 python3 -c 'import suture; print(repr(suture.solve(\"/usr/share/suture/input/tunnel/tunnel.xml\").energy))'" "^-"
energy=$(tail -n 1 "$root/root/printed")
inside "grep -qxF '  \"energy\": $energy,' tunnel_2_out/summary.json"  # to the last bit

echo "== Downstream projects, with the packages only"
inside "apt-get install -y -q --no-install-recommends ./suture-dev_*.deb g++ cmake make pkg-config"
mkdir -p "$root/root/projects"
cp -R "$source/test/install/downstream" "$source/test/install/pkgconfig" "$root/root/projects/"
for project in projects/downstream /usr/share/suture/drivers/examples/weighting; do
  name=$(basename "$project")
  inside "cmake -S $project -B projects/build_$name >projects/$name.log && cmake --build projects/build_$name"
done
prints "projects/build_downstream/downstream" "largest relative error of the contact pressure"
prints "suture_solve /usr/share/suture/input/tunnel/tunnel.xml --output weighted_out --plugin projects/build_weighting/tempered_weighting.so \
--set 'Preconditioner/Neumann-Neumann/Weighting=Tempered Stiffness' --set 'Preconditioner/Type=Neumann-Neumann' --set 'Formulation=Condensed Groups'" "87 of 89 pairs closed"
inside 'c++ -std=c++17 projects/pkgconfig/versions.cpp -o projects/versions $(pkg-config --cflags --libs suture)'
prints "projects/versions" "^0"
inside 'c++ -std=c++17 /usr/share/suture/drivers/examples/embedding/TwoBlocks.cpp -o projects/two_blocks $(pkg-config --cflags --libs suture)'
prints "mpirun --oversubscribe -np 2 projects/two_blocks" "17 pairs, pressures from 100000 to 100000 Pa"

echo "== Removed"
inside "apt-get purge -y -q suture suture-dev python3-suture"
prints "find /usr /etc /opt -name '*suture*' | grep -c . || true" "^0$"
echo "check.sh: all of it holds; pictures in $root/root/tunnel_out"
