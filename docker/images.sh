#!/usr/bin/env bash
# Builds BT Studio's images: bt-studio-web, bt-studio-executor, bt-studio-keeper, bt-studio-caddy.
#
# The images that theirs start from are pulled, by the digests of docker/bases/digests where it has them. Where no registry is reachable they are made on this machine,
# which takes root and Debian's debootstrap, and tagged with the names that the Dockerfiles use.
#
#   docker/images.sh [TAG]          (the tag is "latest" by default)
#
#   DOCKER               the docker program
#   BT_STUDIO_CA         a CA bundle for the package registries, given to the build as a secret
#   BT_STUDIO_NPMRC      npm's settings, given to the build as a secret
#   BT_STUDIO_NO_PULL=1  does not ask a registry at all
set -euo pipefail
cd "$(dirname "$0")/.."
tag=${1:-latest}
docker=${DOCKER:-docker}
digests=${BT_STUDIO_DIGESTS:-docker/bases/digests}
pull_s=300
export DOCKER_BUILDKIT=1
work=$(mktemp -d)
trap 'kill $(jobs -p) 2>/dev/null || true; rm -rf "$work"' EXIT

say() { echo "images: $*"; }

secrets=()
if [ -n "${BT_STUDIO_CA:-}" ]; then secrets+=(--secret "id=ca,src=$BT_STUDIO_CA"); fi
if [ -n "${BT_STUDIO_NPMRC:-}" ]; then secrets+=(--secret "id=npmrc,src=$BT_STUDIO_NPMRC"); fi

build() { "$docker" build --quiet --network=host ${secrets[@]+"${secrets[@]}"} "$@" >/dev/null; }

has() { "$docker" image inspect "$1" >/dev/null 2>&1; }

# The digest of an image in docker/bases/digests; empty where only its name is known.
digest() { sed -n "s/^$1 \(sha256:[0-9a-f]\{64\}\)$/\1/p" "$digests"; }

# Succeeds if the local image has the digest, or, without a digest, if there is an image.
has_locked() {
  local digest; digest=$(digest "$1")
  if [ -z "$digest" ]; then has "$1"; return; fi
  "$docker" image inspect --format '{{join .RepoDigests "\n"}}' "$1" 2>/dev/null | grep -q "@$digest$"
}

# Pulls by digest where it is known, since a tag may be moved to another image.
pull() {
  local digest name=${1%%:*}
  digest=$(digest "$1")
  if [ "${BT_STUDIO_NO_PULL:-}" = 1 ]; then return 1; fi
  if [ -z "$digest" ]; then timeout "$pull_s" "$docker" pull --quiet "$1" >/dev/null 2>&1; return; fi
  timeout "$pull_s" "$docker" pull --quiet "$name@$digest" >/dev/null 2>&1 && "$docker" tag "$name@$digest" "$1"
}

make_debian() {
  if [ "$(id -u)" != 0 ] || ! command -v debootstrap >/dev/null; then
    say "no registry is reachable, and without root and debootstrap debian:bookworm-slim cannot be made here" >&2
    exit 1
  fi
  debootstrap --variant=minbase bookworm "$work/debian" >"$work/debootstrap.log" || { tail "$work/debootstrap.log"; exit 1; }
  printf 'deb http://deb.debian.org/debian bookworm main\ndeb http://deb.debian.org/debian bookworm-updates main\ndeb http://deb.debian.org/debian-security bookworm-security main\n' \
    >"$work/debian/etc/apt/sources.list"
  # As the official image has it: no translations, no sync of each file.
  echo 'Acquire::Languages "none";' >"$work/debian/etc/apt/apt.conf.d/docker-no-languages"
  echo force-unsafe-io >"$work/debian/etc/dpkg/dpkg.cfg.d/docker-apt-speedup"
  rm -rf "$work"/debian/var/lib/apt/lists/* "$work"/debian/var/cache/apt/*.bin "$work"/debian/var/cache/apt/archives/*.deb \
    "$work"/debian/usr/share/{doc,man,info,locale}/* "$work"/debian/var/log/*
  tar -C "$work/debian" -c . | "$docker" import --change 'CMD ["bash"]' - "$1" >/dev/null
}

make_node() {
  mkdir "$work/node"
  cp "$(readlink -f "$(command -v node)")" "$work/node/node"
  cp -r "$(dirname "$(dirname "$(readlink -f "$(command -v npm)")")")" "$work/node/npm"
  build -f docker/bases/node.Dockerfile -t "$1" "$work/node"
}

make_postgres() { build -f docker/bases/postgres.Dockerfile -t "$1" docker/bases; }

make_redis() { build -f docker/bases/redis.Dockerfile -t "$1" docker/bases; }

make_caddy() { build -f docker/bases/caddy.Dockerfile -t "$1" docker/bases; }

base() {
  if has_locked "$1" || pull "$1"; then return; fi
  if has "$1"; then say "$1 is the one of this machine, not the one of docker/bases/digests"; return; fi
  say "making $1 on this machine …"
  "$2" "$1"
}

# Several at once, since each mostly waits for downloads; the first that fails ends the script.
together() {
  local running=() one
  for one in "$@"; do $one & running+=($!); done
  for one in "${running[@]}"; do wait "$one"; done
}

image() { build -f "docker/$1.Dockerfile" -t "bt-studio-$1:$tag" .; say "bt-studio-$1:$tag is built"; }

base debian:bookworm-slim make_debian
together "base node:22-bookworm-slim make_node" "base postgres:15-bookworm make_postgres" "base redis:7-bookworm make_redis" \
  "base caddy:2 make_caddy"
say "building bt-studio-executor, -web, -keeper and -caddy …"
together "image executor" "image web" "image keeper" "image caddy"
say "done"
