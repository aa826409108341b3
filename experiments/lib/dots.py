"""Dot plots: a row for each thing, a marker for each scene, the scenes' names once, above the dots of the first row.
Within a row each scene has a height of its own, so that equal values do not hide each other."""
from lib import style

SPREAD = 0.26  # of a row, up and down; less where rows are few and high


def lift(scene, looks, spread):
    """How far above its row a scene is drawn."""
    place = sorted(looks.values()).index(looks[scene])
    return spread * (1 - 2 * place / max(len(looks) - 1, 1)) if len(looks) > 1 else 0.0


def draw(axis, rows, values, looks, size=6.5, spread=SPREAD):
    """rows: names from the top; values: {scene: {row: x}}; looks: {scene: number of a look}."""
    for scene, row in values.items():
        look = {**style.look(looks[scene]), "linestyle": "none"}
        at = [len(rows) - 1 - rows.index(r) + lift(scene, looks, spread) for r in row]
        axis.plot(list(row.values()), at, markersize=size, markerfacecolor="none", markeredgewidth=1.6, clip_on=False,
                  **{**look, "zorder": 3})
    axis.set_yticks(range(len(rows)), rows[::-1])
    axis.set_ylim(-0.6, len(rows) - 0.4)


def names(axis, first, rows, looks, size=8.5, spread=SPREAD):
    """Names of the scenes over the plot, in the order of their dots in the first row, each joined with its own."""
    figure = axis.figure
    figure.canvas.draw()
    order = sorted(first, key=first.get)
    renderer = figure.canvas.get_renderer()
    widths = []
    for scene in order:
        text = axis.text(0, 0, scene, fontsize=size)
        widths.append(text.get_window_extent(renderer).width + size)
        text.remove()
    wanted = [axis.transData.transform((first[scene], 0))[0] for scene in order]
    placed = style.spread(wanted, widths)
    left, right = axis.get_window_extent().x0, axis.get_window_extent().x1
    shift = min(0, right - (placed[-1] + widths[-1] / 2)) or max(0, left - (placed[0] - widths[0] / 2))
    height = axis.get_window_extent().height
    for i, (scene, x) in enumerate(zip(order, placed)):
        to = axis.transAxes.inverted().transform((x + shift, axis.get_window_extent().y0 + height))
        colour = style.look(looks[scene])["color"]
        axis.annotate(scene, xy=(first[scene], rows - 1 + lift(scene, looks, spread)), xytext=(to[0], 1.03),
                      textcoords="axes fraction", ha="center", fontsize=size, color=style.ink(colour),
                      annotation_clip=False,
                      arrowprops={"arrowstyle": "-", "color": colour, "linewidth": 0.6, "shrinkB": 4})
