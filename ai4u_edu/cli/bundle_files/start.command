#!/bin/sh
# Starts AI4U Edu on a Mac: open it with a double click
cd "$(dirname "$0")" || exit 1
for version in VERSIONS; do
    command -v "python$version" >/dev/null && exec "python$version" start.py "$@"
done
command -v python3 >/dev/null && exec python3 start.py "$@"
echo "Expected Python (VERSIONS) on this machine, and found none." >&2
exit 1
