# TLS in front of the web servers: Caddy, with an account of its own and no capability.
# Build from the root of the repository: docker build -f docker/caddy.Dockerfile -t bt-studio-caddy .
FROM caddy:2 AS caddy
# A copy has no file capabilities: with them the program could not start in a container that drops all.
RUN cp /usr/bin/caddy /caddy

FROM debian:bookworm-slim
RUN apt-get update -q && DEBIAN_FRONTEND=noninteractive \
    apt-get install -y -q --no-install-recommends ca-certificates && rm -rf /var/lib/apt/lists/* /var/log/*
RUN useradd --uid 10005 --no-create-home --home-dir /data --shell /usr/sbin/nologin caddy && \
    install -d -o caddy -g caddy -m 0700 /data
COPY --from=caddy /caddy /usr/bin/caddy
COPY --chmod=0644 docker/caddy/Caddyfile /etc/caddy/Caddyfile
COPY --chmod=0644 docker/caddy/tls/*.caddy /etc/caddy/tls/
ENV HOME=/data XDG_DATA_HOME=/data XDG_CONFIG_HOME=/data/config
USER caddy
VOLUME /data
EXPOSE 80 443
HEALTHCHECK --interval=5s --timeout=5s --start-period=10s --retries=3 \
    CMD ["bash", "-c", "exec 3<>/dev/tcp/127.0.0.1/2020 && printf 'GET / HTTP/1.0\\r\\n\\r\\n' >&3 && grep -q '200 OK' <&3"]
ENTRYPOINT ["caddy"]
CMD ["run", "--config", "/etc/caddy/Caddyfile"]
