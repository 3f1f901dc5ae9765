#!/usr/bin/env bash
# Gradescope runs this once, as root, when it builds the image.
set -euo pipefail
root=${AUTOGRADER_ROOT:-/autograder}

find_python() { # one that is new enough and can make environments
  for python in ${AUTOGRADER_PYTHON:-python3.14 python3.13 python3.12 python3.11}; do
    if "$python" -c "import ensurepip, venv" 2>/dev/null; then return 0; fi
  done
  return 1
}

if ! find_python; then
  apt-get update
  apt-get install -y python3.11 python3.11-venv || apt-get install -y python3-venv
  find_python
fi
"$python" -m venv "$root/venv"
"$root/venv/bin/python" -m pip install -r "$root/source/requirements.txt"
