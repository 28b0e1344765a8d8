#!/usr/bin/env bash
# Starts or upgrades the server for a class or a team. It is safe to repeat: existing settings stay.
#
#   docker/up.sh HOST [OPTION…]
#
# HOST is the name or the IPv4 address under which users open the server:
#   bt.example.org    a public name: Caddy gets a certificate for it by ACME, for which ports 80 and 443 must be
#                     reachable from the internet
#   192.168.1.20, robots.local, localhost
#                     Caddy signs the certificate itself; docker/ca.crt is what browsers must be made to trust
# It may be left out when docker/.env has it.
#
#   --tls KIND           acme, internal (Caddy's own authority), or proxy (no Caddy, for a reverse proxy of your own)
#   --certificate FILE   a certificate of your own, with its chain, as PEM; repeat it with each renewal
#   --key FILE           and its key
#   --http-port PORT     80 by default, where browsers are sent on to https
#   --https-port PORT    443 by default
#   --admin NAME         name of the first administrator, "admin" by default
#   --email ADDRESS      and their address
#   --no-build           takes the images that are here
#   --help
#
# Variables: DOCKER (the docker program), BT_STUDIO_ENV_FILE (the settings, docker/.env), COMPOSE_PROJECT_NAME
# ("docker"), BT_STUDIO_UP_TIMEOUT_S (300), and those of docker/images.sh.
set -euo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
settings=${BT_STUDIO_ENV_FILE:-$here/.env}
docker=${DOCKER:-docker}
timeout_s=${BT_STUDIO_UP_TIMEOUT_S:-300}
host='' tls='' certificate='' key='' http_port='' https_port='' admin=admin email='' builds=true

say() { printf 'up: %s\n' "$@"; }

fail() {
  printf 'up: %s\n' "$@" >&2
  exit 1
}

compose() { DOCKER=$docker BT_STUDIO_ENV_FILE=$settings "$here/compose.sh" "$@"; }

# The settings ----------------------------------------------------------------------------------------------------

# Prints the value that Compose will use: the environment's, else that of the last line of the file.
setting() {
  if [ -n "${!1:-}" ]; then
    printf '%s' "${!1}"
  elif [ -f "$settings" ]; then
    sed -n "s/^$1=//p" "$settings" | tail -n 1 | sed -E "s/[[:space:]]+\$//; s/^'(.*)'\$/\\1/; s/^\"(.*)\"\$/\\1/"
  fi
}

has() { [ -n "$(setting "$1")" ]; }

add() {
  # The last line may have no end.
  [ -z "$(tail -c 1 "$settings")" ] || echo >>"$settings"
  printf '%s=%s\n' "$1" "$2" >>"$settings"
}

# Adds a missing line. An existing line with another value is left to the user.
want() {
  local is=
  is=$(setting "$1")
  if [ -z "$is" ]; then
    add "$1" "$2"
  elif [ "$is" != "$2" ]; then
    fail "$1 is '$is', and should be '$2': $3" "Change that line of $settings, and run this again."
  fi
}

random() { od -An -N "$1" -tx1 /dev/urandom | tr -d ' \n'; }

make_settings() {
  if [ ! -f "$settings" ]; then
    (umask 077 && echo "# Made by docker/up.sh. What else can be set: docker/.env.example." >"$settings")
    say "$settings is made, with the server's secrets: keep a copy beside your backups."
  elif [ -n "$(find "$settings" -perm /077)" ]; then
    chmod 600 "$settings"
    say "$settings holds secrets: from now on only its owner reads it."
  fi
}

need_old_password() {
  local volume
  volume=$(setting COMPOSE_PROJECT_NAME)
  volume=${volume:-docker}_database
  if "$docker" volume inspect "$volume" >/dev/null 2>&1; then
    fail "the volume $volume holds a database, whose password is not in $settings." \
      "Put the line BT_STUDIO_DATABASE_PASSWORD of the old settings there."
  fi
}

make_secrets() {
  if ! has BT_STUDIO_DATABASE_PASSWORD; then
    need_old_password
    add BT_STUDIO_DATABASE_PASSWORD "$(random 24)"
  fi
  if ! has BT_STUDIO_SECRET_KEY; then add BT_STUDIO_SECRET_KEY "$(random 32)"; fi
}

is_address() { [[ $1 =~ ^[0-9]{1,3}(\.[0-9]{1,3}){3}$ ]]; }

# Names for which no public authority would sign.
is_private() {
  case $1 in
  localhost | *.localhost | *.local | *.lan | *.home | *.home.arpa | *.internal | *.intranet | *.test) return 0 ;;
  *.*) is_address "$1" ;;
  *) return 0 ;;
  esac
}

check_host() {
  case $host in
  '') fail "under which name or address do users open the server? docker/up.sh HOST; see docker/up.sh --help" ;;
  *://*) fail "'$host': give the name alone, without https:// and path." ;;
  *:*) fail "'$host': give a name or an IPv4 address; the port by --https-port." ;;
  esac
  [[ $host =~ ^[a-z0-9]([a-z0-9.-]*[a-z0-9])?$ ]] || fail "'$host' is no name of a host."
}

