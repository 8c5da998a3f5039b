#!/usr/bin/env bash
# check_readme.sh PROGRAM ROOT: the deck in README.md is valid.
set -euo pipefail
deck=$(mktemp --suffix=.toml)
trap 'rm -f "$deck"' EXIT
# shellcheck disable=SC2016 # backquotes of Markdown
sed -n '/^```toml$/,/^```$/{/^```/d;p}' "$2/README.md" >"$deck"
[[ -s $deck ]] || { echo "README.md holds no deck"; exit 1; }
"$1" check "$deck"
