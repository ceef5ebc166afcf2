#!/usr/bin/env bash
# bench.sh FOLDER: runs every benchmark of a build folder. What they print and write is kept in bench/results, a folder a machine.
set -euo pipefail
cd "$(dirname "$0")/.."
programs=$1
out=bench/results/$("$programs/bench_scenarios" --machine)
mkdir -p "$out"

others=()
for program in "$programs"/bench_*; do
  case "${program##*/}" in bench_parts | bench_scenarios | bench_compare) ;; *) [ -x "$program" ] && [ -f "$program" ] && others+=("${program##*/}") ;; esac
done
all=(bench_parts "${others[@]}" bench_scenarios)  # what matters most stands last
for i in "${!all[@]}"; do
  echo "== $((i + 1)) of ${#all[@]}: ${all[i]}"
  "$programs/${all[i]}" 2>&1 | tee "$out/${all[i]}.txt"
done
echo "kept: $out"
