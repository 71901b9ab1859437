"""The differences between two records of `.ci/record`."""
import csv
import gzip
import io
import itertools
import json
import re
from pathlib import Path

NUMBER = re.compile(r"-?\d+(?:\.\d+)?(?:e[+-]?\d+)?")
# What a text says about times and costs.
COST = re.compile(r"\d+ (?:evaluations?|steps?|rejected)|(?:^|,|  |in) ?[\d.e+-]+ (?:ns|us|ms|s)(?=  |$)", re.M)
# The revision of the program.
REVISION = re.compile(r'(?<=\()[0-9a-f]{12}[^)]*(?=\):)|(?<="revision":")[^"]*')
# Columns that depend on times, or count costs.
COUNTED = re.compile(r"seconds|evaluations|steps|rejected|\.front$")
ERRORS = re.compile(r"error|residual|difference")
# Differences shown for each command, and places for each of them.
SHOWN = 8


def number(cell):
    """A cell as a number if it is one."""
    return float(cell) if NUMBER.fullmatch(cell) else cell


def values(at, value, error=0.0):
    """The numbers and words of an answer with their places, and the error that stands beside each."""
    if isinstance(value, dict):
        error = abs(value["error"]) if isinstance(value.get("error"), float) else error
        for key, part in value.items():
            yield from values(f"{at}.{key}", part, error)
    elif isinstance(value, list):
        for index, part in enumerate(value):
            yield from values(f"{at}[{index}]", part, error)
    elif not COUNTED.search(at):
        yield at, (value, error)


def documents(text):
    """The documents of an answer in JSON: a scan has one in each line."""
    decoder, at = json.JSONDecoder(), 0
    while at < len(text):
        found, end = decoder.raw_decode(text, at)
        yield found
        at = len(text) - len(text[end:].lstrip())


def parsed(line, text):
    """The values of an answer in JSON or CSV by their places; nothing of a text."""
    if "--format=json" in line and text:
        found = list(documents(text))
        return dict(values("", found[0] if len(found) == 1 else found))
    if "--format=csv" in line:
        rows = [[number(cell) for cell in row] for row in csv.reader(io.StringIO(text))]
        named = [dict(zip(rows[0], row)) if len(row) == len(rows[0]) else row for row in rows[1:]]
        return dict(values("", rows[:1] + named))
    return {}


def close(at, old, new):
    """Whether the values at a place are equal."""
    (old, error), (new, _) = old, new
    if not all(type(value) in (int, float) for value in (old, new)):
        return old == new
    if ERRORS.search(at.rsplit(".", 1)[-1]):
        return abs(new) <= max(10 * abs(old), 1e-12)
    # The error of a logarithm is that of its number relative to its size.
    size = 1.0 if "log_" in at else max(abs(old), abs(new))
    return abs(old - new) <= max(1e-12, error) * size


def alike(old, new):
    """Whether two lines have the same words, and numbers within the last digit shown."""
    if old == new or NUMBER.sub("0", old) != NUMBER.sub("0", new):
        return old == new
    pairs = [pair for pair in zip(NUMBER.findall(old), NUMBER.findall(new)) if pair[0] != pair[1]]
    if not all("." in number for pair in pairs for number in pair):
        return False
    # 1.25e-3 has a last digit of 1e-5.
    digit = lambda number: 10.0 ** (int((number + "e0").split("e")[1]) - len(number.split("e")[0].split(".")[1]))
    return all(abs(float(one) - float(other)) <= 1.01 * max(digit(one), digit(other)) for one, other in pairs)


def differences(old, new):
    """The places where two answers differ, with both sides."""
    for part in sorted(old.keys() | new.keys()):
        one, other = (REVISION.sub("", str(told.get(part, ""))) for told in (old, new))
        found = [parsed(old["line"], text) for text in (one, other)] if part == "out" and one != other else [{}, {}]
        if all(found):
            for at in [*found[0], *(found[1].keys() - found[0].keys())]:
                before, after = (side.get(at, ("nothing", 0.0)) for side in found)
                if not close(at, before, after):
                    yield at, before[0], after[0]
        elif one != other:
            rows = itertools.zip_longest(*(COST.sub("", text).splitlines() for text in (one, other)), fillvalue="")
            yield from ((part, *row) for row in rows if not alike(*row))


def cost(text):
    """The evaluations and steps that an answer in JSON counts."""
    return sum(map(int, re.findall(r'"(?:evaluations|steps)":(\d+)', text)))


def compare(old, new):
    """Prints the differences by command, and says whether there are any."""
    differ = False
    for name in sorted({file.name for folder in (old, new) for file in Path(folder).glob("*.gz")}):
        sides = []
        for file in (Path(old) / name, Path(new) / name):
            told = gzip.open(file, "rt", encoding="utf-8").read().split("\n") if file.exists() else []
            sides.append({answer["line"]: answer for answer in map(json.loads, told)})
        both = [line for line in sides[0] if line in sides[1]]
        found = {line: places for line in both if (places := list(differences(sides[0][line], sides[1][line])))}
        costs = [sum(cost(side[line]["out"]) for line in both) for side in sides]
        alone = [len(side) - len(both) for side in sides]
        differ |= bool(found) or any(alone)
        print(f"{name[:-3]}: {len(both)} answers, {len(found)} differ, {alone[0]} only old, {alone[1]} only new;", end=" ")
        print(f"evaluations and steps {costs[0]} -> {costs[1]}")
        for line, places in list(found.items())[:SHOWN]:
            print(f"    {line}: {len(places)}")
            for at, before, after in places[:SHOWN]:
                print(f"        {at}: {before} -> {after}")
    return differ
