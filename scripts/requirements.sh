#!/bin/sh
# Pin every package that pyproject.toml leads to, with the hashes of all its files: for Linux, macOS
# and Windows, and Python 3.11 and newer, in one resolution. Pins stay where they still fit;
# `--upgrade` takes the newest. Writes no address of an index: whoever installs uses his own.
set -eu
cd "$(dirname "$0")/.."

.venv/bin/python -m uv --version >/dev/null 2>&1 || .venv/bin/python -m pip install --quiet uv

pin() {
    .venv/bin/python -m uv pip compile --quiet --universal --python-version 3.11 --generate-hashes \
        --fork-strategy fewest --no-emit-index-url --no-emit-find-links \
        --custom-compile-command 'make requirements' "$@" >/dev/null
}

pin pyproject.toml --group install --output-file requirements.txt "$@"
pin --group dev --constraint requirements.txt --output-file requirements-dev.txt "$@"
