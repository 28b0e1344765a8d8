# The web server: front end, API, relay. It runs no code of any project.
# Build with BuildKit from the root of the repository: docker build -f docker/web.Dockerfile -t bt-studio-web .
# Secrets, all optional and none of them left in the image: ca (a CA bundle), npmrc.

FROM node:22-bookworm-slim AS frontend
WORKDIR /build/frontend
COPY frontend/package.json frontend/package-lock.json ./
RUN --mount=type=cache,target=/root/.npm --mount=type=secret,id=npmrc,target=/root/.npmrc \
    --mount=type=secret,id=ca,target=/run/secrets/ca.crt \
    if [ -s /run/secrets/ca.crt ]; then export NODE_EXTRA_CA_CERTS=/run/secrets/ca.crt NPM_CONFIG_CAFILE=/run/secrets/ca.crt; fi; \
    npm ci --no-audit --no-fund --loglevel=error
COPY tree_gardener/catalog.json /build/tree_gardener/catalog.json
COPY frontend ./
# Types are checked by `make lint`.
RUN node_modules/.bin/vite build --logLevel warn

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
COPY requirements.lock docker/without.py docker/notices.py docker/web.without ./
RUN --mount=type=cache,target=/root/.cache --mount=type=secret,id=ca,target=/run/secrets/ca.crt \
    if [ -s /run/secrets/ca.crt ]; then export SSL_CERT_FILE=/run/secrets/ca.crt; fi; \
    python3 without.py requirements.lock web.without > web.lock && \
    /build/tools/bin/uv venv -q --python /usr/bin/python3 /opt/bt-studio/.venv && \
    /build/tools/bin/uv pip install -q --link-mode=copy --compile-bytecode --python /opt/bt-studio/.venv/bin/python \
      --no-deps --require-hashes -r web.lock && \
    /opt/bt-studio/.venv/bin/python notices.py > /opt/bt-studio/THIRD-PARTY-NOTICES

# The engine is a distribution of its own.
FROM tools AS engine
COPY tree_gardener tree_gardener
RUN /build/tools/bin/uv pip install -q --no-deps --no-build-isolation --python /build/tools/bin/python \
      --target /build/engine ./tree_gardener && rm -f /build/engine/.lock

FROM python
RUN useradd --uid 10002 --create-home --shell /usr/sbin/nologin studio && \
    install -d -o studio -g studio -m 0700 /var/lib/bt-studio
WORKDIR /opt/bt-studio
COPY --from=packages /opt/bt-studio/.venv .venv
COPY --from=packages /opt/bt-studio/THIRD-PARTY-NOTICES ./
COPY LICENSE ./
COPY --from=frontend /build/frontend/dist frontend/dist
COPY --from=engine /build/engine/ ./
COPY translator translator
COPY examples examples
COPY executor/universes executor/universes
COPY executor/robots executor/robots
COPY executor/*.py executor/
COPY executor/recorder executor/recorder
COPY executor/stream executor/stream
COPY executor/supervision executor/supervision
COPY backend backend
COPY docker/bt-studio.sh /usr/local/bin/bt-studio
RUN python3 -m compileall -q backend translator tree_gardener executor
ENV PATH=/opt/bt-studio/.venv/bin:$PATH PYTHONUNBUFFERED=1 PYTHONDONTWRITEBYTECODE=1 \
    BT_STUDIO_DATA_DIR=/var/lib/bt-studio BT_STUDIO_HOST=0.0.0.0 BT_STUDIO_PORT=8000 BT_STUDIO_LAUNCHER=docker
USER studio
VOLUME /var/lib/bt-studio
EXPOSE 8000
HEALTHCHECK --interval=15s --timeout=10s --start-period=60s --retries=3 \
    CMD ["python", "-m", "backend.config.healthcheck"]
ENTRYPOINT ["bt-studio"]
CMD ["serve", "--no-browser"]
