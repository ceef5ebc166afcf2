#!/usr/bin/env bash
# run.sh BUILD_FOLDER [OUT_FOLDER]: the demonstration. Pushes a 0.035" wire from the iliac access to the aortic arch of a patient's
# vessel when that data lies beside the project, else through a tree of tubes made in code, and lets the
# independent judge look at every recorded step.
set -euo pipefail
build=$1
out=${2:-out/run}
shared_vessel=../shared/vessels/femoral_to_neuro/lumen_mm.stl
if [ -f "$shared_vessel" ]; then
  scene=scenes/femoral_entry.toml
  vessel=$shared_vessel
else
  scene=scenes/generated_entry.toml
  vessel=$out/vessel.stl
fi
"$build/apps/cli/endowire" simulate "$scene" --out "$out"
if [ -f "$vessel" ]; then "$build/tools/check_crossings/check_crossings" "$out/wire.pvd" "$vessel"; fi
