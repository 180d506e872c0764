#!/usr/bin/python3
"""stress.png: how far the energy grew beyond what was put in, over all scenes, for each integrator.

Usage: plot_stress.py DIR
"""
import math
import sys

from plot_style import plt, read_results, read_table, save, tidy


def main(folder):
    rows = read_table(folder, "stress")
    machine, results = read_results(folder, "stress")
    names = sorted({r["integrator"] for r in rows})
    growth = {name: [] for name in names}
    for row in rows:
        value = row["growth"]
        finite = isinstance(value, float) and math.isfinite(value)
        growth[row["integrator"]].append(min(max(math.log10(max(value, 1e-9)), -3), 6) if finite else 6)
    figure, axes = plt.subplots(figsize=(8, 4.5))
    bins = [-3 + 0.1 * n for n in range(91)]
    axes.hist([growth[name] for name in names], bins=bins, stacked=True,
              label=[f"{name.replace('_', ' ')}, {len(growth[name])} scenes" for name in names])
    bound = results["growth_bound"]
    axes.axvline(math.log10(bound), color="black", lw=1, ls="--", label=f"bound, {bound:g}")
    axes.set_yscale("log")
    axes.set_ylim(bottom=0.7)
    tidy(axes, "log10 of the largest (kinetic + elastic energy) / (most energy put in); the ends hold what is beyond",
         "scenes")
    axes.legend(fontsize=8, frameon=False)
    figure.tight_layout(rect=(0, 0.04, 1, 1))
    save(figure, folder, "stress", machine)


if __name__ == "__main__":
    main(sys.argv[1])
