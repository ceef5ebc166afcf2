#!/usr/bin/env bash
# deps.sh run|test|python|bench: makes sure that the system packages of a make target are there.
#
# Says nothing when they are. Otherwise prints the one line that installs the missing ones and runs it: asks first
# when a person is at the terminal, without asking when none is and we are root or sudo needs no password.
set -euo pipefail

# The only list of packages. Debian 12 and Ubuntu 22.04 or later; "package:command" is satisfied by the command, wherever it comes from.
run_packages=(g++:g++ cmake:cmake ninja-build:ninja make:make libeigen3-dev libtomlplusplus-dev nlohmann-json3-dev
              libcli11-dev libfmt-dev zlib1g-dev libtbb-dev libvtk9-dev)
python_packages=(pybind11-dev python3-dev python3-numpy)
test_packages=(libgtest-dev clang-format-14:clang-format-14 clang-tidy-14:clang-tidy-14 emscripten:emcc nodejs:node
               "${python_packages[@]}")
bench_packages=(libbenchmark-dev)

case "${1:-}" in
  run) wanted=("${run_packages[@]}") ;;
  test) wanted=("${run_packages[@]}" "${test_packages[@]}") ;;
  python) wanted=("${run_packages[@]}" "${python_packages[@]}") ;;
  bench) wanted=("${run_packages[@]}" "${bench_packages[@]}") ;;
  *) echo "usage: tools/deps.sh run|test|python|bench" >&2; exit 2 ;;
esac

if ! command -v dpkg-query >/dev/null || ! command -v apt-get >/dev/null; then
  echo "Not a Debian or Ubuntu machine; the build needs the equivalents of: ${wanted[*]%%:*}" >&2
  exit 0
fi

missing=()
for entry in "${wanted[@]}"; do
  package=${entry%%:*}
  command=${entry#"$package"}
  command=${command#:}
  if [ -n "$command" ] && command -v "$command" >/dev/null; then continue; fi
  if [ "$(dpkg-query -W -f '${db:Status-Status}' "$package" 2>/dev/null)" = installed ]; then continue; fi
  missing+=("$package")
done
[ ${#missing[@]} -eq 0 ] && exit 0

as_root=()
[ "$(id -u)" -eq 0 ] || as_root=(sudo)
echo "${as_root[*]:+sudo }apt-get install -y --no-install-recommends ${missing[*]}"

if [ -t 0 ]; then
  read -r -p "Install these packages now? [Y/n] " answer
  case "$answer" in [nN]*) echo "Not installed; run the line above and try again." >&2; exit 1 ;; esac
elif [ ${#as_root[@]} -gt 0 ] && ! sudo -n true 2>/dev/null; then
  echo "Not installed: needs root. Run the line above and try again." >&2
  exit 1
fi
"${as_root[@]}" apt-get update -qq
"${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get install -y -qq --no-install-recommends "${missing[@]}" >&2
