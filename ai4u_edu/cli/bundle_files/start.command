#!/bin/sh
# Starts AI4U Edu on a Mac: open it with a double click
cd "$(dirname "$0")" || exit 1
# a name may be a version manager's, which starts no Python
for python in PYTHONS python3; do
    "$python" -c "" >/dev/null 2>&1 && exec "$python" start.py "$@"
done
echo "Expected Python (VERSIONS) on this machine, and found none." >&2
exit 1
