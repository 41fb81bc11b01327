#!/usr/bin/env bash
# The wrapper ./geodrop in a tree that may not be written: runs what is built, says in one line that something is to be built.
set -euo pipefail
source_tree=$(dirname -- "$(readlink -f -- "${BASH_SOURCE[0]}")")/..
tree=$(mktemp -d)
trap 'chmod -R u+w "$tree"; rm -rf "$tree"' EXIT

fail() {
  echo "FAILED: $*" >&2
  exit 1
}

# As a user who is not root: root may write everywhere.
wrapper() {
  local become=()
  ((EUID != 0)) || become=(setpriv --reuid=65534 --regid=65534 --clear-groups)
  (cd / && GEODROP_SKIP_PACKAGES=1 "${become[@]}" "$tree/geodrop" "$@")
}

mkdir -p "$tree"/{src,include,cmake,build/release}
cp "$source_tree/geodrop" "$tree"
touch "$tree"/{src/main.cpp,CMakeLists.txt,CMakePresets.json,cmake/packages.txt,build/.lock}
printf '#!/bin/sh\necho "ran $*"\n' >"$tree/build/release/geodrop"
chmod 755 "$tree/build/release/geodrop"
touch -d '1 minute ago' "$tree"/{src,include,cmake,src/main.cpp,CMakeLists.txt,CMakePresets.json,cmake/packages.txt}
chmod -R a-w,a+rX "$tree"

[[ $(wrapper check a.toml 2>&1) == "ran check a.toml" ]] || fail "what is built does not run: $(wrapper check a.toml 2>&1)"

chmod u+w "$tree/src/main.cpp"
touch -d '1 minute' "$tree/src/main.cpp"
chmod a-w "$tree/src/main.cpp"
for arguments in --version test; do
  code=0
  said=$(wrapper "$arguments" 2>&1) || code=$?
  [[ $code == 70 ]] || fail "$arguments ends with $code"
  [[ $said == "geodrop: something is to be built, but $tree/build may not be written; "* ]] || fail "$arguments says: $said"
  [[ $said != *$'\n'* ]] || fail "$arguments says more than a line: $said"
done
echo "the wrapper runs what is built and says what is not"
