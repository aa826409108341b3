"""Tables of an experiment: tab-separated, one line of names, numbers as they were measured."""


def write(file, names, rows):
    text = ["\t".join(names)]
    for row in rows:
        text.append("\t".join(f"{v:.6g}" if isinstance(v, float) else str(v) for v in row))
    file.write_text("\n".join(text) + "\n")


def read(file):
    """Rows as dicts; what reads as a number is one."""
    lines = file.read_text().splitlines()
    names = lines[0].split("\t")
    return [dict(zip(names, map(value, line.split("\t")))) for line in lines[1:]]


def value(text):
    for kind in (int, float):
        try:
            return kind(text)
        except ValueError:
            pass
    return text
