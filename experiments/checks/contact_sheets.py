#!/usr/bin/python3
"""Does any scene come out black, burnt out or empty? Every scene there is, ours and shared ones, small, at several
shapes of picture, with the options that a newcomer gives: none. As a table: shares of pixels that are black, white,
and of the commonest colour. With --sheets also as contact sheets, PNG files that one can look at; with --other a second build's picture
stands to the right of each.

usage: experiments/run contact_sheets [-- [--sheets FOLDER] [--other WHITTLE] [--shapes 16:9,1:1,9:16] [SCENE ...]]
needs: Debian's python3-numpy and python3-openimageio; /usr/bin/python3
"""
import argparse
import pathlib
import subprocess
import sys
import tempfile

import numpy
import OpenImageIO as oiio

from same_bits import ROOT, scenes

LONGER = 144  # pixels of a picture's longer side
LABEL = 14    # pixels of the line below it
COLUMNS, ROWS = 10, 8
FONT = "/usr/share/fonts/truetype/dejavu/DejaVuSans.ttf"  # of fonts-dejavu-core; without it the sheets have no names
NAMELESS = ("scene", "untitled")  # files that are called so have the name of their folder


def sides(shape):
    across, down = (float(part) for part in shape.split(":"))
    return round(LONGER * min(1, across / down)), round(LONGER * min(1, down / across))


def nameOf(scene):
    if scene.stem.lower() in NAMELESS:
        return scene.parent.name
    return scene.stem


def render(whittle, scene, width, height, folder):
    """Codes of the .png, [height, width, 3]; None where the program refuses the scene, with its line."""
    picture = folder / "picture.png"
    picture.unlink(missing_ok=True)
    done = subprocess.run([whittle, "render", scene, "-o", picture, "--quiet", "--width", str(width), "--height",
                           str(height), "--rays-per-pixel", "4"], capture_output=True, text=True)
    if done.returncode != 0:
        return None, (done.stderr.strip().split("\n") or [""])[-1]
    image = oiio.ImageInput.open(str(picture))  # an ImageBuf may show what a cache has of the file's last content
    codes = image.read_image(oiio.UINT8)[..., :3]
    image.close()
    return codes, ""


def shares(codes):
    """Of pixels: black, white, and of the commonest colour."""
    flat = codes.reshape(-1, 3)
    _, counts = numpy.unique(flat, axis=0, return_counts=True)
    return (flat.max(axis=1) < 4).mean(), (flat.min(axis=1) > 251).mean(), counts.max() / len(flat)


class Sheets:
    """Pictures row by row, each with its name below; a file for each COLUMNS x ROWS of them."""

    def __init__(self, folder, stem, width, height, side_by_side):
        self.folder, self.stem = folder, stem
        self.width, self.height, self.pictures = width, height, side_by_side
        self.cells, self.sheets = [], 0

    def add(self, name, pictures):
        self.cells.append((name, pictures))
        if len(self.cells) == COLUMNS // self.pictures * ROWS:
            self.write()

    def write(self):
        if not self.cells:
            return
        across = COLUMNS // self.pictures
        cell = self.pictures * self.width + 4, self.height + LABEL
        rows = (len(self.cells) + across - 1) // across
        sheet = oiio.ImageBuf(oiio.ImageSpec(across * cell[0], rows * cell[1], 3, oiio.UINT8))
        oiio.ImageBufAlgo.fill(sheet, (0.2, 0.2, 0.2))
        for i, (name, pictures) in enumerate(self.cells):
            left, top = i % across * cell[0], i // across * cell[1]
            for p, codes in enumerate(pictures):
                if codes is None:
                    continue
                one = oiio.ImageBuf(oiio.ImageSpec(self.width, self.height, 3, oiio.UINT8))
                one.set_pixels(oiio.ROI(0, self.width, 0, self.height, 0, 1, 0, 3), numpy.ascontiguousarray(codes))
                oiio.ImageBufAlgo.paste(sheet, left + p * self.width, top, 0, 0, one)
            label = name[:self.width * self.pictures // 6]
            oiio.ImageBufAlgo.render_text(sheet, left + 2, top + self.height + LABEL - 4, label, 10, FONT, (1, 1, 1))
        sheet.write(str(self.folder / f"{self.stem}_{self.sheets:02}.png"))
        self.sheets += 1
        self.cells = []


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("scenes", nargs="*", type=pathlib.Path)
    parser.add_argument("--whittle", type=pathlib.Path, default=ROOT / "build" / "release" / "whittle")
    parser.add_argument("--other", type=pathlib.Path)
    parser.add_argument("--shapes", default="16:9,1:1,9:16")
    parser.add_argument("--sheets", type=pathlib.Path)
    a = parser.parse_args()
    builds = [a.whittle] + ([a.other] if a.other else [])
    if a.sheets:
        a.sheets.mkdir(parents=True, exist_ok=True)
    print("scene", "shape", "black", "white", "commonest", "refused", sep="\t")
    with tempfile.TemporaryDirectory() as folder:
        for shape in a.shapes.split(","):
            width, height = sides(shape)
            sheets = Sheets(a.sheets, f"sheet_{shape.replace(':', 'x')}", width, height, len(builds))
            for scene in a.scenes or scenes():
                pictures = [render(whittle, scene, width, height, pathlib.Path(folder)) for whittle in builds]
                codes, line = pictures[0]
                found = [f"{share:.3f}" for share in shares(codes)] if codes is not None else ["", "", ""]
                print(nameOf(scene), shape, *found, line, sep="\t", flush=True)
                print(f"{nameOf(scene):48} {shape}", file=sys.stderr)
                if a.sheets:
                    sheets.add(nameOf(scene), [codes for codes, _ in pictures])
            if a.sheets:
                sheets.write()


if __name__ == "__main__":
    main()
