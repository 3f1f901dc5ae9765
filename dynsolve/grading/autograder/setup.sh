#!/usr/bin/env bash
# Gradescope runs this once, as root, when it builds the image.
set -euo pipefail
root=${AUTOGRADER_ROOT:-/autograder}
python=${AUTOGRADER_PYTHON:-}
for version in 3.14 3.13 3.12 3.11; do
  [ -n "$python" ] || python=$(command -v "python$version" || true)
done
if [ -z "$python" ]; then
  apt-get update && apt-get install -y python3.11 python3.11-venv
  python=python3.11
fi
"$python" -m venv "$root/venv" || { apt-get install -y "${python##*/}-venv" && "$python" -m venv "$root/venv"; }
"$root/venv/bin/python" -m pip install -r "$root/source/requirements.txt"
