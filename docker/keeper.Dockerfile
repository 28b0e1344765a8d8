# The keeper, which alone holds Docker's socket, and the gate, to which every session may speak: two programs, each in a
# its own container (docker/compose.yaml). Python's standard library and nothing else.
FROM debian:bookworm-slim AS python
RUN apt-get update -q && DEBIAN_FRONTEND=noninteractive \
    apt-get install -y -q --no-install-recommends python3 ca-certificates && rm -rf /var/lib/apt/lists/* /var/log/*

FROM python
RUN useradd --uid 10003 --no-create-home --home-dir /tmp --shell /usr/sbin/nologin keeper && \
    useradd --uid 10004 --no-create-home --home-dir /tmp --shell /usr/sbin/nologin gate && \
    install -d -o keeper -g keeper -m 0755 /run/bt-studio-keeper && \
    install -d -o gate -g gate -m 0711 /run/bt-studio && \
    install -d -o gate -g keeper -m 2750 /run/bt-studio-control
WORKDIR /opt/bt-studio
COPY LICENSE docker/notices.py ./
RUN python3 notices.py > /opt/bt-studio/THIRD-PARTY-NOTICES && rm notices.py
COPY backend/__init__.py backend/confine.py backend/
COPY backend/sessions/__init__.py backend/sessions/__init__.py
COPY backend/sessions/gate backend/sessions/gate
COPY backend/sessions/keeper backend/sessions/keeper
RUN python3 -m compileall -q backend
ENV PYTHONUNBUFFERED=1 PYTHONDONTWRITEBYTECODE=1
USER keeper
HEALTHCHECK --interval=10s --timeout=5s --start-period=10s --retries=3 \
    CMD ["python3", "-m", "backend.sessions.keeper", "--check"]
ENTRYPOINT ["python3", "-m", "backend.sessions.keeper"]
