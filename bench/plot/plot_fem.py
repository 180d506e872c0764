#!/usr/bin/python3
"""fem.png: error against CPU time of a cantilever and of a block under a sphere, each stepped to rest.

Usage: plot_fem.py DIR
"""
import sys

from plot_style import plt, read_results, save, tidy

COLOURS = {"physical": "C0", "isotropic": "C1", "springs": "C7", "CalculiX C3D20R": "C2", "CalculiX C3D8I": "C3"}


def main(folder):
    machine, results = read_results(folder, "fem")
    rows = results["error"]
    problems = list(dict.fromkeys(row["problem"] for row in rows))
    figure, grid = plt.subplots(1, len(problems), figsize=(5.2 * len(problems), 4.2), squeeze=False)
    for axes, problem in zip(grid.flat, problems):
        for who, colour in COLOURS.items():
            own = [row for row in rows if (row["problem"], row["who"]) == (problem, who)]
            if not own:
                continue
            own.sort(key=lambda row: -row["edge_m"])
            axes.plot([row["cpu_s"] for row in own], [abs(row["error"]) for row in own], marker="o", ms=4, lw=1.2,
                      color=colour, label=who)
        axes.set_xscale("log")
        axes.set_yscale("log")
        axes.set_title(problem, fontsize=10)
        tidy(axes, "CPU time until at rest [s]", "error / the reference")
        axes.legend(fontsize=7, frameon=False)
    figure.tight_layout(rect=(0, 0.05, 1, 1))
    save(figure, folder, "fem", machine)


if __name__ == "__main__":
    main(sys.argv[1])
