# The head and the workers of an evaluation on Kubernetes: the executor with Ray (docker/kubernetes-evaluations).
# Build with BuildKit from the root of the repository, after bt-studio-executor:
#   docker build -f docker/evaluation.Dockerfile -t bt-studio-evaluation .
# Secret, optional and not left in the image: ca (a CA bundle).

FROM debian:bookworm-slim AS tools
RUN apt-get update -q && DEBIAN_FRONTEND=noninteractive \
    apt-get install -y -q --no-install-recommends python3-venv ca-certificates && rm -rf /var/lib/apt/lists/*
WORKDIR /build
COPY requirements-build.lock ./
RUN --mount=type=cache,target=/root/.cache --mount=type=secret,id=ca,target=/run/secrets/ca.crt \
    if [ -s /run/secrets/ca.crt ]; then export PIP_CERT=/run/secrets/ca.crt; fi; \
    python3 -m venv /build/tools && /build/tools/bin/pip install -q --require-hashes -r requirements-build.lock

FROM bt-studio-executor AS packages
USER root
COPY --from=tools /build/tools /build/tools
COPY docker/evaluation.lock docker/notices.py /build/
RUN --mount=type=cache,target=/root/.cache --mount=type=secret,id=ca,target=/run/secrets/ca.crt \
    if [ -s /run/secrets/ca.crt ]; then export SSL_CERT_FILE=/run/secrets/ca.crt; fi; \
    /build/tools/bin/uv pip install -q --link-mode=copy --compile-bytecode --python /opt/bt-studio/.venv/bin/python \
      --no-deps --require-hashes -r /build/evaluation.lock && \
    cd /build && /opt/bt-studio/.venv/bin/python notices.py > /opt/bt-studio/THIRD-PARTY-NOTICES

FROM bt-studio-executor
COPY --from=packages /opt/bt-studio/.venv .venv
COPY --from=packages /opt/bt-studio/THIRD-PARTY-NOTICES ./
# KubeRay starts `ray start` in place of this, and Ray the manager.
ENTRYPOINT []
CMD ["ray", "--version"]
HEALTHCHECK NONE
