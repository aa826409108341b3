"""The page of `whittle scale` in headless Chromium: no message on the console at three widths, and the table says what
the JSON does. Exits with 77 where there is no Chromium. usage: report_page_test.py WHITTLE SCENE"""
import html.parser
import json
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile


class Table(html.parser.HTMLParser):
    """Rows of cells of the first table."""

    def __init__(self, text):
        super().__init__()
        self.rows, self.isCell = [], False
        self.feed(text)

    def handle_starttag(self, tag, _):
        if tag == "tr":
            self.rows.append([])
        self.isCell = tag in ("td", "th") or (self.isCell and tag == "button")
        if tag in ("td", "th"):
            self.rows[-1].append("")

    def handle_endtag(self, tag):
        self.isCell = self.isCell and tag not in ("td", "th")

    def handle_data(self, data):
        if self.isCell:
            self.rows[-1][-1] += data


def browse(chromium, page, width):
    """The DOM after the scripts ran, and what was said on the console."""
    with tempfile.TemporaryDirectory() as profile:
        command = [chromium, "--headless", "--no-sandbox", "--disable-gpu", f"--window-size={width},900", "--dump-dom",
                   f"--user-data-dir={profile}", "--enable-logging=stderr", page.as_uri()]
        done = subprocess.run(command, capture_output=True, text=True, timeout=120)
    return done.stdout, [line for line in done.stderr.splitlines() if "CONSOLE" in line]


def main(whittle, scene):
    chromium = shutil.which("chromium") or shutil.which("chromium-browser")
    if not chromium:
        print("skipped: no chromium")
        return 77
    with tempfile.TemporaryDirectory() as folder:
        page = pathlib.Path(folder, "page.html")
        command = [whittle, "scale", scene, "--width", "48", "--height", "27", "--within", "50%", "--time-limit", "1",
                   "--threads", "1,2", "--lanes", "1,16", "--json", "--report", page]
        points = json.loads(subprocess.run(command, capture_output=True, check=True, text=True).stdout)["points"]
        assert page.stat().st_size < 200_000, page.stat().st_size
        for width in (375, 1280, 2560):
            dom, console = browse(chromium, page, width)
            assert not console, console
            assert dom.count("<circle") == 2 * len(points), "a marker and what the mouse meets for each point"
            head, *rows = Table(dom).rows
            assert head[:3] == ["threads", "lanes", "frame, ms"], head
            assert len(rows) == len(points)
            for row, point in zip(rows, points):
                assert row[:2] == [point["values"]["threads"], point["values"]["lanes"]], row
                shown = float(re.match(r"[0-9.e+-]+", row[2])[0])
                assert abs(shown / (1e3 * point["seconds"]["median"]) - 1) < 6e-3, (row, point["seconds"])  # 3 digits
    return 0


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
