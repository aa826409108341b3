"""One look for all figures: Okabe and Ito's colours, each with a line style and a marker of its own (so that they can
be told apart in grey), labels at the ends of the lines instead of a legend. The same data, drawn again by the same
matplotlib, gives the same bytes.
"""
import io
import re
import sys

import matplotlib

matplotlib.use("Agg")
import matplotlib.colors  # noqa: E402
import matplotlib.ticker  # noqa: E402
import matplotlib.pyplot as pyplot  # noqa: E402  after the backend is chosen

WIDTH = 9.0  # inches; 900 pixels wide on a page
BLACK, ORANGE, SKY, GREEN = "#000000", "#e69f00", "#56b4e9", "#009e73"
YELLOW, BLUE, RED, PURPLE = "#f0e442", "#0072b2", "#d55e00", "#cc79a7"
GREY = "#666666"

# Colour, line style, marker: number i of a figure. No yellow, which is too light for a line.
LOOKS = [(BLUE, "-", "o"), (RED, "--", "s"), (GREEN, "-.", "^"), (PURPLE, (0, (1, 1.2)), "D"),
         (BLACK, (0, (6, 2)), "v"), (ORANGE, (0, (4, 1.5, 1, 1.5, 1, 1.5)), "P"), (SKY, (0, (3, 1)), "X")]

matplotlib.rcdefaults()  # whatever the user's own settings are
pyplot.rcParams.update({
    "font.family": "DejaVu Sans", "mathtext.fontset": "dejavusans",  # matplotlib brings it along
    "font.size": 10, "axes.titlesize": 11, "axes.titlelocation": "left", "axes.titleweight": "bold",
    "axes.spines.top": False, "axes.spines.right": False, "axes.grid": True, "grid.color": "#e4e4e4",
    "grid.linewidth": 0.6, "axes.axisbelow": True, "lines.linewidth": 1.6, "lines.markersize": 4.5,
    "figure.constrained_layout.use": True, "svg.hashsalt": "whittle", "svg.fonttype": "path", "savefig.dpi": 150})


def figure(rows=1, columns=1, height=5.2, **options):
    return pyplot.subplots(rows, columns, figsize=(WIDTH, height), **options)


def look(i):
    colour, line, marker = LOOKS[i % len(LOOKS)]
    return {"color": colour, "linestyle": line, "marker": marker}


def ink(colour):
    """A darker one of the same hue, for text: letters are thinner than lines, and orange ones hard to read on white."""
    return matplotlib.colors.to_hex([0.72 * c for c in matplotlib.colors.to_rgb(colour)])


def draw(axis, i, x, y, low=None, high=None, **options):
    """Line number i with its spread (quartiles) as bars."""
    style = {**look(i), **options}
    axis.plot(x, y, **style)
    if low is not None:
        axis.vlines(x, low, high, color=style["color"], linewidth=3.5, alpha=0.3)


def plainLog(axis, ticks=(1, 2, 5)):
    """Ticks at these multiples of each power of ten, as plain numbers: for logarithmic axes of few decades."""
    axis.set_major_locator(matplotlib.ticker.LogLocator(subs=ticks))
    axis.set_major_formatter(matplotlib.ticker.FormatStrFormatter("%g"))
    axis.set_minor_formatter(matplotlib.ticker.NullFormatter())


class EndLabels:
    """Texts beside the ends of lines, spread so that they do not overlap; a thin line joins each with its end."""

    def __init__(self, axis):
        self.axis, self.labels = axis, []

    def add(self, x, y, text, colour=BLACK):
        self.labels.append((x, y, text, colour))

    def place(self, size=9, gap=1.3):
        """Right of the axes, which the layout makes narrower for them; gap: lines of text from one to the next."""
        placeAll([self], size, gap)

    def draw(self, size, gap):
        figure_ = self.axis.figure
        to = self.axis.transAxes.inverted().transform
        ends = [(self.axis.transData.transform((x, y))[1], x, y, text, colour) for x, y, text, colour in self.labels]
        ends.sort(key=lambda e: e[0])
        step = size * gap * figure_.dpi / 72
        box = self.axis.get_window_extent()
        heights = spread([e[0] for e in ends], [step * (e[3].count("\n") + 1) for e in ends], box.y0, box.y1)
        for (_, x, y, text, colour), height in zip(ends, heights):
            self.axis.annotate(text, xy=(x, y), xytext=(1.03, to((0, height))[1]), textcoords="axes fraction",
                               fontsize=size, color=ink(colour), va="center", annotation_clip=False,
                               arrowprops={"arrowstyle": "-", "relpos": (0, 0.5), "color": colour, "linewidth": 0.6,
                                           "alpha": 0.6, "shrinkB": 3})


