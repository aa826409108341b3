"""Tab-separated tables: written row by row, so that what was measured survives an interruption, and read again."""
import json


class Table:
    """FOLDER/NAME.tsv with these columns; the machine's record goes beside it."""

    def __init__(self, folder, name, columns, machine):
        folder.mkdir(parents=True, exist_ok=True)
        self.path, self.columns, self.rows = folder / f"{name}.tsv", list(columns), 0
        (folder / f"{name}.machine.json").write_text(json.dumps(machine, indent=1) + "\n")
        self.file = open(self.path, "w")
        self.line(self.columns)

    def line(self, cells):
        self.file.write("\t".join(map(str, cells)) + "\n")
        self.file.flush()

    def row(self, **values):
        """One row; a column that is not named stays empty, and a name that is no column is an error."""
        unknown = set(values) - set(self.columns)
        if unknown:
            raise KeyError(f"{self.path.name} has no column {sorted(unknown)[0]}")
        self.line([shown(values.get(c, "")) for c in self.columns])
        self.rows += 1


def shown(value):
    return f"{value:.6g}" if isinstance(value, float) else value


def parsed(cell):
    for kind in (int, float):
        try:
            return kind(cell)
        except ValueError:
            pass
    return cell


def read(folder, name):
    """The rows of FOLDER/NAME.tsv as dictionaries, numbers as numbers."""
    lines = (folder / f"{name}.tsv").read_text().splitlines()
    columns = lines[0].split("\t")
    return [dict(zip(columns, map(parsed, line.split("\t")))) for line in lines[1:]]


def readMachine(folder, name):
    return json.loads((folder / f"{name}.machine.json").read_text())
