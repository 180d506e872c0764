"""What the plots of `palpate bench` share: reading a table, naming the machine, a plain look.

A plotter NAME is `plot_NAME.py DIR` and draws DIR/NAME.png from DIR/NAME.csv and DIR/NAME.json.
Exit code 0 done, 2 nothing to draw from, 3 matplotlib is missing.
"""
import csv
import json
import os
import sys

try:
    import matplotlib
    matplotlib.use("Agg")
    import matplotlib.pyplot as plt
except ImportError:
    print("palpate bench: no matplotlib to draw plots with; install the package python3-matplotlib", file=sys.stderr)
    sys.exit(3)


def number(word):
    try:
        return float(word)
    except ValueError:
        return word


def read_table(folder, name):
    """The rows of a table as dictionaries; numbers are numbers."""
    path = os.path.join(folder, name + ".csv")
    try:
        with open(path, newline="", encoding="utf-8") as file:
            rows = [{key: number(word) for key, word in row.items()} for row in csv.DictReader(file)]
    except OSError as error:
        rows = []
        print(f"palpate bench: {path}: {error.strerror}", file=sys.stderr)
    if not rows:
        print(f"palpate bench: {path}: nothing to draw", file=sys.stderr)
        sys.exit(2)
    return rows


def read_results(folder, name):
    """machine and results of DIR/NAME.json."""
    with open(os.path.join(folder, name + ".json"), encoding="utf-8") as file:
        whole = json.load(file)
    return whole["machine"], whole["results"]


def tidy(axes, xlabel, ylabel):
    axes.set_xlabel(xlabel)
    axes.set_ylabel(ylabel)
    axes.grid(True, which="major", color="0.9")
    axes.spines[["top", "right"]].set_visible(False)


def save(figure, folder, name, machine):
    """Writes DIR/NAME.png with commit, machine and date at its foot."""
    compiler = machine["compiler"].split(" ")[0]
    foot = (f"palpate {machine['commit']}, g++ {compiler}, {machine['cpu']}, {machine['cores']} cores, "
            f"{machine['instruction_set']}, {machine['date']}")
    if "load" in machine:
        foot += f", load {machine['load']:.1f}"
    figure.text(0.01, 0.005, foot, fontsize=7, color="0.4")
    figure.savefig(os.path.join(folder, name + ".png"), dpi=130)
    plt.close(figure)
