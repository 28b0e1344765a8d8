#!/bin/sh
# Makes the cluster once, with the user, password and database that the variables name, and serves it.
set -eu
if [ ! -s "$PGDATA/PG_VERSION" ]; then
  user=${POSTGRES_USER:-postgres}
  initdb --username="$user" --pwfile=/dev/fd/3 --auth-host=scram-sha-256 --auth-local=trust --encoding=UTF8 3<<EOF >/dev/null
${POSTGRES_PASSWORD:?}
EOF
  echo "host all all all scram-sha-256" >> "$PGDATA/pg_hba.conf"
  pg_ctl -w -o "-c listen_addresses=''" start >/dev/null
  if [ "${POSTGRES_DB:-$user}" != postgres ]; then createdb --username="$user" "${POSTGRES_DB:-$user}"; fi
  pg_ctl -w -m fast stop >/dev/null
fi
exec "$@" -c listen_addresses='*'
