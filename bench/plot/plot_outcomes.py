#!/usr/bin/python3
"""outcomes.png: what becomes of a falling sphere, over yield ratio and break ratio, at each speed.

Usage: plot_outcomes.py DIR
"""
import sys

from plot_style import plt, read_results, read_table, save

COLOURS = {"original": "0.85", "restitution": "#8ecae6", "crush": "#b5a1d8", "crack": "#ffd166", "disunion": "#f4845f",
           "smash": "#6d2e46"}
NAMED = ("restitution", "crack", "disunion", "crush", "smash")


def draw(axes, rows, speed):
    yields = sorted({r["y_p"] for r in rows})
    gaps = sorted({r["b_p_less_y_p"] for r in rows})
    for r in rows:
        x, y = gaps.index(r["b_p_less_y_p"]), yields.index(r["y_p"])
        axes.add_patch(plt.Rectangle((x - 0.5, y - 0.5), 1, 1, color=COLOURS[r["outcome"]], lw=0))
        if 0 < r["broken"]:
            dark = r["outcome"] in ("smash", "disunion")
            axes.text(x, y, f"{100 * r['broken']:.0f}", ha="center", va="center", fontsize=6, color="w" if dark else "0.3")
    axes.set_xlim(-0.5, len(gaps) - 0.5)
    axes.set_ylim(-0.5, len(yields) - 0.5)
    axes.set_xticks(range(len(gaps)), [f"{g:g}" for g in gaps], fontsize=7)
    axes.set_yticks(range(len(yields)), [f"{y - 1:.3g}" for y in yields], fontsize=7)
    axes.set_xlabel("b_p - y_p", fontsize=8)
    axes.set_ylabel("y_p - 1", fontsize=8)
    axes.set_title(f"{speed:g} m/s", fontsize=10)


def main(folder):
    rows = read_table(folder, "outcomes")
    machine, results = read_results(folder, "outcomes")
    speeds = sorted({r["speed_m_per_s"] for r in rows})
    columns = 2 if len(speeds) > 1 else 1
    lines = -(-len(speeds) // columns)
    figure, grid = plt.subplots(lines, columns, figsize=(5.2 * columns, 4.1 * lines + 0.6), squeeze=False)
    for axes in grid.flat[len(speeds):]:
        axes.set_visible(False)
    for axes, speed in zip(grid.flat, speeds):
        draw(axes, [r for r in rows if r["speed_m_per_s"] == speed], speed)
    handles = [plt.Rectangle((0, 0), 1, 1, color=COLOURS[name]) for name in NAMED]
    figure.legend(handles, NAMED, loc="lower center", ncol=len(NAMED), fontsize=9, frameon=False, bbox_to_anchor=(0.5, 0.035))
    figure.text(0.01, 0.025, f"numbers: per cent of the elements broken, {results['seconds_each']:g} s after the start",
                fontsize=7, color="0.4")
    figure.tight_layout(rect=(0, 0.08, 1, 1))
    save(figure, folder, "outcomes", machine)


if __name__ == "__main__":
    main(sys.argv[1])
