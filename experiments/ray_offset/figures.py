"""Figures of the ray offset: what went wrong in each place with each offset, and acne against the length."""
import math

from lib import style, table

SELF_HITS = ("acne", "acne, leaning normals", "acne, low facet", "mirror", "air")
PANELS = [("light lost on a body, % (√ scale)", SELF_HITS), ("leaks, % of the room (√ scale)", ("leak",)),
          ("smallest gap kept, of the size", ("gap of a shadow",))]
WIDEST, NARROWEST = 1.0, 2.0**-24  # of the gaps' scale


def places(rows):
    """(size, away) from small to large at the origin, then farther and farther away."""
    return sorted({(r["size_m"], r["away_m"]) for r in rows}, key=lambda p: (p[1], p[0]))


def power(value):
    return f"$10^{{{round(math.log10(value))}}}$"


def label(place):
    return power(place[0]) if place[1] == 0 else power(place[1])


def share(rows, measures):
    """Per cent of what was counted, the worst of the measures; None where nothing was."""
    shares = [100 * r["value"] / r["of"] for r in rows if r["measure"] in measures and r["of"]]
    return max(shares) if shares else None


def drawShares(axis, values):
    """Bars of their square roots, so that a tenth of a per cent can be seen; a dot for none at all."""
    for x, value in enumerate(values):
        if value is None:
            continue
        if value == 0:
            axis.plot([x], [0.35], marker="o", color=style.BLUE, markersize=3)
            continue
        axis.bar(x, max(math.sqrt(value), 0.5), color=style.RED, width=0.8)
        text = f"{value:.0f}" if value >= 9.5 else (f"{value:.1f}" if value >= 0.1 else "<0.1")
        axis.text(x, max(math.sqrt(value), 0.5) + 0.4, text, ha="center", fontsize=7)
    axis.set_ylim(0, 13.5)


def drawGaps(axis, values, default, lost):
    """Hollow where bodies shadow themselves: then a gap may be dark for the wrong reason."""
    for x, (value, share_) in enumerate(zip(values, lost)):
        if value == "none":
            axis.text(x, WIDEST / 8, "×", ha="center", va="center", color=style.RED, fontsize=10, fontweight="bold")
        elif value:
            axis.plot([x], [value], marker="o", color=style.BLUE, markersize=4,
                      markerfacecolor="white" if share_ else style.BLUE)
    for x, value in enumerate(default):
        if value and value != "none":
            axis.plot([x - 0.4, x + 0.4], [value, value], color=style.GREY, linewidth=0.8)
    axis.set_yscale("log")
    axis.set_ylim(NARROWEST / 2, WIDEST)


def drawPlaces(folder):
    rows = table.read(folder, "ray_offset")
    there = places(rows)
    variants = list(dict.fromkeys(r["variant"] for r in rows))
    at = {(v, p): [r for r in rows if r["variant"] == v and (r["size_m"], r["away_m"]) == p]
          for v in variants for p in there}

    def gapsOf(variant):
        return [next((r["value"] for r in at[variant, p] if r["measure"] == PANELS[2][1][0]), None) for p in there]

    figure, axes = style.figure(len(variants), 3, height=0.72 * len(variants) + 1.0, sharex=True, squeeze=False)
    atOrigin = sum(p[1] == 0 for p in there)
    for line, variant in zip(axes, variants):
        for axis, (_, measures) in zip(line[:2], PANELS):
            drawShares(axis, [share(at[variant, p], measures) for p in there])
            axis.set_yticks([])
        drawGaps(line[2], gapsOf(variant), gapsOf(variants[0]), [share(at[variant, p], SELF_HITS) for p in there])
        line[2].set_yticks([1e-6, 1e-3, 1])
        line[2].tick_params(labelsize=7)
        for axis in line:
            axis.axvline(atOrigin - 0.5, color=style.BLACK, linewidth=0.8)
            axis.grid(axis="x", visible=False)
        line[0].set_ylabel(variant.replace(", ", ",\n").replace(" (", "\n("), rotation=0, ha="right", va="center",
                           fontsize=8)
    for axis, (title, _) in zip(axes[0], PANELS):
        axis.set_title(title, fontsize=9.5)
    for axis in axes[-1]:
        axis.set_xticks(range(len(there)), [label(p) if x % 2 == 0 else "" for x, p in enumerate(there)], fontsize=8)
        axis.set_xlabel("size at the origin, m | distance\nfrom the origin of 1 m, m", fontsize=8)
    style.save(figure, folder, "ray_offset")


def drawLengths(folder):
    rows = table.read(folder, "ray_offset_lengths")
    figure, axes = style.figure(1, 3, height=3.4, sharey=True)
    titles = {"acne": "light on convex bodies", "acne, leaning normals": "where normals lean over",
              "mirror": "mirror images"}
    for axis, (measure, title) in zip(axes, titles.items()):
        for i, vector in enumerate(dict.fromkeys(r["vector"] for r in rows)):
            points = [(r["length"], 100 * r["value"] / r["of"]) for r in rows
                      if r["vector"] == vector and r["measure"] == measure]
            style.draw(axis, i, *zip(*points), label=vector)
        axis.axvline(16, color=style.GREY, linewidth=1)
        axis.set_xscale("log", base=2)
        axis.set_yscale("symlog", linthresh=0.01)
        axis.set_ylim(-0.002, 100)
        axis.set_title(title)
        axis.set_xlabel("length in $2^{-24}$ of the coordinates\n(line: the default's, $2^{-20}$)")
    axes[0].set_ylabel("rays that met what they left, %")
    axes[2].legend(fontsize=8, loc="upper right", framealpha=1, edgecolor="none", borderpad=0.2)
    style.save(figure, folder, "ray_offset_lengths")


def draw(folder):
    drawPlaces(folder)
    if (folder / "ray_offset_lengths.tsv").exists():
        drawLengths(folder)
