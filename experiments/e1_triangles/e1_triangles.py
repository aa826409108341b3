"""E1: How does the time to render grow with the number of triangles, with the array and with the tree?

Height fields of 2 N² triangles that always show the same hills in the same part of the picture; eye rays, one
shadow ray for each hit on the sunny side, nothing else. Held constant: scene, camera, lights, device, build. Varied:
triangles, search, threads, size of the picture. At each size the curves take turns; an array ends before the size at
which its run would take longer than LIMIT seconds; trees end with the generator or with the memory.

Writes e1_triangles.tsv (a row for each run: seconds, bytes, counts), e1_ends.tsv (where each curve ended and why);
figures e1_triangles and e1_build.
"""
from lib import fit, style, table
from lib.context import RunFailed, size
from lib.measure import curve, interleaved

COLUMNS = ["curve", "search", "threads", "width", "height", "squares", "triangles", "repetition", "render", "build",
           "load", "upload", "rays", "tree", "triangle_bytes", "memory"]
LIMIT = 300.0  # seconds of one run with the array
CLEAR = 0.2  # an exponent known less well is not stated


def curves(threads):
    """Name -> search, threads, width, height, in the order of the labels; the seven that were asked for."""
    wanted = [("array", 1, 320, 180), ("array", threads, 320, 180), ("tree", 1, 320, 180), ("tree", threads, 320, 180),
              ("tree", threads, 160, 90), ("tree", threads, 640, 360), ("tree", threads, 1280, 720)]
    return {f"{s} {t} {w}x{h}": (s, t, w, h) for s, t, w, h in wanted}


def sizes(context):
    if context.quick:
        return [1, 4, 16, 64, 256]
    return sorted([2**k for k in range(13)] + [3 * 2**k for k in range(10)])


def work(squares):
    """About the seconds that a size takes: processes that start, arrays as far as they go, trees that are built."""
    return 20 + squares**2 / (3000 if squares < 1100 else 9500 if squares < 1800 else 35000)


def renders(context, scene, chosen):
    def one(search, threads, width, height):
        return lambda: context.render(scene, "--search", search, "--threads", threads, *size(width, height))
    return {name: one(*settings) for name, settings in chosen.items()}


def measureSize(context, squares, chosen, out):
    """The rows of one size; the seconds of the last run of each curve."""
    last = {}
    scene = context.heightField(squares)
    repetitions = context.pick(2, lambda seconds: 5 if seconds < 2 else 3)
    for name, repetition, s in interleaved(renders(context, scene, chosen), repetitions):
        search, threads, width, height = chosen[name]
        out.row(curve=name, search=search, threads=threads, width=width, height=height, squares=squares,
                triangles=s["scene"]["triangles"], repetition=repetition, rays=s["rays"]["total"],
                **{key: s["time"][key] for key in ("render", "build", "load", "upload")},
                tree=s["memory"]["tree"], triangle_bytes=s["memory"]["triangles"], memory=s["memory"]["total"])
        last[name] = s["time"]["render"]
    scene.unlink()
    return last


def measureAll(context, out, ends):
    chosen = curves(context.threads)
    limit = context.pick(1.0, LIMIT)
    todo = sizes(context)
    progress = context.progress("e1", sum(map(work, todo)))
    for before, squares in zip([0, *todo], todo):
        try:
            last = measureSize(context, squares, chosen, out)
        except RunFailed as refusal:
            for name in chosen:
                ends.row(curve=name, squares=before, reason=str(refusal))
            return
        progress.step(f"{2 * squares**2} triangles, {len(chosen)} curves", work(squares))
        following = next((n for n in todo if n > squares), squares)
        for name in [n for n in chosen if chosen[n][0] == "array" and squares > 8]:
            expected = last[name] * (following / squares)**2
            if expected > limit:
                ends.row(curve=name, squares=squares, reason=f"the next size would take {expected:.0f} s")
                del chosen[name]
    for name in chosen:
        ends.row(curve=name, squares=todo[-1], reason="the last size")


def measure(context):
    ends = context.table("e1_ends", ["curve", "squares", "reason"])
    measureAll(context, context.table("e1_triangles", COLUMNS), ends)


