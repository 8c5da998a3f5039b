#!/usr/bin/env bash
# An M80 ball at 823 m/s goes through a vest into soft tissue, from a bare Debian 12 to pictures: installs what is
# missing (as root or with sudo), builds Ballast, runs the main scene, draws it. May be repeated.
set -euo pipefail
[[ $# -eq 0 ]] || { echo "usage: ${0} (no arguments)" >&2; exit 2; }
. "$(dirname "${BASH_SOURCE[0]}")/scripts/setup.sh"

deck="$ballast_root/problems/m80_vest_tissue.toml"
run_directory="$ballast_root/runs/m80_vest_tissue"

# Tuned for this machine: the same bits as the portable build that the tests use, in less time.
ballast_preset=native
ballast_build="$ballast_root/build/native"

install_missing
build ballast
ballast="$ballast_build/ballast"

say "running problems/m80_vest_tissue.toml on $(nproc) cores"
status=0
"$ballast" run "$deck" --out "$run_directory" || status=$?
case $status in
0) ;;
3) say "the run stopped with a numerical failure (above); drawing what there is" ;;
130) stop "interrupted. To go on:" \
  "$ballast run $deck --out $run_directory --restart $run_directory/checkpoint.h5" ;;
*) exit "$status" ;;
esac

say "drawing"
"$ballast" report "$run_directory"
say "pictures: $run_directory/pictures/*.png"
say "figures:  $run_directory/summary.json, history.csv; fields.pvd opens in ParaView"
exit "$status"
