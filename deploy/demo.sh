#!/bin/bash
# From nothing to a felt force: installs what is missing, builds, imports a real head CT, and lets a simulated hand
# press its skin; in a window where there is a display, into pictures otherwise. May be run again.
set -euo pipefail
cd "$(dirname "$0")/.."
. deploy/step.sh
trap 'rm -f "$step_log"' EXIT
started=$SECONDS
bin=build/release/bin
out=out/head_press

deploy/install_packages.sh deploy/packages.txt deploy/packages-demo.txt
head=$(deploy/fetch_head.sh)
step "configure" cmake --preset release -DPALPATE_ROOMS=ON
# What it runs, and no more: no benchmarks, and of the drivers the simulated hand.
step "build" cmake --build --preset release --parallel "$(nproc)" \
  --target palpate palpate-import palpate-physics palpate-haptic palpate-render
mkdir -p data
step "import the head" "$bin/palpate" import "$head" --out data/cranium.h5

window=()
[ -n "${DISPLAY:-}${WAYLAND_DISPLAY:-}" ] || window=(--headless)
echo "the hand presses the head: scenes/head_press.toml ${window[*]}"
[ ${#window[@]} -gt 0 ] || echo "the window stays open: Esc, or close it, to end"
"$bin/palpate" run scenes/head_press.toml --out "$out" "${window[@]}"

echo
echo "demo: done in $((SECONDS - started)) s"
echo "  frames   $out/frames/"
echo "  summary  $out/summary.json"
echo "  plot     $out/force.png"
