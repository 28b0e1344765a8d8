# The keeper, which alone holds Docker's socket, the gate, to which every session may speak, and the relay of a further
# machine, which is reached from the network: three programs, each in a container of its own (docker/compose.yaml,
# docker/compose.host.yaml). Python's standard library and nothing else.
FROM debian:bookworm-slim AS python
RUN apt-get update -q && DEBIAN_FRONTEND=noninteractive \
    apt-get install -y -q --no-install-recommends python3 ca-certificates && rm -rf /var/lib/apt/lists/* /var/log/*

FROM python
RUN useradd --uid 10003 --no-create-home --home-dir /tmp --shell /usr/sbin/nologin keeper && \
    useradd --uid 10004 --no-create-home --home-dir /tmp --shell /usr/sbin/nologin gate && \
    useradd --uid 10006 --no-create-home --home-dir /tmp --shell /usr/sbin/nologin relay && \
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
COPY backend/sessions/relay backend/sessions/relay
RUN python3 -m compileall -q backend
ENV PYTHONUNBUFFERED=1 PYTHONDONTWRITEBYTECODE=1
USER keeper
HEALTHCHECK --interval=10s --timeout=5s --start-period=10s --retries=3 \
    CMD ["python3", "-m", "backend.sessions.keeper", "--check"]
ENTRYPOINT ["python3", "-m", "backend.sessions.keeper"]
