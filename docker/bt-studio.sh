#!/bin/sh
# The `bt-studio` program of the image.
cd /opt/bt-studio || exit 1
exec python -m backend.confine web python -m backend.cli.main "$@"
