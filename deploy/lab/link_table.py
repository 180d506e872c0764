#!/usr/bin/env python3
"""Writes a line of a table for each folder of two_host_lab.sh table: what the network did to the hand, and what it did not."""
import json
import pathlib
import re
import sys

HEAD = ("split", "delay each way [ms]", "loss [%]", "period p50 / p99.9 [us]", "loop age p50 / p99 [ms]", "patches a second", "stale",
        "energy to the hand [mJ]", "tissue's rate / real time", "publish, of wall time [%]", "pictures a second")


def merged(folder):
    """Summaries of both sides: each part was left by the side that ran its node."""
    both = {}
    for side in sorted(side.name for side in folder.glob("pc[12]") if side.is_dir()):
        summary = json.loads((folder / side / "summary.json").read_text())
        both.setdefault("nodes", {}).update(summary.pop("nodes", {}))
        both.update({key: summary[key] for key in ("haptic", "render", "stages", "real_time_factor", "wall_s", "commit") if key in summary})
    return both


def row(folder):
    split, delay, loss = re.fullmatch(r"(all|p[23])_(.*)ms_(.*)percent", folder.name).groups()
    if split == "all":
        split, delay, loss = "one PC", "no network", ""
    summary = merged(folder)
    haptic, physics = summary["haptic"], summary["nodes"]["physics"]
    period, age = haptic["period_us"], haptic.get("loop_age_ms", {"p50": float("nan"), "p99": float("nan")})
    publish = 100 * summary["stages"]["publish"]["total_s"] / summary["wall_s"]
    return (split, delay, loss, f"{period['p50']:.0f} / {period['p999']:.0f}", f"{age['p50']:.2f} / {age['p99']:.2f}",
            f"{haptic['patches'] / (haptic['ticks'] / haptic['rate_Hz']):.0f}", str(haptic["stale_events"]),
            f"{1e3 * haptic['energy_max_J']:.3f}", f"{physics['rate_Hz']:.0f} Hz / {physics['real_time_factor']:.3f}", f"{publish:.2f}",
            f"{summary['render'].get('fps', 0):.1f}"), summary["commit"]


def main(folders):
    rows = [row(pathlib.Path(folder)) for folder in folders]
    print("| " + " | ".join(HEAD) + " |")
    print("|" + "---|" * len(HEAD))
    for cells, _ in rows:
        print("| " + " | ".join(cells) + " |")
    print("\nCommit", ", ".join(sorted({commit for _, commit in rows})))


if __name__ == "__main__":
    main(sys.argv[1:])
