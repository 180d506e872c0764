#!/usr/bin/python3
"""Plots of `palpate bench peers`: error_against_time.png and mass_step.png.

Usage: plot_peers.py DIR     DIR holds peers.csv and peers.json.
"""
import sys

from plot_style import plt, read_results, read_table, save, tidy

COLOURS = {"LAMMPS": ["tab:orange"], "Bullet": ["tab:green", "tab:olive", "tab:brown"], "MuJoCo": ["tab:purple"]}
OURS = {"single": "tab:blue", "double": "navy"}
MARKS = ["o", "s", "^", "D"]


def label(row):
    precision = "float" if row["precision"] == "single" else "double"
    return f"{row['peer']}, {row['method'].replace(';', ',')}, {precision}"


def series_of(rows):
    """Rows by label, in the order of the table."""
    series = {}
    for row in rows:
        series.setdefault(label(row), []).append(row)
    return series


def looks(series):
    """A colour per peer (palpate: per precision), a marker per method of it."""
    chosen, seen = {}, {}
    for name, rows in series.items():
        peer, precision = rows[0]["peer"], rows[0]["precision"]
        key = (peer, precision) if peer == "palpate" else (peer, "")
        number = seen[key] = seen.get(key, -1) + 1
        colour = OURS[precision] if peer == "palpate" else COLOURS[peer][number % len(COLOURS[peer])]
        chosen[name] = {"color": colour, "marker": MARKS[number % len(MARKS)],
                        "linestyle": "--" if peer == "palpate" and number == 0 else "-"}
    return chosen


def draw_drop(folder, rows, machine):
    if not rows:
        return
    series = series_of(rows)
    look = looks(series)
    figure, axes = plt.subplots(figsize=(9.5, 5.6))
    for name, runs in series.items():
        runs.sort(key=lambda row: row["step_ms"])
        axes.loglog([row["cpu_s"] for row in runs], [row["error"] for row in runs], markersize=5, linewidth=1.4,
                    label=name, **look[name])
    tidy(axes, "CPU time [s], one thread", "error at the end, relative to the displacement (rms)")
    masses, seconds = int(rows[0]["masses"]), rows[0]["steps"] * rows[0]["step_ms"] / 1000
    axes.set_title(f"The drop: a cube of {masses} masses and {int(rows[0]['springs'])} springs, "
                   f"{seconds:g} s; each point is a step", fontsize=10)
    axes.legend(fontsize=8, frameon=False, loc="center left", bbox_to_anchor=(1.0, 0.5))
    figure.tight_layout(rect=(0, 0.03, 1, 1))
    save(figure, folder, "error_against_time", machine)


def draw_steps(folder, rows, machine):
    if not rows:
        return
    rows = [row for row in rows if row["threads"] == 1]
    series = series_of(rows)
    look = looks(series)
    figure, axes = plt.subplots(figsize=(9.5, 5.0))
    for name, runs in series.items():
        runs.sort(key=lambda row: row["masses"])
        axes.loglog([row["masses"] for row in runs], [row["cpu_ns_per_mass_step"] for row in runs], markersize=6,
                    linewidth=1.4, label=name, **look[name])
    tidy(axes, "masses", "CPU time per mass and step [ns], one thread")
    axes.set_title("Time of a step of the same cube of springs", fontsize=10)
    axes.legend(fontsize=8, frameon=False, loc="center left", bbox_to_anchor=(1.0, 0.5))
    figure.tight_layout(rect=(0, 0.03, 1, 1))
    save(figure, folder, "mass_step", machine)


def main():
    if len(sys.argv) != 2:
        print(__doc__, file=sys.stderr)
        return 2
    folder = sys.argv[1]
    rows = read_table(folder, "peers")
    machine, _ = read_results(folder, "peers")
    draw_drop(folder, [row for row in rows if row["case"] == "drop"], machine)
    draw_steps(folder, [row for row in rows if row["case"] == "mass_step"], machine)
    return 0


if __name__ == "__main__":
    sys.exit(main())
