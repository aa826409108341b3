"""Tab-separated tables: written row by row, so that what was measured survives an interruption, and read again."""
import json


class NoData(Exception):
    """A table is missing or was never filled; the text says which."""


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


def content(file):
    if not file.is_file():
        raise NoData(f"there is no {file}")
    return file.read_text()


def lines(folder, name, mayBeEmpty=False):
    """Columns, and the rows as lists of text, of FOLDER/NAME.tsv."""
    file = folder / f"{name}.tsv"
    first, *rows = [line.split("\t") for line in content(file).splitlines()] or [[]]
    if not rows and not mayBeEmpty:
        raise NoData(f"{file} holds no rows")
    return first, rows


def read(folder, name, mayBeEmpty=False, formerly=None):
    """The rows of FOLDER/NAME.tsv as dictionaries, numbers as numbers. formerly: what columns are called now, by the
    names that tables of older runs have for them."""
    columns, rows = lines(folder, name, mayBeEmpty)
    columns = [(formerly or {}).get(c, c) for c in columns]
    return [dict(zip(columns, map(parsed, row))) for row in rows]


def readMachine(folder, name):
    return json.loads(content(folder / f"{name}.machine.json"))
