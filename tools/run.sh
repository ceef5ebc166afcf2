#!/usr/bin/env bash
# run.sh BUILD_FOLDER [OUT_FOLDER]: the demonstration. Steers a 0.035" wire from the groin into the left carotid artery of an
# aorta made in code. The program asks the independent judge about every recorded step and prints its verdict.
set -euo pipefail
exec "$1/apps/cli/endowire" simulate scenes/generated_left_carotid.toml --out "${2:-out/run}"