def placeAll(labels, size=9, gap=1.3):
    """The labels of all axes of a figure; last, as they go where the lines are in the final layout, which takes long to
    find. It is found without texts: they change widths and no heights."""
    if labels:
        labels[0].axis.figure.draw_without_rendering()
    for each in labels:
        each.draw(size, gap)


def spread(centres, heights, low=float("-inf"), high=float("inf")):
    """Sorted positions between low and high, as near to the wanted ones as may be without overlap: neighbours that
    touch become one block around the mean of what its members want."""

    def inside(start, height):
        return max(min(start, high - height), low)
    blocks = []  # members, height, start
    for i, (centre, height) in enumerate(zip(centres, heights)):
        blocks.append([[i], height, inside(centre - height / 2, height)])
        while len(blocks) > 1 and blocks[-2][2] + blocks[-2][1] > blocks[-1][2]:
            later = blocks.pop()
            members, total = blocks[-1][0] + later[0], blocks[-1][1] + later[1]
            start, offset = 0.0, 0.0
            for m in members:
                start += centres[m] - heights[m] / 2 - offset
                offset += heights[m]
            blocks[-1] = [members, total, inside(start / len(members), total)]
    placed = [0.0] * len(centres)
    for members, _, start in blocks:
        for m in members:
            placed[m] = start + heights[m] / 2
            start += heights[m]
    return placed


def save(figure_, folder, name):
    """FOLDER/NAME.svg."""
    folder.mkdir(parents=True, exist_ok=True)
    figure_.draw_without_rendering()
    figure_.set_layout_engine("none")  # the layout is found: once is enough, it takes longer than drawing
    text = io.StringIO()
    figure_.savefig(text, format="svg", metadata={"Date": None, "Creator": None})
    (folder / f"{name}.svg").write_text(numberedClips(text.getvalue()), encoding="utf-8")
    pyplot.close(figure_)
    print(f"drawn: {folder.name}/{name}.svg", file=sys.stderr, flush=True)


def numberedClips(svg):
    """Clip paths numbered in their order: matplotlib names them after addresses in memory."""
    names = dict.fromkeys(re.findall(r'<clipPath id="(p[0-9a-f]{10})"', svg))
    numbers = {name: f"clip{i}" for i, name in enumerate(names)}
    return re.sub(r"\bp[0-9a-f]{10}\b", lambda found: numbers.get(found[0], found[0]), svg)


def legendAbove(figure_, handles, labels, inches=0.3, **options):
    """One legend for all panels, in a strip of that height above them."""
    share = inches / figure_.get_figheight()
    figure_.get_layout_engine().set(rect=(0, 0, 1, 1 - share))
    figure_.legend(handles, labels, loc="upper center", frameon=False, fontsize=8.5, **options)


def sceneText(name):
    """cornell_box -> "Cornell box"."""
    words = name.replace("_", " ").replace("-", " ")
    return {"cornell box": "Cornell box", "sponza": "Sponza", "crytek sponza": "Sponza"}.get(words, words)


def threadsText(threads):
    return "1 thread" if threads == 1 else f"{threads} threads"


def bytesText(value):
    """1536 -> "1.5 KiB"."""
    for unit in ("B", "KiB", "MiB", "GiB"):
        if value < 1024 or unit == "GiB":
            return f"{value:.3g} {unit}"
        value /= 1024


def countText(value):
    """33554432 -> "33.6 M"."""
    for limit, unit in ((1e6, " M"), (1e3, " k")):
        if value >= limit:
            return f"{value / limit:.3g}{unit}"
    return f"{value:g}"
