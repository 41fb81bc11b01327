#!/usr/bin/env bash
# Takes committed results of this machine anew: perf/take_results.sh MACHINE [PART...], e.g. zen4-2core bench_1e5.
# Parts, and minutes on two idle cores: bench_1e5 (4), bench_1e6 (40), growth (20), precision (15); without any all of them.
# load.txt tells how busy the machine was before and after each.
set -euo pipefail
machine=${1:?usage: perf/take_results.sh MACHINE [bench_1e5] [bench_1e6] [growth] [precision]}
shift
(($# > 0)) || set -- bench_1e5 bench_1e6 growth precision
cd "$(dirname -- "${BASH_SOURCE[0]}")/.."
results=perf/results/$machine
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
mkdir -p "$results"

bench() {
  local size=$1 threads=$2
  local table=$results/bench_${size}_${threads}thread options=()
  ((threads == 1)) || table+=s
  [[ $size == 1e6 ]] || options=(--quick)
  ./geodrop bench "${options[@]}" --threads "$threads" --output "$scratch"
  mv "$scratch/bench.csv" "$table.csv"
}

take() {
  case $1 in
    bench_*)
      bench "${1#bench_}" 1
      (($(nproc) == 1)) || bench "${1#bench_}" "$(nproc)"
      ;;
    growth)
      ./geodrop bench --growth --output "$scratch"
      mv "$scratch/growth.csv" "$results/growth.csv"
      perf/plot_growth.py "$results/growth.csv"
      ;;
    precision) perf/work_precision.py "$results" ;;
    *) echo "take_results.sh: no part $1" >&2 && return 2 ;;
  esac
}

load() { cut -d' ' -f1-3 /proc/loadavg; }
for part; do
  before=$(load)
  take "$part"
  # One line a part: what a line is missing of was not taken to its end.
  touch "$results/load.txt"
  sed -i "/^$part: /d" "$results/load.txt"
  echo "$part: before $before, after $(load), $(date -u +%F), $(git describe --always --dirty)" >>"$results/load.txt"
done
