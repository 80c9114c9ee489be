#!/bin/sh
# All linters, each to its end; the status is 0 if all of them are content.
set -u
cd "$(dirname "$0")/.." || exit
status=0
.venv/bin/python -m mypy & # takes longest, and one processor of several
.venv/bin/python -m ruff check . || status=1
.venv/bin/python -m ruff format --check . || status=1
.venv/bin/python -m vulture || status=1
wait $! || status=1
exit $status
