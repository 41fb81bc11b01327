#!/usr/bin/env bash
# The program as `cmake --install` leaves it, for a user who may not write there: its cases are found from any directory, files of
# the user go before them; manual, completion and the links of the pages are there. Called as installed.sh BUILD_DIRECTORY.
set -euo pipefail
place=$(mktemp -d)
prefix=$place/usr work=$place/work
trap 'chmod -R u+w "$place"; rm -rf "$place"' EXIT

fail() {
  echo "FAILED: $*" >&2
  exit 1
}

cmake --install "$1" --strip --prefix "$prefix" >/dev/null # as in a package
mkdir "$work"
chmod 755 "$place"
chmod -R a-w,a+rX "$prefix"
become=()
((EUID != 0)) || { become=("$(type -P setpriv)" --reuid=65534 --regid=65534 --clear-groups) && chown 65534 "$work"; } # root may write everywhere
cd "$work"

# says CODE TEXT ARGUMENTS...: the program ends with this code and says this among others.
says() {
  local code=0 said
  said=$("${become[@]}" "$prefix/bin/geodrop" "${@:3}" 2>&1) || code=$?
  [[ $code == "$1" ]] || fail "${*:3} ends with $code, not $1: $said"
  [[ $said == *"$2"* ]] || fail "${*:3} does not say $2: $said"
}

cases=$prefix/share/geodrop/cases
says 0 "$cases/dump_round_container.toml: no mistakes found" check dump_round_container
says 0 "$cases/dump_round_container.toml: no mistakes found" check cases/dump_round_container.toml
says 0 "$cases/verification/apart.toml: no mistakes found" check apart.toml
says 0 'particles_to_grid' stages elastic_bar
says 75 "scene $cases/dump_round_container.toml" run dump_round_container --until 1e-5 --threads 1
[[ -e runs/dump_round_container/checkpoint.bin ]] || fail "a run of a case is not below runs/"
says 0 'case_002' sweep elastic_bar --vary grid.spacing=0.25,0.5 --no-run
says 0 'mine.toml' new mine --from elastic_bar

# A user's own files go before the cases, and what is nowhere is refused as ever.
echo 'title = 1' | "${become[@]}" tee elastic_bar.toml own.toml >/dev/null
"${become[@]}" mkdir cases
"${become[@]}" cp elastic_bar.toml cases/geotube_556.toml
says 2 'elastic_bar.toml:1:9: title: found 1 (a whole number)' check elastic_bar
says 2 'elastic_bar.toml:1:9: title: found 1 (a whole number)' check elastic_bar.toml
says 2 'cases/geotube_556.toml:1:9: title: found 1 (a whole number)' check cases/geotube_556.toml
says 2 'own.toml:1:9: title: found 1 (a whole number)' check own
for nowhere in nowhere nowhere.toml cases/nowhere.toml ./capstan.toml other/capstan.toml /capstan.toml; do
  says 2 "$nowhere: found no such file; allowed: a scene in TOML" check "$nowhere"
done

# The table is found: without valgrind on the path that is what is missed, with it there is a count.
PATH=$prefix/bin says 2 'valgrind: --instructions: found no such program' bench --instructions
if type -P valgrind >/dev/null; then
  code=0
  said=$("${become[@]}" "$prefix/bin/geodrop" bench --instructions --only =water_2d_linear) || code=$?
  [[ $code -le 2 && $said == *"1 benchmarks:"* ]] || fail "bench --instructions ends with $code: $said" # the table may lack this build
fi

grep -q '^\.SS geodrop run$' "$prefix/share/man/man1/geodrop.1" || fail "no manual"
# shellcheck source=/dev/null
completed=$(source "$prefix/share/bash-completion/completions/geodrop" && COMP_WORDS=(geodrop sn) COMP_CWORD=1 && _geodrop && echo "${COMPREPLY[*]}")
[[ $completed == snapshot ]] || fail "sn is completed to $completed"
documents=$prefix/share/doc/geodrop
while IFS=: read -r page link; do
  target=${link#*](} && target=${target%[)#]}
  [[ -e ${page%/*}/$target ]] || fail "${page#"$documents"/} links to $target, which is not installed"
done < <(cd / && grep -roHE --include='*.md' '\]\([^)#:]+[)#]' "$documents")
echo "what is installed runs for any user"
