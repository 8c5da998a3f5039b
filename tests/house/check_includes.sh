#!/usr/bin/env bash
# Fails on an include that points up (floors of docs/architecture.md) and on a header that includes
# a heavy library (VTK, HDF5, toml++, CLI11, SUNDIALS, MPI): those belong in .cpp files.
#
#   check_includes.sh ROOT         checks the tree
#   check_includes.sh --self-test  checks that the check finds what it should
set -euo pipefail

# What a folder may include besides itself.
declare -A allowed=(
  [core]=""
  [core/io]="core"
  [eos]="core"
  [materials]="eos core"
  [remap]="core"
  [ale]="materials remap eos core"
  [post]="core core/io"
  [problems]="ale materials remap eos core core/io post"
  [bench]="problems ale materials remap eos core core/io"
  [tests]="problems post ale materials remap eos core core/io"
)
folders='core|eos|materials|remap|ale|post|problems|bench|tests'
quoted='[<"]([^>"]*)'
heavy='vtk[A-Z]|hdf5|H5[A-Z]|toml\+\+/|toml\.hpp|CLI/|sundials/|nvector/|sunmatrix/|sunlinsol/|cvode/|arkode/|mpi\.h'

set_floor() { # variable, path in the tree: no subshell, there are hundreds of includes
  case $2 in core/io/*) printf -v "$1" core/io ;; *) printf -v "$1" '%s' "${2%%/*}" ;; esac
}

# Prints each fault as file:line: what; nothing if there is none.
faults() {
  local root=$1 place file line text target from to
  cd "$root"
  local -a there=()
  for target in ${folders//|/ }; do [[ ! -d $target ]] || there+=("$target"); done
  while IFS= read -r place; do
    file=${place%%:*} text=${place#*:}
    line=${text%%:*} text=${text#*:}
    [[ $text =~ $quoted ]]
    target=${BASH_REMATCH[1]}
    if [[ $target == *../* ]]; then
      echo "$file:$line: '$target' climbs; name the folder from the top"
    elif [[ $target =~ ^($folders)/ ]]; then
      set_floor from "$file"
      set_floor to "$target"
      [[ $from == "$to" || " ${allowed[$from]} " == *" $to "* ]] ||
        echo "$file:$line: $from must not include $to ('$target'); below it: ${allowed[$from]:-nothing}"
    elif [[ $file == *.hpp && $target =~ ^($heavy) ]]; then
      echo "$file:$line: '$target' belongs in a .cpp file"
    fi
  done < <(grep -rnE --include='*.hpp' --include='*.cpp' '^[[:space:]]*#[[:space:]]*include' "${there[@]}" |
    grep -E "[<\"]($folders)/|\.\./|[<\"]($heavy)")
}

self_test() {
  local found
  tree=$(mktemp -d)
  trap 'rm -rf "$tree"' EXIT
  mkdir -p "$tree"/{core/io,eos,materials,remap,ale,tests}
  echo '#include "eos/eos.hpp"' >"$tree/core/a.hpp"
  echo '#include "core/io/vtk.hpp"' >"$tree/core/b.cpp"
  echo '#include "eos/eos.hpp"' >"$tree/remap/c.cpp"
  echo '  #  include <materials/strength.hpp>' >"$tree/remap/d.cpp"
  echo '#include "tests/exact/noh.hpp"' >"$tree/ale/e.cpp"
  echo '#include <vtkPoints.h>' >"$tree/core/io/f.hpp"
  echo '#include "../core/grid.hpp"' >"$tree/eos/g.hpp"
  printf '%s\n' '#include "core/grid.hpp"' '#include <vector>' >"$tree/eos/good.hpp"
  echo '#include <hdf5.h>' >"$tree/core/io/good.cpp"
  found=$(faults "$tree" | cut -d: -f1 | sort | tr '\n' ' ')
  [[ $found == "ale/e.cpp core/a.hpp core/b.cpp core/io/f.hpp eos/g.hpp remap/c.cpp remap/d.cpp " ]] ||
    { echo "found only: $found"; exit 1; }
}

if [[ $1 == --self-test ]]; then
  self_test
else
  found=$(faults "$1")
  [[ -z $found ]] || { echo "$found"; exit 1; }
fi
