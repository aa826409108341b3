"""E10: Which of the numerical cases come out right, and by how much?

Runs the tests that record rows (tests/support/record.h) and writes the page stability.md: for each check of a case
its construction, what was expected and why, what came out, the error and its limit. Cases that take minutes run whole,
but with --quick: then test_stability alone, long cases as short as in the suite.

Writes e10_stability.tsv (a row for each check), and stability.md in the folder above.
"""
import json
import os
import pathlib
import re
import subprocess
import sys
import tempfile

from lib import table
from lib.context import RunFailed, Skipped

COLUMNS = ["case", "construction", "expectation", "result", "error", "unit", "limit", "verdict"]
TESTS = {
    "test_stability": "*",
    "test_kernels": "Math.NothingIsContracted:Watertight.*:AxisAligned.*:EdgeCases.*:BadTriangles.AreAsIfAbsent:"
                    "SearchAgreement.OfEqualHits*:IndexRange.*",
    "test_render": "Scenes/Determinism.*:DeviceSlab.*:DeviceFresnel.*:DeviceLights.AConeOf*",
}
INTRODUCTION = """# Numerical cases

Written by `experiments/run e10`; not edited by hand. Each row is a check of a test: 1 to 35 are the numbered
cases, O1 and on are our own. Expected values are formulas or double precision, computed in the test. A row passes if
the error is at most the limit; *known limit* marks what is measured and not promised. All forms: one ray and packets,
array and tree, with the same bits.
"""


def rowsOf(report):
    """The rows in one of gtest's JSON reports, in the order of the tests."""
    tests = [t for suite in report["testsuites"] for t in suite["testsuite"]]
    # gtest escapes each byte of UTF-8 as a character of its own.
    return [json.loads(t[key].encode("latin-1").decode()) for t in tests for key in sorted(t) if key.startswith("row_")]


def run(program, pattern, whole):
    """Rows of one test program; a failing check is a row, a program that dies is an error."""
    with tempfile.TemporaryDirectory() as folder:
        file = pathlib.Path(folder) / "report.json"
        environment = dict(os.environ, WHITTLE_LONG_CASES="1" if whole else "0")
        done = subprocess.run([program, f"--gtest_filter={pattern}", f"--gtest_output=json:{file}"],
                              env=environment, capture_output=True, text=True)
        if not file.exists():
            raise RunFailed(f"{program}: ended with status {done.returncode} and no report")
        return rowsOf(json.loads(file.read_text()))


def order(row):
    letters, number = re.fullmatch(r"(\D*)(\d+)", row["case"]).groups()
    return letters, int(number)


def chosen(whole):
    """All programs; without the long cases the one that is made for them alone."""
    return TESTS if whole else {name: TESTS[name] for name in ("test_stability",)}


def lacking(tests, whole):
    """What is missing, in words, or None."""
    missing = [name for name in chosen(whole) if not (tests / name).exists()]
    return f"there is no {tests / missing[0]}: build the target {missing[0]}" if missing else None


def collect(tests, whole):
    """Their rows."""
    rows = []
    for name, pattern in chosen(whole).items():
        print(f"{name} ...", file=sys.stderr, flush=True)
        rows += run(tests / name, pattern, whole)
    return sorted(rows, key=order)  # stable: checks of a case stay in order


def page(rows):
    cell = lambda text: str(text).replace("|", "\\|").replace("\n", " ")
    lines = [INTRODUCTION]
    failed = sum(r["verdict"] == "FAIL" for r in rows)
    known = sum(r["verdict"] == "known limit" for r in rows)
    lines.append(f"{len(rows)} checks of {len({r['case'] for r in rows})} cases: {failed} failed, "
                 f"{known} known limits.\n")
    lines.append("| case | construction | expectation | result | error | limit | |")
    lines.append("|---|---|---|---|---|---|---|")
    for r in rows:
        lines.append("| " + " | ".join(map(cell, (r["case"], r["construction"], r["expectation"], r["result"],
                                                   f"{r['error']} {r['unit']}", r["limit"], r["verdict"]))) + " |")
    return "\n".join(lines) + "\n"


def measure(context):
    tests = pathlib.Path(context.whittle).parent / "tests"
    if lack := lacking(tests, not context.quick):
        raise Skipped(lack)
    rows = collect(tests, not context.quick)
    out = context.table("e10_stability", COLUMNS)
    for row in rows:
        out.row(**row)


def plot(folder):
    """The page from the table. Cells stay text."""
    rows = [dict(zip(COLUMNS, row)) for row in table.lines(folder, "e10_stability")[1]]
    (folder.parent / "stability.md").write_text(page(rows))

