#!/bin/bash
# Says where the head CT of Debian's package invesalius-examples is. Images of Debian that leave out /usr/share/doc
# leave out the head, too, however often it is installed: then the package is unpacked in data/.
set -euo pipefail
cd "$(dirname "$0")/.."
inside=usr/share/doc/invesalius-examples/examples/Cranium.inv3

fail() {
  echo "fetch_head: $*" >&2
  exit 2
}

for folder in "" data/invesalius-examples; do
  [ -f "$folder/$inside" ] && echo "$folder/$inside" && exit 0
done
fetched=$(mktemp -d)
trap 'rm -rf "$fetched"' EXIT
(cd "$fetched" && apt-get -qq download invesalius-examples >log 2>&1) ||
  fail "apt-get download invesalius-examples failed: $(grep -m 1 '^E:' "$fetched/log" || tail -n 1 "$fetched/log")"
mkdir -p data
dpkg-deb -x "$fetched"/*.deb "$fetched/unpacked" || fail "the package invesalius-examples cannot be unpacked"
rm -rf data/invesalius-examples
mv "$fetched/unpacked" data/invesalius-examples
[ -f "data/invesalius-examples/$inside" ] || fail "the package invesalius-examples has no $inside"
echo "data/invesalius-examples/$inside"
