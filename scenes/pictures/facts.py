#!/usr/bin/env python3
"""What each picture shows and costs, as the table of scenes/README.md.

    scenes/pictures/make.sh build/release/whittle /tmp/statistics
    scenes/pictures/facts.py /tmp/statistics            prints it
    scenes/pictures/facts.py /tmp/statistics --write    puts it into scenes/README.md

Rows without statistics there keep their cells. Times hold for the machine that made the statistics.
"""
import json
import pathlib
import sys

README = pathlib.Path(__file__).resolve().parent.parent / "README.md"
BEGIN, END = "<!-- facts.py writes this table -->", "<!-- to here -->"
HEAD = ["picture", "purpose", "how", "triangles", "rays: primary, impulse, shadow (million)", "seconds"]

# Of each picture, in the order of the table.
PURPOSES = {
    "cornell_box": "all effects together in a small room",
    "mirror_box_1": "depth: what one bounce shows",
    "mirror_box_2": "two",
    "mirror_box_7": "seven",
    "mirror_box_32": "and 32: the mirrors swallow the light before the limit does",
    "spot_cone": "soft and hard edges of cones",
    "emission": "surfaces that glow, and their images",
    "shadow": "shadows of three lamps, one behind a ball that must cast none",
    "mirror": "flat and round mirrors",
    "refraction": "bending, total reflection, absorption",
    "anti_aliasing_1": "detail below a pixel with one ray",
    "anti_aliasing_64": "and with 64",
    "nested_glass": "glass in glass, liquids",
    "textured": "textures, cut-outs, blending",
    "breakfast": "composition: sun, silver, glass and honey",
    "diner": "composition: neon and chrome after rain",
    "watchmaker": "composition: a clockwork in lamp light",
}
LARGE = ("breakfast", "diner", "watchmaker")


def command(name, settings):
    """Options that make the picture what it is; the rest is in make.sh."""
    size = f"{settings['width']}×{settings['height']}"
    scene = f"`--{name}`" if name in LARGE else f"`{name.rstrip('_0123456789')}.glb`"
    return f"{scene}, {size}, {counted(settings['raysPerPixel'], 'ray')}, {counted(settings['bounces'], 'bounce')}"


def counted(count, noun):
    return f"{count} {noun}{'' if count == 1 else 's'}"


def million(count):
    if count == 0:
        return "0"
    return f"{count / 1e6:.1f}" if count >= 1e5 else f"{count / 1e6:.2f}"


def row(name, file, old):
    picture = name + (".jpg" if name in LARGE else ".png")
    cells = [f"[{name}](pictures/{picture})", PURPOSES[name]]
    if not file.exists():
        return cells + (old[2:] if old else ["", "", "", ""])
    stats = json.loads(file.read_text())
    rays = stats["rays"]
    return cells + [command(name, stats["settings"]), f"{stats['scene']['triangles']:,}".replace(",", " "),
                    ", ".join(million(rays[kind]) for kind in ("primary", "impulse", "shadow")),
                    f"{stats['time']['total']:.0f}" if stats["time"]["total"] >= 10 else f"{stats['time']['total']:.1f}"]


def cellsByName(table):
    rows = {}
    for line in table.splitlines():
        cells = [cell.strip() for cell in line.strip().strip("|").split("|")]
        if cells[0].startswith("["):
            rows[cells[0][1:cells[0].index("]")]] = cells
    return rows


def main():
    folder = pathlib.Path(sys.argv[1])
    text = README.read_text()
    before, rest = text.split(BEGIN)
    old, after = rest.split(END)
    known = cellsByName(old)
    rows = [HEAD, ["---"] * 3 + ["---:"] * 3] + [row(name, folder / f"{name}.json", known.get(name)) for name in PURPOSES]
    table = "\n".join("| " + " | ".join(cells) + " |" for cells in rows)
    if "--write" in sys.argv[2:]:
        README.write_text(f"{before}{BEGIN}\n\n{table}\n\n{END}{after}")
    else:
        print(table)


if __name__ == "__main__":
    main()
