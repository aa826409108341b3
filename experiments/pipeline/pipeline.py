"""Draws the pipeline: what runs on host and device, the queue between two stages, and what is left out when.

Writes the figure pipeline; nothing is measured.
"""
from matplotlib.patches import FancyBboxPatch

from lib import style

HOST, DEVICE, QUEUE = "#e8eef5", "#fdf0e0", "#ffffff"
HEIGHT = 0.62

# name, second line, x, y, width
HOST_BOXES = [("load", "glTF → Scene", 0.2, 6.6, 1.7), ("prune", "what is seen at all", 2.3, 6.6, 1.9),
              ("features", "what is compiled, run", 4.6, 6.6, 2.0),
              ("build tree", "two- and eight-wide", 7.0, 7.0, 1.9), ("compile", "three programs", 7.0, 6.1, 1.9),
              ("upload", "device scene, queues", 9.3, 6.6, 2.0)]
STAGES = [("raygen", "eye rays", 0.2, 4.4), ("intersect", "nearest hits", 2.5, 4.4),
          ("shade", "surfels, candidates", 4.8, 4.4), ("compact", "count, scan, scatter", 7.1, 4.4),
          ("occlude", "any hit to the light", 9.4, 4.4),
          ("accumulate", "entries into samples", 9.4, 2.5), ("film", "samples into pixels", 9.4, 0.8)]
STAGE_WIDTH = 1.9


def box(axis, name, text, x, y, width, colour):
    axis.add_patch(FancyBboxPatch((x, y - HEIGHT / 2), width, HEIGHT, boxstyle="round,pad=0.05,rounding_size=0.08",
                                  facecolor=colour, edgecolor=style.GREY, linewidth=0.9))
    axis.text(x + width / 2, y + 0.11, name, ha="center", va="center", fontsize=10, fontweight="bold")
    axis.text(x + width / 2, y - 0.17, text, ha="center", va="center", fontsize=7.8, color="#333333")


def arrow(axis, start, end, text="", bend=0.0, at=(0.0, 0.16), colour=style.BLACK):
    axis.annotate("", xy=end, xytext=start, arrowprops={
        "arrowstyle": "-|>", "color": colour, "linewidth": 1.2, "shrinkA": 2, "shrinkB": 2,
        "connectionstyle": f"arc3,rad={bend}"})
    if text:
        axis.text((start[0] + end[0]) / 2 + at[0], (start[1] + end[1]) / 2 + at[1], text, ha="center", va="center",
                  fontsize=7.8, color=colour)


def drawHost(axis):
    for name, text, x, y, width in HOST_BOXES:
        box(axis, name, text, x, y, width, HOST)
    arrow(axis, (1.95, 6.6), (2.25, 6.6))
    arrow(axis, (4.25, 6.6), (4.55, 6.6))
    arrow(axis, (6.65, 6.65), (6.95, 6.95))
    arrow(axis, (6.65, 6.55), (6.95, 6.15))
    arrow(axis, (8.95, 6.95), (9.25, 6.65))
    arrow(axis, (8.95, 6.15), (9.25, 6.55))


def drawDevice(axis):
    for name, text, x, y in STAGES:
        box(axis, name, text, x, y, STAGE_WIDTH, DEVICE)
    y = 4.4
    for x, words in ((2.1, "rays"), (4.4, "hits"), (6.7, "candidates"), (9.0, "shadow queue")):
        arrow(axis, (x + 0.02, y), (x + 0.38, y), words, at=(0.0, 0.56))
    arrow(axis, (10.35, 4.05), (10.35, 2.86), "radiance of entries", at=(-0.8, 0.0))
    arrow(axis, (10.35, 2.15), (10.35, 1.16), "radiance of samples", at=(-0.8, 0.0))
    arrow(axis, (8.05, 4.05), (3.45, 4.03), "next ray queue: impulses, stable order; cut before it would overflow",
          bend=-0.28, at=(0.0, -0.93), colour=style.BLUE)
    axis.text(5.75, 2.87, "for each bounce, while rays are left", fontsize=7.8, color=style.BLUE, ha="center",
              va="center")
    axis.text(0.2, 1.15, "Left out where nothing needs it: shadow queue and occlude (no lights, no shadows);\n"
              "impulses, accumulate and every bounce after the first (no mirror, no glass);\n"
              "planes for a second impulse (no surface sends two); throughputs of eye rays.",
              fontsize=8.5, color="#333333", va="center")


def plot(folder):
    figure, axis = style.figure(height=5.6)
    axis.set(xlim=(0, 11.5), ylim=(0.2, 7.9))
    axis.axis("off")
    axis.text(0.2, 7.55, "host, once", fontsize=10, color=style.GREY)
    axis.text(0.2, 5.35, "device, for each batch of samples that fits the queues", fontsize=10, color=style.GREY)
    drawHost(axis)
    drawDevice(axis)
    style.save(figure, folder, "pipeline")
