#!/usr/bin/python3
"""kernel.png: ns per mass and step against the number of masses, with the roof of memory and arithmetic.

Usage: plot_kernel.py DIR
"""
import math
import sys

from plot_style import plt, read_results, read_table, save, tidy

COLOURS = {"undamped": "C0", "damped": "C1", "plastic": "C2", "yielding": "C3"}
STYLES = {1: ("-", "o"), 2: ("--", "s")}


def triad(limits, size, threads):
    """GB/s of the measured triad whose footprint is nearest."""
    near = [t for t in limits["triad"] if t["threads"] == threads]
    return min(near, key=lambda t: abs(math.log(t["bytes"] / size)))["GB_per_s"]


def draw(axes, rows, limits):
    peak = limits["fma_Gflop_per_s"][rows[0]["precision"]]
    for work, colour in COLOURS.items():
        for threads, (line, marker) in STYLES.items():
            own = sorted((r for r in rows if r["work"] == work and r["threads"] == threads), key=lambda r: r["masses"])
            if own:
                axes.plot([r["masses"] for r in own], [r["ns_per_mass"] for r in own], line, marker=marker, ms=4,
                          color=colour, label=f"{work}, {threads} thread{'s' if threads > 1 else ''}")
            if own and work == "undamped" and threads == 1:
                memory = [r["bytes_per_mass"] / triad(limits, r["bytes_per_mass"] * r["masses"], 1) for r in own]
                axes.plot([r["masses"] for r in own], memory, ":", color="0.3", label="triad of these bytes, 1 thread")
                axes.plot([r["masses"] for r in own], [r["flops_per_mass"] / peak for r in own], "-.", color="0.6",
                          label="fused arithmetic peak, 1 thread")


def main(folder):
    rows = read_table(folder, "kernel")
    machine, results = read_results(folder, "kernel")
    kinds = sorted({(r["lattice"], r["precision"]) for r in rows}, key=lambda k: (k[0], k[1] == "double"))
    columns = 2 if len(kinds) > 1 else 1
    lines = math.ceil(len(kinds) / columns)
    figure, grid = plt.subplots(lines, columns, figsize=(6.2 * columns, 4.2 * lines), squeeze=False, sharex=True)
    for axes in grid.flat[len(kinds):]:
        axes.set_visible(False)
    for axes, (lattice, precision) in zip(grid.flat, kinds):
        draw(axes, [r for r in rows if (r["lattice"], r["precision"]) == (lattice, precision)], results["limits"])
        axes.set_xscale("log")
        axes.set_yscale("log")
        axes.set_title(f"{lattice}, {precision}", fontsize=10)
        tidy(axes, "masses", "ns per mass and step")
    handles, labels = grid.flat[0].get_legend_handles_labels()
    figure.legend(handles, labels, loc="lower center", ncol=5, fontsize=8, frameon=False, bbox_to_anchor=(0.5, 0.03))
    figure.tight_layout(rect=(0, 0.10, 1, 1))
    save(figure, folder, "kernel", machine)


if __name__ == "__main__":
    main(sys.argv[1])
