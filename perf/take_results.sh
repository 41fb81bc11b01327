#!/usr/bin/env bash
# Takes all committed results of this machine anew: perf/take_results.sh MACHINE, e.g. zen4-2core. About an hour on an
# otherwise idle machine; load.txt tells whether it was one.
set -euo pipefail
machine=${1:?usage: perf/take_results.sh MACHINE}
cd "$(dirname -- "${BASH_SOURCE[0]}")/.."
results=perf/results/$machine
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
mkdir -p "$results"

load() { cut -d' ' -f1-3 /proc/loadavg; }
echo "before: $(load)" >"$results/load.txt"
threads=(1)
(($(nproc) == 1)) || threads+=("$(nproc)")
for n in "${threads[@]}"; do
  for size in 1e5 1e6; do
    quick=()
    [[ $size == 1e6 ]] || quick=(--quick)
    ./geodrop bench "${quick[@]}" --threads "$n" --output "$scratch"
    mv "$scratch/bench.csv" "$results/bench_${size}_${n}thread$( ((n == 1)) || echo s).csv"
  done
done

# The check runs with 1e5 particles: one table of its ratios, for both numbers of threads.
awk -F, 'FNR == 1 { for (c = 1; c <= NF; ++c) at[$c] = c; if (NR > 1) next }
         { print $at["name"] "," $at["particles"] "," $at["threads"] "," $at["ratio"] "," $at["processor"] }' \
  "$results"/bench_1e5_*.csv >"$results/ratios.csv"

./geodrop bench --growth --output "$scratch"
mv "$scratch/growth.csv" "$results/growth.csv"
perf/plot_growth.py "$results/growth.csv"
perf/work_precision.py "$results"
echo "after: $(load)" >>"$results/load.txt"
