#!/usr/bin/env bash
# Regenerates the studies of docs/studies: tables (study.md, study.csv) and pictures beside them, from runs kept in runs/studies (an
# interrupted study goes on where it stopped; another build runs everything anew). What the pages conclude is written by hand.
#
#   scripts/studies.sh [--quick] [remap_frequency] [resolution] [scene_needs] [threads_and_size]     default: all four
#
# --quick halves the resolution of the large scenes: to see that everything runs. Quiet machine, two cores: about an hour for all.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
. scripts/setup.sh
ballast_preset=native
ballast_build=$PWD/build/native
ballast=$ballast_build/ballast
runs=runs/studies
[[ -x $ballast ]] || { install_missing; build ballast; }

half=1 # what the resolutions of the large scenes are multiplied by
if [[ ${1:-} == --quick ]]; then
  half=0.5
  shift
fi
scaled() { awk -v a="$1" -v b="$half" 'BEGIN { printf "%g", a * b }'; }

# keep NAME STUDY: the tables and the pictures of a study's folder into docs/studies/STUDY/NAME.
keep() {
  local to=docs/studies/$2/$1
  rm -rf "$to"
  mkdir -p "$to"
  cp "$runs/$2/$1/study.md" "$runs/$2/$1/study.csv" "$to/"
  local picture
  for picture in "$runs/$2/$1"/pictures/{front_L1_*,front_bullet_velocity*,front_target_cavity*,by_mesh*_bullet_velocity*}.png; do
    [[ ! -e $picture ]] || cp "$picture" "$to/"
  done
}

# run STUDY NAME DECK ARGUMENTS...: one `ballast study`; its exit status says whether all rows are there, failures included.
run() {
  local study=$1 name=$2 deck=$3
  shift 3
  printf '\n== %s: %s\n' "$study" "$name"
  "$ballast" study "$deck" --out "$runs/$study/$name" "$@" || printf '%s: rows are missing\n' "$name"
  keep "$name" "$study"
}

# The remap intervals as cases; "never" takes the settings after it.
intervals=(--case "every 1: motion.remap_every=1")
for n in 2 4 8 16 32; do intervals+=(--case "every $n: motion.remap_every=$n"); done
for q in 0.8 0.5 0.3; do intervals+=(--case "quality $q: motion.remap_quality=$q"); done
never=(--case 'never: motion.policy="lagrangian"')

remap_frequency() {
  local s=remap_frequency
  run $s sod problems/sod.toml --reference exact "${intervals[@]}" "${never[@]}" --set mesh.refine=4 --threads 1
  run $s plate_impact problems/plate_impact.toml --reference exact "${intervals[@]}" "${never[@]}" --set mesh.refine=2 --threads 1
  run $s triple_point problems/triple_point.toml --reference fine "${intervals[@]}" "${never[@]}" \
    --case "fine: mesh.refine=2"
  run $s taylor problems/taylor_copper.toml --reference fitted "${intervals[@]}" \
    --case 'fitted: mesh.r.to="3.2 mm"; mesh.r.cells=16; mesh.z.to="32.4 mm"; mesh.z.cells=162; motion.policy="lagrangian"' \
    --set 'motion.policy="eulerian"' --set 'mesh.r.to="9 mm"' --set mesh.r.cells=45 --set 'mesh.z.to="33.2 mm"' --set mesh.z.cells=166
  mkdir -p "$runs" # the deck says every 4, which contradicts a quality
  sed '/^remap_every/d' problems/m80_tissue.toml > "$runs/m80_tissue.toml"
  run $s m80 "$runs/m80_tissue.toml" --reference fine "${intervals[@]}" --case 'never: motion.policy="lagrangian"; numerics.sliding=[]' \
    --case "fine: mesh.refine=$(scaled 2)" --set 'end_time="60 us"' --set "mesh.refine=$(scaled 1)"
  run $s m80_vest problems/m80_vest_tissue.toml --reference 'every 1' "${intervals[@]:0:8}" --set "mesh.refine=$(scaled 0.5)"
  mkdir -p docs/studies/$s
  { printf '# Vortex strain: `ballast verify vortex_interval`\n\n```\n'; "$ballast" verify vortex_interval; printf '```\n'; } > docs/studies/$s/vortex.md
}

resolution() {
  local s=resolution list
  list="$(scaled 0.25),$(scaled 0.5),$(scaled 1),$(scaled 2)"
  run $s m80 problems/m80_tissue.toml --vary "mesh.refine=$list" --set 'end_time="60 us"'
  run $s m80_window problems/m80_window.toml --vary "mesh.refine=$(scaled 0.25),$(scaled 0.5),$(scaled 1)" --set 'end_time="60 us"'
}

scene_needs() {
  local s=scene_needs r
  r=$(scaled 1)
  run $s rz problems/m80_tissue.toml --reference default --set 'end_time="60 us"' --set "mesh.refine=$r" \
    --case "default: " \
    --case "asleep off: numerics.sleeping=false" \
    --case 'uniform: mesh.r.to="64 mm"; mesh.r.size="0.25 mm"; mesh.z.to="148 mm"; mesh.z.size="0.25 mm"' \
    --case "window: deck=problems/m80_window.toml; mesh.refine=$(scaled 0.5)" \
    --case 'near, absorbing: mesh.r.to=["8 mm", "45 mm"]; mesh.r.upper="absorbing"' \
    --case 'near, free: mesh.r.to=["8 mm", "45 mm"]; mesh.r.upper="free"' \
    --case 'tipton: numerics.closure="tipton"' \
    --case 'equal strain: numerics.closure="equal_strain"' \
    --case 'energy return on: numerics.energy_return="on"' \
    --case 'stuck: numerics.sliding=[]'
  run $s dimensions problems/m80_tissue.toml --reference 'RZ' --set 'end_time="30 us"' --set motion.remap_every=1 \
    --case "RZ: mesh.refine=$(scaled 0.5)" \
    --case "quarter 3D: deck=problems/m80_tissue_3d.toml; mesh.refine=$r" \
    --case "half 3D: deck=problems/m80_yaw_3d.toml; mesh.refine=$r; body.0.yaw=0"
}

threads_and_size() {
  local s=threads_and_size t
  for t in 1 2; do
    run $s "m80_$t" problems/m80_tissue.toml --vary "mesh.refine=$(scaled 0.5),$(scaled 1),$(scaled 2)" --threads $t --set 'end_time="10 us"' --set motion.remap_every=1
  done
  mkdir -p docs/studies/$s
  { printf '# `ballast_bench`\n\n```\n'; for t in 1 2; do "$ballast_build/bench/ballast_bench" $t; done; printf '```\n'; } > docs/studies/$s/bench.md
}

chosen=("$@")
[[ ${#chosen[@]} -gt 0 ]] || chosen=(remap_frequency resolution scene_needs threads_and_size)
for study in "${chosen[@]}"; do
  case $study in
  remap_frequency | resolution | scene_needs | threads_and_size) "$study" ;;
  *) stop "no study is called $study" "one of: remap_frequency resolution scene_needs threads_and_size" ;;
  esac
done
