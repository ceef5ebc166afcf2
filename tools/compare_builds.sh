#!/usr/bin/env bash
# compare_builds.sh BASE [ROUNDS [SCENARIO ...]]: is the working tree faster than the revision BASE, and does it give the same states?
#
# Builds both for release (BASE in a worktree under build/, with the bench/ of this tree: one program measures both) and has
# bench_compare play the scenarios in turns, old new new old …, in one run. What counts is the ratio: this machine's own speed cancels.
# BASE must know the stages of a step (Simulation::observe_stages).
set -euo pipefail
cd "$(dirname "$0")/.."
base=$(git rev-parse --verify "${1:?usage: tools/compare_builds.sh BASE [ROUNDS [SCENARIO ...]]}^{commit}")
rounds=${2:-5}
shift; [ $# -gt 0 ] && shift
tree=build/compare/tree
mkdir -p build/compare
git worktree prune
if [ -d "$tree" ]; then git -C "$tree" checkout --quiet --force --detach "$base" && git -C "$tree" clean -fdq; else git worktree add --quiet --detach "$tree" "$base"; fi
rm -rf "$tree/bench" && cp -R bench "$tree/bench"
# Scenes are found from each tree, and the vessels beside it.
[ -d ../shared ] && ln -sfn "$(cd ../shared && pwd)" build/compare/shared

launcher=$(command -v ccache >/dev/null && echo -DCMAKE_CXX_COMPILER_LAUNCHER=ccache || true)
build() {  # source folder, build folder
  cmake -S "$1" -B "$2" -G Ninja -DCMAKE_BUILD_TYPE=Release -DENDOWIRE_TESTS=OFF -DENDOWIRE_BENCH=ON $launcher > "$2.log"
  cmake --build "$2" --parallel "${JOBS:-$(nproc)}" --target bench_scenarios bench_compare >> "$2.log" || { tail -40 "$2.log"; exit 1; }
}
echo "building $(git log -1 --format='%h %s' "$base")"
build "$tree" build/compare/base
echo "building the working tree ($(git describe --always --dirty))"
build . build/compare/here
exec build/compare/here/bench/bench_compare build/compare/base/bench/bench_scenarios build/compare/here/bench/bench_scenarios "$rounds" "$@"
