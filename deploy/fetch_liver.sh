#!/bin/bash
# Says where the labelled abdomen of Debian's package libcgal-demo is, which it unpacks into data/: liver 255, kidney 127, gall bladder
# 85, cells of 0.617 x 0.617 x 1.333 mm, CC0.
set -euo pipefail
cd "$(dirname "$0")/.."
. deploy/unpack_package.sh
wanted=data/liver.inr.gz

[ -f "$wanted" ] && echo "$wanted" && exit 0
fetched=$(mktemp -d)
trap 'rm -rf "$fetched"' EXIT
unpack_package libcgal-demo "$fetched/package"
tar -xzf "$fetched/package/unpacked/usr/share/doc/libcgal-dev/data.tar.gz" -C "$fetched" data/images/liver.inr.gz ||
  fail "the package libcgal-demo has no data/images/liver.inr.gz"
mkdir -p data
mv "$fetched/data/images/liver.inr.gz" "$wanted"
echo "$wanted"
