# A stand-in for caddy:2, from Debian's package.
FROM debian:bookworm-slim
RUN apt-get update -q && DEBIAN_FRONTEND=noninteractive \
    apt-get install -y -q --no-install-recommends caddy && rm -rf /var/lib/apt/lists/*
ENTRYPOINT ["caddy"]
