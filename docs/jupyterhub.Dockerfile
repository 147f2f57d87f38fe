# Images for Zero to JupyterHub. Built from the root of a checkout:
#     docker build -f docs/jupyterhub.Dockerfile --target student -t ai4u-student:1 .
#     docker build -f docs/jupyterhub.Dockerfile --target hub -t ai4u-hub:1 .
# The project's tests run the script of the RUN steps in an environment of its own, without the extra train. They have no
# container engine: the images as such are not built there.

# has to have the hub's version of jupyterhub; see the chart's release notes
FROM python:3.12-slim AS student
# for the compiled part of worlds, which is faster
RUN apt-get update && apt-get install -y --no-install-recommends gcc libc6-dev && rm -rf /var/lib/apt/lists/*
RUN useradd --create-home --uid 1000 jovyan
COPY . /src
# the PyTorch for processors, 0.7 GB; the one for graphics cards, 5.9 GB: --build-arg PIP_EXTRA_INDEX_URL=
ARG PIP_EXTRA_INDEX_URL=https://download.pytorch.org/whl/cpu
RUN sh /src/docs/jupyterhub_install.sh python3 /src hub,lessons,train
USER jovyan
WORKDIR /home/jovyan
CMD ["jupyterhub-singleuser", "--ip=0.0.0.0"]

FROM quay.io/jupyterhub/k8s-hub:4.2.0 AS hub
USER root
COPY . /src
RUN sh /src/docs/jupyterhub_install.sh python3 /src
USER jovyan
