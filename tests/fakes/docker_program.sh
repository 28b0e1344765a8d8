#!/bin/sh
# A `docker` for tests of `docker/up.sh`, which has no engine: FAKE_INFO is what it says of itself, FAKE_VOLUMES the
# volumes that are there. What else it is asked, it notes in FAKE_LOG and refuses.
case "$1 $2" in
"info --format")
  [ -n "$FAKE_INFO" ] || { echo "${FAKE_REFUSAL:-}" >&2; exit 1; }
  echo "$FAKE_INFO" ;;
"compose version") exit 0 ;;
"volume inspect") case " $FAKE_VOLUMES " in *" $3 "*) exit 0 ;; *) exit 1 ;; esac ;;
*)
  echo "$*" >>"$FAKE_LOG"
  exit 1 ;;
esac
