"""E4: Is the memory of the tree linear in the triangles, and how many bytes does a triangle take?

Height fields of 2 N² triangles, then the project's own scenes and, where they are, shared ones, to see whether other
shapes need as much. Held constant: device and settings that decide what is kept of a scene. Nothing is timed; the
bytes come from the statistics (groups `tree`: nodes, and `triangles`: corners and all else; buffers by name) and, for the two-wide tree that a CPU
does not upload, from `whittle bench`.

Writes e4_memory.tsv (a row for each scene); figure e4_memory.
"""
from lib import fit, style, table
from lib.context import SCENES, size

COLUMNS = ["scene", "kind", "triangles", "tree", "triangle_bytes", "bvh8Nodes", "leaves", "bvh2Nodes", "resident"]
SHARED = ["bench/crytek-sponza/crytek-sponza.glb", "bench/teapot-full/teapot-full.glb",
          "bench/cornell-mcguire/CornellBox-Original.glb"]
BENCHED = 200_000  # triangles; larger scenes need not be benched, as theirs are the same bytes for each triangle


def row(context, scene, name, kind, out):
    s = context.render(scene, "--search", "tree", "--bounces", 1, *size(16, 9))
    memory, triangles = s["memory"], s["scene"]["triangles"]
    buffers = {b["name"]: b["bytes"] for b in memory["buffers"]}
    two = ""
    if 1 < triangles <= BENCHED:
        report = context.bench(scene, "--rays", 1024, "--runs", 1)
        each = {k["kernel"]: k["nodeBytesPerTriangle"] for k in report["kernels"]}
        two = round(triangles * each["single2"])
    out.row(scene=name, kind=kind, triangles=triangles, tree=memory["tree"], triangle_bytes=memory["triangles"],
            bvh8Nodes=buffers.get("bvh8Nodes", ""), leaves=buffers.get("leaves", ""), bvh2Nodes=two,
            resident=memory["total"])


def measure(context):
    out = context.table("e4_memory", COLUMNS)
    squares = context.pick([1, 4, 16, 64, 256], [1, 2, 3, 4, 6, 8, 12, 16, 24, 32, 48, 64, 96, 128, 192, 256, 512, 1024,
                                                 2048])
    own = context.pick(["cornell_box"], sorted(f.stem for f in SCENES.glob("*.glb")))
    others = [(f"{SCENES / name}.glb", name, "own") for name in own if name != "height_field"]
    others += [(f, f.stem, "shared") for f in map(context.shared, context.pick(SHARED[:1], SHARED)) if f]
    progress = context.progress("e4", len(squares) + len(others))
    for n in squares:
        scene = context.heightField(n)
        row(context, scene, f"height field {n}", "height field", out)
        scene.unlink()
        progress.step(f"{2 * n**2} triangles")
    for file, name, kind in others:
        row(context, file, name, kind, out)
        progress.step(name)


FORMERLY = {"wideNodes": "bvh8Nodes", "twoWideNodes": "bvh2Nodes"}  # columns of tables of older runs
LINES = [("tree", "tree of the searches:\neight-wide nodes, leaves"), ("triangle_bytes", "triangle records"),
         ("bvh8Nodes", "eight-wide nodes alone"), ("bvh2Nodes", "two-wide nodes\n(GPUs use these)")]


def growth(x, y):
    """What the straight end says of the exponent, where it has points to spare."""
    first = fit.straightEnd(x, y)
    return "" if len(x) - first < 4 else f"; grows as n^({fit.shown(*fit.power(x[first:], y[first:])[1])})"


def others(axis, rows, i, column):
    """Scenes that are no height fields, over the line; those far off it with their names."""
    usual = max((r["triangles"], r[column] / r["triangles"]) for r in rows if r["kind"] == "height field")[1]
    for r in rows:
        if r["kind"] == "height field" or r["triangles"] <= 100:
            continue
        each = r[column] / r["triangles"]
        axis.plot(r["triangles"], each, linestyle="", marker="+", markersize=9, color=style.BLACK, zorder=4)
        if each > 1.1 * usual:
            axis.annotate(f"{style.sceneText(r['scene'])} {each:.1f} B", (r["triangles"], each), (0, 6), ha="center",
                          textcoords="offset points", fontsize=8, color=style.ink(style.look(i)["color"]))


def plot(folder):
    rows = table.read(folder, "e4_memory", formerly=FORMERLY)
    figure, (top, bottom) = style.figure(rows=2, height=7.6, sharex=True, height_ratios=[1.3, 1])
    above, below = style.EndLabels(top), style.EndLabels(bottom)
    fields = [r for r in rows if r["kind"] == "height field"]
    for i, (column, words) in enumerate(LINES):
        points = sorted((r["triangles"], r[column]) for r in fields if r[column] != "")
        x, y = zip(*points)
        law = fit.linear(x, y)
        style.draw(top, i, x, y)
        colour = style.look(i)["color"]
        above.add(x[-1], y[-1], f"{words}\n{law.values[1]:.1f} B each", colour)
        each = [b / n for n, b in points]
        style.draw(bottom, i, x, each)
        below.add(x[-1], each[-1], f"{each[-1]:.1f} B", colour)
        if column == "tree":
            title = f"Tree: {law.values[1]:.1f} B for each triangle{growth(x, y)}"
    for i in (0, 1):
        others(bottom, rows, i, LINES[i][0])
    top.set(xscale="log", yscale="log", ylabel="bytes", title=title)
    bottom.set(yscale="log", xlabel="triangles", ylabel="bytes for each triangle\n(+: other scenes)")
    style.plainLog(bottom.yaxis)
    style.placeAll([above, below])
    style.save(figure, folder, "e4_memory")
