#!/usr/bin/python3
"""haptic.png: force held against a local plane, and which cases are stable with raw planes and with the local model; below,
the copy of tissue beside the local plane: sines and a tap, felt and borne.

Usage: plot_haptic.py DIR
"""
import sys

from plot_style import plt, read_results, read_table, save, tidy

STIFFNESS = 500


def draw_press(axes, rows, results):
    t = [r["t_s"] for r in rows]
    axes.plot(t, [r["held_force_N"] for r in rows], lw=0.8, color="#c1121f",
              label=f"held, 50 Hz: {results['held_swing_N']:.1f} N p-p at the end")
    axes.plot(t, [r["local_force_N"] for r in rows], lw=1.2, color="#1d3557",
              label=f"local plane, 1 kHz: {results['local_swing_N']:.2g} N")
    axes.set_xlim(0, t[-1])
    tidy(axes, "time [s]", "force [N]")
    axes.set_title("60 g handle pushed by 1 N onto 600 N/m", fontsize=10)
    axes.legend(fontsize=7.5, loc="upper right", frameon=True)


def draw_map(axes, rows, mode):
    """Share of the cases of a rate and delay that swing by more than 200 um; numbers: how many of how many."""
    chosen = [r for r in rows if r["mode"] == mode and r["device"] == "Touch" and r["stiffness_N_per_m"] == STIFFNESS
              and "slab" not in r["object"]]
    rates = sorted({r["rate_Hz"] for r in chosen})
    delays = sorted({r["delay_ms"] for r in chosen})
    for y, rate in enumerate(rates):
        for x, delay in enumerate(delays):
            here = [r for r in chosen if r["rate_Hz"] == rate and r["delay_ms"] == delay]
            bad = sum(r["swing_um"] > 200 for r in here)
            share = bad / len(here) if here else 0
            axes.add_patch(plt.Rectangle((x - 0.5, y - 0.5), 1, 1, color=plt.cm.OrRd(0.85 * share), lw=0))
            axes.text(x, y, f"{bad}/{len(here)}", ha="center", va="center", fontsize=8, color="w" if share > 0.6 else "0.2")
    axes.set_xlim(-0.5, len(delays) - 0.5)
    axes.set_ylim(-0.5, len(rates) - 0.5)
    axes.set_xticks(range(len(delays)), [f"{d:g}" for d in delays])
    axes.set_yticks(range(len(rates)), [f"{r:g}" for r in rates])
    axes.set_xlabel("one-way delay [ms]")
    axes.set_ylabel("rate of patches [Hz]")
    axes.set_title(f"{mode}: cases above 200 um", fontsize=10)


LOOKS = {"copy": ("#1d3557", "copy of tissue"), "local": ("#c1121f", "local plane")}


def draw_sines(axes, rows, what, title):
    """Amplitude over the ideal coupling on O1, a line for each age."""
    for mode, (color, label) in LOOKS.items():
        for age, style in (("2 ms", "-"), ("20 ms", "--"), ("100 ms", ":")):
            chosen = [r for r in rows if r["mode"] == mode and r["tissue"] == "O1" and r["age"] == age]
            axes.semilogx([r["frequency_Hz"] for r in chosen], [r[what] for r in chosen], style, color=color, lw=1.4,
                          marker=".", label=f"{label}, {age}")
    axes.axhspan(0.95, 1.05, color="0.92", lw=0)
    axes.set_ylim(0, 2)
    tidy(axes, "frequency [Hz]", "over the ideal coupling")
    axes.set_title(title, fontsize=10)


def draw_tap(axes, rows):
    t = [1e3 * r["t_s"] for r in rows]
    axes.plot(t, [r["ideal_N"] for r in rows], color="0.7", lw=4, label="ideal coupling")
    for mode, (color, label) in LOOKS.items():
        axes.plot(t, [r[mode + "_felt_N"] for r in rows], color=color, lw=1.4, label=f"{label}, felt")
        axes.plot(t, [r[mode + "_borne_N"] for r in rows], "--", color=color, lw=1.2, label=f"{label}, borne")
    axes.set_xlim(200, 500)
    tidy(axes, "time of the hand [ms]", "force [N]")
    axes.set_title("tap of 0.1 s, 2 mm, O1, 100 ms", fontsize=10)
    axes.legend(fontsize=7, loc="upper right", frameon=True)


def main(folder):
    rows = read_table(folder, "haptic")
    press = read_table(folder, "haptic_press")
    machine, results = read_results(folder, "haptic")
    sines, tap = read_table(folder, "haptic_sines"), read_table(folder, "haptic_tap")
    figure, ((left, middle, right), (tapped, felt, borne)) = plt.subplots(2, 3, figsize=(13, 8), width_ratios=(1.5, 1, 1))
    draw_press(left, press, results)
    draw_map(middle, rows, "raw planes")
    draw_map(right, rows, "local")
    draw_tap(tapped, tap)
    draw_sines(felt, sines, "felt_over_ideal", "felt, 0.5 mm about 2 mm, O1")
    draw_sines(borne, sines, "borne_over_ideal", "borne by the tissue")
    borne.legend(fontsize=7, loc="upper right", frameon=True)
    figure.text(0.54, 0.51, "Touch, K 500 N/m, three hands, static wall and three objects that yield; 1 N held for 3.7 s",
                fontsize=7, color="0.4")
    figure.tight_layout(rect=(0, 0.03, 1, 1), h_pad=3)
    save(figure, folder, "haptic", machine)


if __name__ == "__main__":
    main(sys.argv[1])
