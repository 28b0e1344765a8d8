# The keeper: the only one that holds Docker's socket. Python's standard library and nothing else.
FROM debian:bookworm-slim AS python
RUN apt-get update -q && DEBIAN_FRONTEND=noninteractive \
    apt-get install -y -q --no-install-recommends python3 ca-certificates && rm -rf /var/lib/apt/lists/* /var/log/*

FROM python
WORKDIR /opt/bt-studio
COPY backend/__init__.py backend/__init__.py
COPY backend/sessions/__init__.py backend/sessions/__init__.py
COPY backend/sessions/keeper backend/sessions/keeper
RUN python3 -m compileall -q backend
ENV PYTHONUNBUFFERED=1 PYTHONDONTWRITEBYTECODE=1
HEALTHCHECK --interval=10s --timeout=5s --start-period=10s --retries=3 \
    CMD ["python3", "-m", "backend.sessions.keeper", "--check"]
ENTRYPOINT ["python3", "-m", "backend.sessions.keeper"]
