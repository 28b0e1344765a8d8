#!/usr/bin/env bash
# Compose with the files and settings of the team's server, of version 2 or docker-compose 1.29:
#
#   docker/compose.sh ps
#   docker/compose.sh logs web
#   docker/compose.sh exec web bt-studio admin users
#
#   DOCKER                the docker program
#   BT_STUDIO_ENV_FILE    the settings, docker/.env by default
set -euo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
settings=${BT_STUDIO_ENV_FILE:-$here/.env}
docker=${DOCKER:-docker}

fail() {
  printf 'compose: %s\n' "$@" >&2
  exit 1
}

old_enough() { [ "$(printf '%s\n' 1.29 "$1" | sort -V | head -n 1)" = 1.29 ]; }

[ -f "$settings" ] || fail "$settings is missing: docker/up.sh HOST makes it."
if "$docker" compose version >/dev/null 2>&1; then
  compose=("$docker" compose)
elif version=$(docker-compose version --short 2>/dev/null); then
  old_enough "$version" || fail "docker-compose $version is too old: install Compose v2 (docker-compose-plugin), or 1.29."
  compose=(docker-compose)
else
  fail "Compose is missing: install the package docker-compose-plugin (Docker's own) or docker-compose (Debian's)."
fi
files=(-f "$here/compose.yaml")
tls=${BT_STUDIO_TLS:-$(sed -n 's/^BT_STUDIO_TLS=//p' "$settings" | tail -n 1)}
if [ "$tls" = proxy ]; then files+=(-f "$here/compose.proxy.yaml"); fi
exec "${compose[@]}" "${files[@]}" --env-file "$settings" "$@"
