#!/bin/bash
# Says where the head CT of Debian's package invesalius-examples is; where it is not installed, unpacks it in data/.
set -euo pipefail
cd "$(dirname "$0")/.."
. deploy/unpack_package.sh
inside=usr/share/doc/invesalius-examples/examples/Cranium.inv3

for folder in "" data/invesalius-examples; do
  [ -f "$folder/$inside" ] && echo "$folder/$inside" && exit 0
done
fetched=$(mktemp -d)
trap 'rm -rf "$fetched"' EXIT
unpack_package invesalius-examples "$fetched/package"
mkdir -p data
rm -rf data/invesalius-examples
mv "$fetched/package/unpacked" data/invesalius-examples
[ -f "data/invesalius-examples/$inside" ] || fail "the package invesalius-examples has no $inside"
echo "data/invesalius-examples/$inside"
