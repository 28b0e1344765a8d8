# A stand-in for node:22-bookworm-slim, from the Node.js of this machine, which is the build context.
FROM debian:bookworm-slim
RUN apt-get update -q && apt-get install -y -q --no-install-recommends libstdc++6 && rm -rf /var/lib/apt/lists/*
COPY node /usr/local/bin/node
COPY npm /usr/local/lib/node_modules/npm
RUN ln -s ../lib/node_modules/npm/bin/npm-cli.js /usr/local/bin/npm && node --version && npm --version
