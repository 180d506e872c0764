#!/usr/bin/python3
"""error.png: error against CPU time, log-log, one panel for each reference problem.

Usage: plot_error.py DIR
"""
import math
import sys

from plot_style import plt, read_results, read_table, save, tidy

COLOURS = {"symplectic_euler": "C0", "velocity_verlet": "C1", "backward_euler": "C2"}


def draw(axes, rows, orders):
    for integrator, colour in COLOURS.items():
        for precision, threads, line in (("double", 1, "-"), ("single", 1, ":"), ("double", 2, "--")):
            own = [r for r in rows if (r["integrator"], r["precision"], r["threads"]) == (integrator, precision, threads)
                   and isinstance(r["error"], float) and 0 < r["error"] < 1 and r["cpu_s"] > 0]
            own.sort(key=lambda r: r["step_s"])
            if not own:
                continue
            name = integrator.replace("_", " ")
            if integrator in orders:
                name += f", order {orders[integrator]:.2f}"
            label = name if line == "-" else None
            axes.plot([r["cpu_s"] for r in own], [r["error"] for r in own], line, marker="o", ms=3, lw=1.2,
                      color=colour, label=label)


def main(folder):
    rows = read_table(folder, "error")
    machine, results = read_results(folder, "error")
    names = list(dict.fromkeys(r["problem"] for r in rows))
    columns = min(3, len(names))
    lines = math.ceil(len(names) / columns)
    figure, grid = plt.subplots(lines, columns, figsize=(4.6 * columns, 3.6 * lines + 0.5), squeeze=False)
    for axes in grid.flat[len(names):]:
        axes.set_visible(False)
    for axes, name in zip(grid.flat, names):
        orders = {o["integrator"]: o["order"] for o in results.get("orders", []) if o["problem"] == name}
        draw(axes, [r for r in rows if r["problem"] == name], orders)
        axes.set_xscale("log")
        axes.set_yscale("log")
        axes.set_title(name.replace("_", " "), fontsize=10)
        tidy(axes, "CPU time [s]", "error / " + results["error_is_relative_to"][name])
        if axes.get_legend_handles_labels()[0]:
            axes.legend(fontsize=7, frameon=False)
    figure.text(0.01, 0.03, "solid: double, dotted: single, dashed: double with 2 threads; errors of 1 and more left out",
                fontsize=8)
    figure.tight_layout(rect=(0, 0.05, 1, 1))
    save(figure, folder, "error", machine)


if __name__ == "__main__":
    main(sys.argv[1])
