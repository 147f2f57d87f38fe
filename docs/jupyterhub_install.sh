#!/bin/sh
# Installs AI4U Edu where the servers or the class of a JupyterHub run:
#     jupyterhub_install.sh PYTHON SOURCE EXTRAS
# PYTHON: the interpreter; SOURCE: a checkout or wheel of AI4U Edu;
# EXTRAS: such as hub,lessons,train for a student's server. Empty for the class alone.
set -eu
python=$1 source=$2 extras=${3-}
"$python" -m pip install --no-cache-dir "$source${extras:+[$extras]}"
"$python" -m ai4u_edu --version