choose_host() {
  host=${host:-$(setting BT_STUDIO_DOMAIN)}
  host=${host,,}
  check_host
  if [ -n "$certificate$key" ]; then
    [ -r "$certificate" ] || fail "--certificate: '$certificate' cannot be read."
    [ -r "$key" ] || fail "--key: '$key' cannot be read."
    tls=files
  fi
  tls=${tls:-$(setting BT_STUDIO_TLS)}
  if [ -z "$tls" ]; then
    if is_private "$host"; then tls=internal; else tls=acme; fi
  fi
  case $tls in
  acme | internal | files | proxy) ;;
  *) fail "--tls: '$tls' is none of acme, internal and proxy." ;;
  esac
}

# Prints the published port: the option's, the present one, or the default.
publish() {
  if [ -n "$3" ]; then
    want "$1" "$2$3" "the command asks for it."
  elif ! has "$1"; then
    add "$1" "$2$4"
  fi
}

write_address() {
  local only='' port=''
  want BT_STUDIO_DOMAIN "$host" "that is the HOST of this command."
  want BT_STUDIO_TLS "$tls" "the command asks for it."
  if [ "$tls" = proxy ]; then
    has BT_STUDIO_PUBLIC_URL || add BT_STUDIO_PUBLIC_URL "https://$host"
    has BT_STUDIO_PROXY_HOPS || add BT_STUDIO_PROXY_HOPS 1
    return
  fi
  if [ "$host" = localhost ]; then
    only=127.0.0.1:
    # HSTS would apply to all other servers of the user's machine, too.
    has BT_STUDIO_HSTS_DAYS || add BT_STUDIO_HSTS_DAYS 0
  fi
  publish BT_STUDIO_HTTP_PUBLISH "$only" "$http_port" 80
  publish BT_STUDIO_HTTPS_PUBLISH "$only" "$https_port" 443
  port=$(setting BT_STUDIO_HTTPS_PUBLISH)
  port=${port##*:}
  if [ "$port" = 443 ]; then port=''; else port=:$port; fi
  want BT_STUDIO_PUBLIC_URL "https://$host$port" "Caddy serves it there. (With a reverse proxy of your own: --tls proxy.)"
}

# Docker ----------------------------------------------------------------------------------------------------------

check_docker() {
  local found version
  command -v "$docker" >/dev/null || fail "Docker is missing: https://docs.docker.com/engine/install/"
  if ! found=$("$docker" info --format '{{.ServerVersion}} {{.OSType}}/{{.Architecture}}' 2>&1); then
    case $found in
    *"permission denied"*) fail "you may not use Docker: run this as root, or as a member of the group docker." ;;
    *) fail "Docker does not answer: is it started? It says:" "$found" ;;
    esac
  fi
  version=${found%% *}
  [ "$(printf '%s\n' 20.10 "$version" | sort -V | head -n 1)" = 20.10 ] ||
    fail "Docker $version is too old: 20.10 is the oldest that works."
  [ "${found#* }" = linux/x86_64 ] || fail "Docker runs on ${found#* }; the robots need linux/x86_64."
}

make_images() {
  local tag image
  tag=$(setting BT_STUDIO_VERSION)
  tag=${tag:-latest}
  if $builds; then
    DOCKER=$docker "$here/images.sh" "$tag"
    return
  fi
  for image in web keeper executor caddy; do
    "$docker" image inspect "bt-studio-$image:$tag" >/dev/null 2>&1 ||
      fail "the image bt-studio-$image:$tag is not here: leave --no-build out."
  done
}

# The group that the socket has inside of a container, where the keeper uses it.
find_group() {
  local socket tag group
  case ${DOCKER_HOST:-} in
  unix://*) has BT_STUDIO_DOCKER_SOCKET || add BT_STUDIO_DOCKER_SOCKET "${DOCKER_HOST#unix://}" ;;
  esac
  socket=$(setting BT_STUDIO_DOCKER_SOCKET)
  tag=$(setting BT_STUDIO_VERSION)
  group=$("$docker" run --rm --network none --entrypoint stat -v "${socket:-/var/run/docker.sock}:/socket:ro" \
    "bt-studio-keeper:${tag:-latest}" -c %g /socket)
  want BT_STUDIO_DOCKER_GID "$group" "that is the group of Docker's socket."
}

keep_certificate() {
  local into='umask 077 && mkdir -p /data/own && cat >/data/own/'
  compose run --rm -T --no-deps --entrypoint bash caddy -c "${into}certificate.pem" <"$certificate"
  compose run --rm -T --no-deps --entrypoint bash caddy -c "${into}key.pem" <"$key"
  # One that runs has read the old one.
  if [ -n "$(compose ps -q caddy)" ]; then compose restart caddy; fi
}