def trend(axis, x, y, colour):
    """Draws the power law of the straight end over the points that it was fitted to; None where it says nothing: fewer
    than three points, or an exponent whose interval is wider than CLEAR to either side."""
    first = fit.straightEnd(x, y)
    if len(x) - first < 3:
        return None, x[0]
    law = fit.power(x[first:], y[first:])
    if law[1][1] > CLEAR:
        return None, x[first]
    ends = [x[first] / 1.5, x[-1] * 1.5]
    axis.plot(ends, law.curve(ends), color=colour, linewidth=5, alpha=0.22, solid_capstyle="butt")
    return law, x[first]


def exponent(law, first):
    return f"∝ n^({fit.shown(*law[1])}) from {style.countText(first)}" if law else "no clear exponent"


def statement(rows, laws):
    """The title, from the data: the array's exponent at 320×180 with all threads, and how far apart the two ended."""
    threads = max(r["threads"] for r in rows)
    names = {s: f"{s} {threads} 320x180" for s in ("array", "tree")}
    points = {s: curve(rows, "triangles", "render", curve=name) for s, name in names.items()}
    both = [n for n in points["array"][0] if n in points["tree"][0]]
    if not both or not laws[names["array"]]:
        return "Time of a frame against the number of triangles"
    median = {s: dict(zip(p[0], p[1])) for s, p in points.items()}
    gain = median["array"][both[-1]] / median["tree"][both[-1]]
    a = laws[names["array"]].values[1]
    return f"Array: time ∝ n^{a:.2f}.  Tree: {gain:,.0f} times as fast at {style.countText(both[-1])} triangles"


def plotTimes(rows, folder):
    figure, axis = style.figure(height=6.2)
    axis.set(xscale="log", yscale="log", xlabel="triangles n", ylabel="time to render a frame, s")
    axis.margins(y=0.1)
    labels, laws = style.EndLabels(axis), {}
    for i, (name, (search, threads, width, height)) in enumerate(curves(max(r["threads"] for r in rows)).items()):
        x, y, low, high = curve(rows, "triangles", "render", curve=name)
        if not x:
            continue
        style.draw(axis, i, x, y, low, high)
        colour = style.look(i)["color"]
        laws[name], first = trend(axis, x, y, colour)
        text = f"{search}, {style.threadsText(threads)}, {width}×{height}\n{exponent(laws[name], first)}"
        if search == "array":  # ends amid the plot, with room beside it
            one = threads == 1
            axis.annotate(text, (x[-1], y[-1]), (-14 if one else 12, 8 if one else -8), textcoords="offset points",
                          color=colour, fontsize=9, ha="right" if one else "left", va="bottom" if one else "top")
        else:
            labels.add(x[-1], y[-1], text, colour)
    axis.set_title(statement(rows, laws))
    labels.place()
    style.save(figure, folder, "e1_triangles")


def plotBuild(rows, folder):
    figure, axis = style.figure(height=4.2)
    axis.set(xscale="log", yscale="log", xlabel="triangles n", ylabel="time, s")
    labels, fitted = style.EndLabels(axis), []
    most = max(r["threads"] for r in rows)
    lines = [("load", most, "load the file"), ("build", 1, "build the tree, 1 thread"),
             ("build", most, f"build the tree, {style.threadsText(most)}")]
    for i, (key, threads, words) in enumerate(lines):
        x, y, low, high = curve([r for r in rows if r["search"] == "tree"], "triangles", key,
                                        curve=f"tree {threads} 320x180")
        style.draw(axis, i, x, y, low, high)
        law, first = trend(axis, x, y, style.look(i)["color"])
        fitted.append((words, y[-1] / x[-1]))
        labels.add(x[-1], y[-1], f"{words}\n{exponent(law, first)}", style.look(i)["color"])
    last = max(r["triangles"] for r in rows)
    axis.set_title(f"At {style.countText(last)} triangles, each takes " +
                   ", ".join(f"{1e9 * seconds:.0f} ns to {words}" for words, seconds in fitted[::2]))
    labels.place()
    style.save(figure, folder, "e1_build")


def plot(folder):
    rows = table.read(folder, "e1_triangles")
    plotTimes(rows, folder)
    plotBuild(rows, folder)
