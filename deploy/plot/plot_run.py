#!/usr/bin/python3
"""Plots of one session: force.png from the tools' traces, energy.png from energy.csv where there is one.

Usage: plot_run.py DIR     DIR holds summary.json, whose tools.NAME.trace name the CSV files.
Exit code 0 done, 2 nothing to draw from, 3 matplotlib is missing.
"""
import csv
import json
import os
import sys

TRACE = ["t_s", "x_m", "y_m", "z_m", "fx_N", "fy_N", "fz_N", "mx_Nm", "my_Nm", "mz_Nm", "contacts"]


class Mistake(Exception):
    """One line for a person."""


def read_columns(path):
    """A CSV file with one line of headings as {heading: [numbers]}."""
    with open(path, newline="", encoding="utf-8") as file:
        rows = csv.reader(file)
        headings = next(rows, None)
        if not headings:
            raise Mistake(f"{path}: is empty; run the scene again")
        columns = {heading: [] for heading in headings}
        for row in rows:
            if len(row) != len(headings):
                break  # the last line of a session that was cut short
            for heading, word in zip(headings, row):
                columns[heading].append(float(word))
    return columns


def read_traces(folder):
    """The traces that summary.json names, as [(tool, columns)]."""
    path = os.path.join(folder, "summary.json")
    try:
        with open(path, encoding="utf-8") as file:
            tools = json.load(file).get("tools", {})
    except (OSError, ValueError) as error:
        raise Mistake(f"{path}: {error}; run the scene again") from error
    traces = []
    for name, tool in sorted(tools.items()):
        if "trace" not in tool:
            continue
        beside = os.path.join(folder, tool["trace"])
        columns = read_columns(beside if os.path.exists(beside) else tool["trace"])
        missing = [heading for heading in TRACE if heading not in columns]
        if missing:
            raise Mistake(f"{tool['trace']}: lacks the column {missing[0]}; run the scene again")
        traces.append((name, columns))
    return traces


def label(axes, quantity):
    axes.set_ylabel(quantity)
    axes.grid(True, color="0.9")
    axes.legend(loc="center left", bbox_to_anchor=(1.0, 0.5), fontsize="small", frameon=False)
    axes.spines[["top", "right"]].set_visible(False)


def norm(parts):
    return [sum(p * p for p in values) ** 0.5 for values in zip(*parts)]


def draw_vector(axes, columns, letters, unit, symbol):
    """Magnitude in black, components in colour. Where the trace has raw values too, they are thin behind the low-passed
    ones; peaks far beyond these leave the picture, and a note says how high they are."""
    t = columns["t_s"]
    parts = [columns[f"{letter}_{unit}"] for letter in letters]
    whole = norm(parts)
    raw = [columns.get(f"raw_{letter}_{unit}") for letter in letters]
    has_raw = all(part is not None for part in raw)
    colours = [f"C{i}" for i in range(3)]
    if has_raw:
        axes.plot(t, norm(raw), color="black", linewidth=0.4, alpha=0.4, label=f"|{symbol}| raw")
        for colour, part in zip(colours, raw):
            axes.plot(t, part, color=colour, linewidth=0.4, alpha=0.4)
    axes.plot(t, whole, color="black", linewidth=1.4, label=f"|{symbol}|")
    for axis, colour, part in zip("xyz", colours, parts):
        axes.plot(t, part, color=colour, linewidth=1.2 if has_raw else 0.8, label=f"{symbol}$_{axis}$")
    lowest = min(min(part) for part in parts)
    room = max(whole) - min(lowest, 0)
    if has_raw and room > 0 and max(norm(raw)) > max(whole) + room:
        axes.set_ylim(min(lowest, 0) - room, max(whole) + room)
        axes.set_title(f"raw peaks reach {max(norm(raw)):.3g} {unit.replace('Nm', 'N m')}", loc="right", fontsize="small")


def draw_position(axes, columns):
    """Seen from the first touch, so that depths can be read; from the start if nothing was touched."""
    first = next((i for i, contacts in enumerate(columns["contacts"]) if contacts > 0), 0)
    for axis in "xyz":
        origin = columns[f"{axis}_m"][first]
        axes.plot(columns["t_s"], [1000 * (p - origin) for p in columns[f"{axis}_m"]], linewidth=0.9, label=axis)


def save(figure, path):
    """A new file: never what a link points to, nor with the rights of an older one."""
    if os.path.lexists(path):
        os.unlink(path)
    figure.savefig(path, dpi=120)


def draw_tool(plt, name, columns, path):
    moments = any(abs(m) > 1e-12 for axis in "xyz" for raw in ("", "raw_") for m in columns.get(f"{raw}m{axis}_Nm", []))
    rows = 3 if moments else 2
    figure, axes = plt.subplots(rows, 1, sharex=True, figsize=(8, 2.6 * rows), constrained_layout=True)
    draw_vector(axes[0], columns, ["fx", "fy", "fz"], "N", "F")
    label(axes[0], "force on the tool [N]")
    draw_position(axes[1], columns)
    label(axes[1], "tip, from the first touch [mm]")
    if moments:
        draw_vector(axes[2], columns, ["mx", "my", "mz"], "Nm", "M")
        label(axes[2], "moment [N m]")
    axes[-1].set_xlabel("simulated time [s]")
    axes[0].set_title(f"tool: {name}", loc="left")
    save(figure, path)
    plt.close(figure)


def draw_energy(plt, columns, path):
    time, *others = columns
    figure, axes = plt.subplots(figsize=(8, 3.6), constrained_layout=True)
    for heading in others:
        axes.plot(columns[time], columns[heading], linewidth=1.0, label=heading.removesuffix("_J").replace("_", " "))
    label(axes, "energy [J]")
    axes.set_xlabel("simulated time [s]")
    save(figure, path)
    plt.close(figure)


def draw_all(folder, plt):
    traces = [(name, columns) for name, columns in read_traces(folder) if columns["t_s"]]
    for i, (name, columns) in enumerate(traces):
        picture = "force.png" if i == 0 else f"force_{name}.png"
        draw_tool(plt, name, columns, os.path.join(folder, picture))
    energy = os.path.join(folder, "energy.csv")
    if os.path.exists(energy):
        columns = read_columns(energy)
        if len(next(iter(columns.values()))) > 0:
            draw_energy(plt, columns, os.path.join(folder, "energy.png"))


def main(arguments):
    if len(arguments) != 2:
        print("plot_run.py: give one folder", file=sys.stderr)
        return 2
    try:
        import matplotlib
        matplotlib.use("Agg")
        import matplotlib.pyplot as plt
    except ImportError:
        print("palpate: no matplotlib to draw plots with; install the package python3-matplotlib", file=sys.stderr)
        return 3
    try:
        draw_all(arguments[1], plt)
    except (Mistake, OSError, ValueError) as error:
        print(f"palpate: {error}", file=sys.stderr)
        return 2
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv))
