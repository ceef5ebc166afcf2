#!/usr/bin/env bash
# run.sh BUILD_FOLDER [OUT_FOLDER]: the demonstration. Pushes a 0.035" wire from the iliac access to the aortic arch of a
# patient's vessel when that data lies beside the project, else through an aorta made in code. The program
# asks the independent judge about every recorded step and prints its verdict.
set -euo pipefail
scene=scenes/generated_entry.toml
[ ! -f ../shared/vessels/femoral_to_neuro/lumen_mm.stl ] || scene=scenes/femoral_entry.toml
exec "$1/apps/cli/endowire" simulate "$scene" --out "${2:-out/run}"
