#!/usr/bin/python3
"""touch.png: force of a pressed shape over its closed form, by depth and by cell size; a deep sphere by cell size.

Usage: plot_touch.py DIR
"""
import sys

from plot_style import plt, read_results, save, tidy

COLOURS = {"elements": "C0", "springs": "C7"}
MARKS = {2: "s", 4: "^", 8: "o"}


def by_depth(axes, rows, shape):
    for row in rows:
        if row["shape"] != shape or row["radius_m"] > 0.006:
            continue
        axes.plot([1e3 * d for d in row["depth_m"]], row["force_over_true"], marker=MARKS[row["cells_a_radius"]], ms=4,
                  lw=1, color=COLOURS[row["tissue"]], label=f"{row['tissue']}, R/{row['cells_a_radius']}")
    axes.axhline(1, color="0.6", lw=0.8)
    axes.set_title(f"{shape} of 5 mm", fontsize=10)
    tidy(axes, "depth [mm]", "force / closed form")
    axes.legend(fontsize=7, frameon=False)


def by_cell(axes, rows):
    for tissue, colour in COLOURS.items():
        for shape, line in (("sphere", "-"), ("cylinder", "--")):
            own = sorted((row for row in rows if row["tissue"] == tissue and row["shape"] == shape and
                          row["radius_m"] < 0.006), key=lambda row: row["cells_a_radius"])
            axes.plot([1 / row["cells_a_radius"] for row in own],
                      [max(abs(f - 1) for f in row["force_over_true"]) for row in own], marker="o", ms=4, lw=1,
                      ls=line, color=colour, label=f"{shape}, {tissue}")
    axes.set_xscale("log", base=2)
    axes.set_yscale("log")
    axes.set_title("largest error", fontsize=10)
    tidy(axes, "cell / R", "error of the force")
    axes.legend(fontsize=7, frameon=False)


def deep(axes, rows):
    for index, radius in enumerate(sorted({row["radius_m"] for row in rows})):
        for nu, line in ((0.45, "-"), (0.49, "--")):
            for edge in sorted({row["edge_m"] for row in rows}):
                own = [row for row in rows if (row["radius_m"], row["poisson_ratio"], row["edge_m"]) == (radius, nu, edge)]
                for row in own:
                    n = len(row["force_N"])
                    axes.plot([5 * (k + 1) / n for k in range(n)], row["force_N"], ls=line, lw=0.6 + 400 * edge,
                              color=f"C{index}", alpha=0.7,
                              label=f"R = {1e3 * radius:.0f} mm, nu {nu}" if edge == 0.0025 else None)
    axes.set_title("sphere, deep; thick lines: coarse cells", fontsize=10)
    tidy(axes, "depth [mm]", "force [N]")
    axes.legend(fontsize=7, frameon=False)


def main(folder):
    machine, results = read_results(folder, "touch")
    figure, grid = plt.subplots(2, 2, figsize=(10.4, 8))
    by_depth(grid[0][0], results["half_space"], "sphere")
    by_depth(grid[0][1], results["half_space"], "cylinder")
    by_cell(grid[1][0], results["half_space"])
    deep(grid[1][1], results["deep"])
    figure.tight_layout(rect=(0, 0.03, 1, 1))
    save(figure, folder, "touch", machine)


if __name__ == "__main__":
    main(sys.argv[1])
