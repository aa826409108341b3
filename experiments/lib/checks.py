"""The scripts of checks/: each asks whether something holds, or how far, and prints a table. They run in processes of
their own; the table goes to OUT/checks/NAME.tsv with the machine's record beside it.
"""
import dataclasses
import json
import os
import pathlib
import subprocess
import sys

from lib.context import SCENES, RunFailed, Skipped

FOLDER = pathlib.Path(__file__).resolve().parent.parent / "checks"


@dataclasses.dataclass(frozen=True)
class Check:
    question: str
    script: str
    table: str           # its file
    quick: tuple         # arguments of a quick run; a full one has none
    needs: tuple = ()    # programs of the build folder, besides whittle


SMALL = ("--width", "96", "--height", "54")
CHECKS = {
    "same_bits": Check("Is a picture the same bit for bit with everything compiled in?",
                       "same_bits.py", "same_bits.tsv", (str(SCENES / "mirror.glb"), str(SCENES / "shadow.glb"))),
    "contact_sheets": Check("Does any scene come out black, burnt out or empty?",
                            "contact_sheets.py", "contact_sheets.tsv",
                            ("--shapes", "16:9", str(SCENES / "mirror.glb"), str(SCENES / "shadow.glb"))),
    "tried": Check("Are the small files that showed faults right?", "tried.py", "tried.tsv", ()),
    "agreement": Check("How far are the kernels from the double-precision reference?",
                       "agreement.py", "agreement.tsv", (*SMALL, str(SCENES / "cornell_box.glb"))),
    "limits": Check("Where does a picture go wrong as it grows, moves away or gets brighter?",
                    "limits.py", "limits.tsv", ("--sweep", "distance")),
    "leaks": Check("Does a ray find a way out of a closed mesh?",
                   "leaks.sh", "leaks.tsv", ("1e5",), ("tests/test_kernels",)),
    "cutoff": Check("What does a cut-off save, and what does it cost?",
                    "cutoff.py", "cutoff.tsv",
                    (str(SCENES / "nested_glass.glb"), "--bounces", "8", "--runs", "1", *SMALL)),
    "window": Check("What does the window cost, and how soon does it answer?",
                    "window.py", "window.tsv", ("--pairs", "1", "--rays", "4", str(SCENES / "cornell_box.glb"))),
    "searches": Check("How fast are the searches, beside Embree's?",
                      "searches.sh", "searches.txt", ("--quick",), ("make_scenes",)),
    "visits": Check("How many nodes and triangles does a ray visit, beside Embree's tree?",
                    "visits.sh", "visits.tsv", ("--quick",), ("make_scenes", "visits")),
    "build_quality": Check("What does the fast build of the tree cost the rays?",
                           "build_quality.sh", "build_quality.tsv", ("--quick",), ("make_scenes", "build_quality")),
}


def targets(name):
    """What the build has to make for it."""
    return [pathlib.PurePath(program).name for program in CHECKS[name].needs]


def command(check, whittle, arguments):
    if check.script.endswith(".sh"):
        return ["sh", str(FOLDER / check.script), *arguments]
    return [sys.executable, str(FOLDER / check.script), "--whittle", str(whittle), *arguments]


def run(name, context, arguments):
    """With arguments of one's own, which may be about anything, the table goes to standard output."""
    check, build = CHECKS[name], context.whittle.parent
    for program in check.needs:
        if not (build / program).exists():
            raise Skipped(f"there is no {build / program}: build the target {pathlib.PurePath(program).name}")
    environment = dict(os.environ, BUILD=str(build))
    if arguments:
        status, said = finished(command(check, context.whittle, arguments), environment, None)
    else:
        status, said = intoTable(check, context, environment)
    if status != 0:
        raise (Skipped if said.startswith("ModuleNotFoundError") else RunFailed)(said or f"ended with status {status}")


def intoTable(check, context, environment):
    """A run that prints nothing leaves the table that is there."""
    folder = context.out / "checks"
    folder.mkdir(parents=True, exist_ok=True)
    part = folder / f"{check.table}.part"
    with open(part, "w") as out:
        arguments = check.quick if context.quick else ()
        status, said = finished(command(check, context.whittle, arguments), environment, out)
    if part.stat().st_size == 0:
        part.unlink()
        return status, said
    part.rename(folder / check.table)
    record = folder / f"{pathlib.PurePath(check.table).stem}.machine.json"
    record.write_text(json.dumps(context.record, indent=1) + "\n")
    return status, said


def finished(line, environment, out):
    """Exit status, and the last line of standard error; all of it is passed on as it comes."""
    last = ""
    with subprocess.Popen(line, env=environment, stdout=out, stderr=subprocess.PIPE, text=True) as running:
        for text in running.stderr:
            sys.stderr.write(text)
            last = text.strip() or last
    return running.returncode, last