# Waiting ---------------------------------------------------------------------------------------------------------

states() {
  local ids
  mapfile -t ids < <(compose ps -q)
  [ "${#ids[@]}" -gt 0 ] || return 0
  "$docker" inspect --format \
    '{{index .Config.Labels "com.docker.compose.service"}} {{if .State.Health}}{{.State.Health.Status}}{{else}}{{.State.Status}}{{end}} {{.RestartCount}}' \
    "${ids[@]}" 2>/dev/null | sort
}

complain() {
  compose logs --tail=15 "$1" >&2 || true
  fail "$1 $2; its last lines are above. All: docker/compose.sh logs $1"
}

await_health() {
  local now before='' service state restarts left
  local -r deadline=$((SECONDS + timeout_s))
  while true; do
    now=$(states)
    left=''
    while read -r service state restarts; do
      case $state in healthy | running) ;; *) left=$service ;; esac
      [ "${restarts:-0}" -lt 3 ] || complain "$service" "ends again and again"
    done <<<"$now"
    if [ "$now" != "$before" ]; then
      say "$(awk '{printf "%s%s %s", sep, $1, $2; sep = ", "}' <<<"$now")"
      before=$now
    fi
    [ -n "$left" ] || return 0
    [ "$SECONDS" -lt "$deadline" ] || complain "$left" "is not healthy after $timeout_s s"
    sleep 1
  done
}

# Asks for a page through Caddy, as a browser would, from inside.
readonly PROBE='
import socket, ssl, sys
host, url, authority = sys.argv[1:4]
context = ssl.create_default_context(cadata=authority or None)
if not authority:
    context.check_hostname, context.verify_mode = False, ssl.CERT_NONE
with socket.create_connection(("caddy", 443), 5) as plain, context.wrap_socket(plain, server_hostname=host) as secure:
    name = url.partition("://")[2]
    secure.settimeout(10)
    secure.sendall(f"GET /accounts/login/ HTTP/1.0\r\nHost: {name}\r\n\r\n".encode())
    line = secure.makefile("rb").readline().decode()
sys.exit(0 if " 200 " in line else f"the server answered {line}")
'

await_page() {
  local url said authority=''
  local -r deadline=$((SECONDS + timeout_s))
  url=$(setting BT_STUDIO_PUBLIC_URL)
  if [ "$tls" = internal ]; then
    authority=$(compose exec -T caddy cat /data/caddy/pki/authorities/local/root.crt)
    printf '%s\n' "$authority" >"$(dirname "$settings")/ca.crt"
  fi
  say "waiting for $url …"
  until said=$(compose exec -T web python -c "$PROBE" "$host" "$url" "$authority" 2>&1); do
    if [ "$SECONDS" -ge "$deadline" ]; then
      compose logs --tail=15 caddy >&2 || true
      printf '%s\n' "$said" | tail -n 1 >&2
      fail "no page comes by TLS; Caddy's last lines are above." \
        "For ACME, the name $host must lead to this machine, and ports 80 and 443 must be open to the internet."
    fi
    sleep 2
  done
}

make_administrator() {
  local options=()
  [ -z "$email" ] || options+=(--email "$email")
  compose exec -T web bt-studio admin create "$admin" "${options[@]}" --first
}

say_what_next() {
  echo
  say "BT Studio is at $(setting BT_STUDIO_PUBLIC_URL)"
  case $tls in
  internal) say "Browsers warn until they trust $(dirname "$settings")/ca.crt: docs/how-to/run-a-team-server.md says how." ;;
  proxy) say "Your reverse proxy hands on to $(setting BT_STUDIO_PUBLISH): docs/how-to/run-a-team-server.md has examples." ;;
  esac
  say "Next: open the link above and choose a password; make a group and send its invitation; back up every night" \
    "(docs/how-to/backup.md). docker/compose.sh ps, logs, exec web bt-studio admin … look after it."
}

while [ $# -gt 0 ]; do
  case $1 in
  --help | -h)
    sed -n '2,/^set /{/^#/!d;s/^# \{0,1\}//;p}' "$0"
    exit 0
    ;;
  --no-build) builds=false ;;
  --tls | --certificate | --key | --http-port | --https-port | --admin | --email)
    [ $# -gt 1 ] || fail "$1 needs a value; see docker/up.sh --help"
    name=${1#--}
    printf -v "${name//-/_}" %s "$2"
    shift
    ;;
  -*) fail "there is no option $1; see docker/up.sh --help" ;;
  *)
    [ -z "$host" ] || fail "one HOST is enough; see docker/up.sh --help"
    host=$1
    ;;
  esac
  shift
done

check_docker
choose_host
make_settings
make_secrets
write_address
make_images
find_group
if [ "$tls" = files ] && [ -n "$certificate" ]; then keep_certificate; fi
say "starting …"
compose up -d
await_health
if [ "$tls" != proxy ]; then await_page; fi
make_administrator
say_what_next
