# One running robot: manager, world and application. The same image holds what reads a user's Python for the editor.
# It has no network of its own (docs/explanation/deployment.md).
# Build with BuildKit from the root of the repository: docker build -f docker/executor.Dockerfile -t bt-studio-executor .
# Secret, optional and not left in the image: ca (a CA bundle).

FROM debian:bookworm-slim AS python
RUN apt-get update -q && DEBIAN_FRONTEND=noninteractive \
    apt-get install -y -q --no-install-recommends python3 ca-certificates && rm -rf /var/lib/apt/lists/* /var/log/*

FROM python AS tools
RUN apt-get update -q && DEBIAN_FRONTEND=noninteractive \
    apt-get install -y -q --no-install-recommends python3-venv python3-dev g++ && rm -rf /var/lib/apt/lists/*
WORKDIR /build
COPY requirements-build.lock ./
RUN --mount=type=cache,target=/root/.cache --mount=type=secret,id=ca,target=/run/secrets/ca.crt \
    if [ -s /run/secrets/ca.crt ]; then export PIP_CERT=/run/secrets/ca.crt; fi; \
    python3 -m venv /build/tools && /build/tools/bin/pip install -q --require-hashes -r requirements-build.lock

FROM tools AS packages
COPY requirements.lock docker/without.py docker/notices.py docker/executor.without ./
RUN --mount=type=cache,target=/root/.cache --mount=type=secret,id=ca,target=/run/secrets/ca.crt \
    if [ -s /run/secrets/ca.crt ]; then export SSL_CERT_FILE=/run/secrets/ca.crt; fi; \
    python3 without.py requirements.lock executor.without > executor.lock && \
    /build/tools/bin/uv venv -q --python /usr/bin/python3 /opt/bt-studio/.venv && \
    /build/tools/bin/uv pip install -q --link-mode=copy --compile-bytecode --python /opt/bt-studio/.venv/bin/python \
      --no-deps --require-hashes -r executor.lock && \
    /opt/bt-studio/.venv/bin/python notices.py > /opt/bt-studio/THIRD-PARTY-NOTICES
# Message packages without a wheel: tf2_msgs, nav2_msgs …
COPY executor/__init__.py /opt/bt-studio/executor/__init__.py
COPY executor/ros /opt/bt-studio/executor/ros
RUN --mount=type=cache,target=/root/.cache --mount=type=secret,id=ca,target=/run/secrets/ca.crt \
    if [ -s /run/secrets/ca.crt ]; then export SSL_CERT_FILE=/run/secrets/ca.crt; fi; \
    cd /opt/bt-studio && ln -s /build/tools/bin/uv .venv/bin/uv && \
    .venv/bin/python -m executor.ros.build_interfaces && test -f .venv/share/bt_studio_interfaces/complete && rm .venv/bin/uv
# What a language server is shown: the engine, and stubs of ROS messages.
COPY backend/__init__.py /build/backend/__init__.py
COPY executor/ros_python /opt/bt-studio/executor/ros_python
COPY backend/language/__init__.py backend/language/library.py backend/language/message_stubs.py \
     backend/language/rclpy_types.py /build/backend/language/
RUN /opt/bt-studio/.venv/bin/python -m backend.language.library \
      /opt/bt-studio/.venv/lib/python3.11/site-packages /opt/bt-studio /opt/bt-studio/library

# The engine is a distribution of its own.
FROM tools AS engine
COPY tree_gardener tree_gardener
RUN /build/tools/bin/uv pip install -q --no-deps --no-build-isolation --python /build/tools/bin/python \
      --target /build/engine ./tree_gardener && rm -f /build/engine/.lock

FROM python
RUN apt-get update -q && DEBIAN_FRONTEND=noninteractive \
    apt-get install -y -q --no-install-recommends libegl1 libgl1-mesa-dri && rm -rf /var/lib/apt/lists/* /var/log/*
RUN useradd --uid 10001 --no-create-home --home-dir /tmp --shell /usr/sbin/nologin robot
WORKDIR /opt/bt-studio
COPY --from=packages /opt/bt-studio/.venv .venv
COPY --from=packages /opt/bt-studio/THIRD-PARTY-NOTICES ./
COPY LICENSE ./
COPY --from=packages /opt/bt-studio/library library
COPY --from=engine /build/engine/ ./
COPY translator translator
COPY executor executor
RUN .venv/bin/python -m compileall -q executor translator tree_gardener
ENV PATH=/opt/bt-studio/.venv/bin:$PATH PYTHONUNBUFFERED=1 PYTHONDONTWRITEBYTECODE=1 HOME=/tmp
USER robot
HEALTHCHECK --interval=15s --timeout=5s --start-period=20s --retries=3 \
    CMD ["python", "-c", "import urllib.request as r; r.urlopen('http://127.0.0.1:7163/health', timeout=4)"]
ENTRYPOINT ["python", "-m", "executor.manager"]
CMD ["--host", "127.0.0.1", "--port", "7163"]
