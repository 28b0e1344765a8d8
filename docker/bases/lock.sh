#!/usr/bin/env bash
# Writes the digests of docker/bases/digests again, as the registry has them now: `make lock-images`.
# If an image cannot be pulled, it ends and leaves the file unchanged.
set -euo pipefail
cd "$(dirname "$0")"
docker=${DOCKER:-docker}
file=${1:-digests}
work=$(mktemp "$file.XXXXXX")
trap 'rm -f "$work"' EXIT

while read -r line; do
  case $line in
    "#"* | "") echo "$line" ;;
    *)
      image=${line%% *}
      "$docker" pull --quiet "$image" >/dev/null || { echo "lock-images: $image cannot be pulled" >&2; exit 1; }
      digest=$("$docker" image inspect --format '{{range .RepoDigests}}{{println .}}{{end}}' "$image" | sed -n "s/.*@\(sha256:[0-9a-f]\{64\}\)$/\1/p" | head -n 1)
      if [ -z "$digest" ]; then echo "lock-images: $image comes from no registry" >&2; exit 1; fi
      echo "$image $digest"
      ;;
  esac
done <"$file" >"$work"
cat "$work" >"$file"
