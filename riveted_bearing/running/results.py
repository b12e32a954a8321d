"""Results of a run, in memory and as Parquet, CSV or MAT files that carry all parameters, units and their origin
inside.

Parquet: one column per channel; the schema's metadata holds the key "riveted_bearing" (JSON), each field its unit.
CSV:     a header of TOML behind "# ", then a line of names and the numbers.
MAT:     a struct `result` nested like the names, ball[3].Q_i in column 3 of result.ball.Q_i; result.metadata is the same JSON.
All hold a digest of what was written, by which a damaged file is known.
"""

import hashlib
import json
import math
import re
import tomllib
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np

from bearing_model.physics.parameters import TYPES

from ..base.errors import UserError, library
from ..base.files import KEY, format_of, one_line, read_table, write_atomically, write_table
from ..base.toml_files import to_toml
from ..base.variable_list import variable_of

FORMAT_VERSION = 1


@dataclass(frozen=True)
class Result:
    """data by channel ("time" [s] first), units, all parameters (SI value or item name), summary (statistics, solver counters,
    run times) and about (scene, FMU, versions, reason of an early stop).
    """

    data: dict
    units: dict
    parameters: dict
    summary: dict = field(default_factory=dict)
    about: dict = field(default_factory=dict)

    def __repr__(self):
        times = self.data.get("time", ())
        span = f"{len(self.data)} channels at {len(times)} times to {times[-1]:g} s" if len(times) else "no data"
        return f"<Result of scene {self.about.get('scene', '?')}: {span}{', stopped early' if self.stopped else ''}>"

    @property
    def stopped(self):
        """Reason of an early stop, "" if the run reached its end."""
        return self.about.get("stopped", "")

    def metadata(self):
        """All members but the data over time, ready for JSON."""
        return {
            "format": FORMAT_VERSION,
            "about": self.about,
            "parameters": self.parameters,
            "summary": self.summary,
            "units": self.units,
        }

    def to_pandas(self):
        """A pandas.DataFrame over time [s], its attrs the metadata; needs pandas (the extra "full")."""
        pandas = library("pandas", "to_pandas")
        frame = pandas.DataFrame(
            {name: values for name, values in self.data.items() if name != "time"},
            index=pandas.Index(self.data["time"], name="time"),
        )
        frame.attrs = self.metadata()
        return frame

    def to_xarray(self):
        """An xarray.Dataset: ball[j].Q_i are one array ball.Q_i over (time, ball), units in attrs; needs xarray."""
        xarray = library("xarray", "to_xarray")
        variables = {}
        for place, names in group_by_place(self.data).items():
            numbers = [re.findall(r"\[(\d+)\]", name) for name in names]
            attrs = {"units": self.units.get(names[0], "1")}
            if all(len(found) == 1 for found in numbers):
                kind = "ball" if place[0] == "ball" else "rivet"
                values = xarray.DataArray(
                    np.column_stack([self.data[name] for name in names]),
                    dims=("time", kind),
                    coords={kind: [int(found[0]) for found in numbers]},
                    attrs=attrs,
                )
            else:
                values = ("time", self.data[names[0]], attrs)
            variables[".".join(place)] = values
        about = {name: json.dumps(getattr(self, name)) for name in ("about", "parameters", "summary")}
        return xarray.Dataset(variables, attrs=about | {"title": self.about.get("scene", "")})


def write_result(result: Result, path: str | Path) -> Path:
    """Write a result whole or not at all; the suffix of `path` (.parquet, .csv, .mat) is the format."""
    path = Path(path)
    write, metadata = WRITERS[format_of(path)], result.metadata() | {"digest": digest_of(result)}
    write_atomically(path, lambda temporary: write(result, metadata, temporary))
    return path


def read_result(path: str | Path) -> Result:
    """The Result stored in a file; UserError if it is missing, damaged or something else."""
    path = Path(path)
    if not path.is_file():
        raise UserError(f"{path}: no such file")
    try:
        data, metadata = READERS[format_of(path)](path)
        result = Result(data, *(metadata[name] for name in ("units", "parameters", "summary", "about")))
        check_result(result, path)
        if metadata.get("digest", "") not in ("", digest_of(result)):
            raise UserError(f"{path}: damaged or changed: its digest is not that of what was written")
        return result
    except UserError:
        raise
    except Exception as problem:  # each library has its own errors for a damaged file
        raise UserError(f"{path}: not a result of riveted-bearing, or damaged: {one_line(repr(problem))}") from None


def digest_of(result):
    """SHA-256 of all that is stored; any two values that are no numbers count as equal."""
    digest = hashlib.sha256(json.dumps(result.metadata(), sort_keys=True).encode())
    for name, values in result.data.items():
        digest.update(name.encode() + np.where(np.isnan(values), np.nan, values).astype("<f8").tobytes())
    return digest.hexdigest()


def check_result(result, path):
    """Refuse values that no run writes, by name: what a reader of results may rely on.  UserError for the first one."""
    for part in ("data", "units", "parameters", "summary", "about"):
        if not isinstance(getattr(result, part), dict):
            raise UserError(f"{path}: {part}: not a table")
    times = result.data.get("time")
    if times is None or times.ndim != 1 or not len(times) or not np.all(np.isfinite(times)):
        raise UserError(f"{path}: time: not a column of finite numbers")
    for name, values in result.data.items():
        if values.shape != times.shape or values.dtype.kind != "f":
            raise UserError(f"{path}: {name}: not a column of as many numbers as there are times")
        if not isinstance(result.units.get(name), str):
            raise UserError(f"{path}: {name}: no unit")
    for name, value in result.parameters.items():
        if problem := parameter_problem(name, value):
            raise UserError(f"{path}: {name} = {value!r}: {problem}")
    for name, value in result.summary.items():
        if not is_number(value):
            raise UserError(f"{path}: {name} = {value!r}: not a number")
    for name, value in result.about.items():
        for names, holds, words in ORIGINS:
            if name in names.split() and not holds(value):
                raise UserError(f"{path}: {name} = {value!r}: {words}")


def is_number(value):
    return isinstance(value, int | float) and not isinstance(value, bool)


def is_text(value):
    return isinstance(value, str)


def is_list(value, kind):
    return isinstance(value, list) and all(map(kind, value))


def is_table(value, kind):
    return isinstance(value, dict) and all(map(kind, value.values()))


ORIGINS = (  # facts about the origin of a result: their names, test, and what is wrong with one that fails it
    ("scene description fmu guid model generated machine date stopped", is_text, "not a text"),
    ("given ruled messages replaced", lambda value: is_list(value, is_text), "not a list of texts"),
    (
        "mode_frequencies",
        lambda value: is_list(value, lambda one: is_number(one) and 0.0 < one < math.inf),
        "not a list of positive numbers",
    ),
    ("versions not_given basis units", lambda value: is_table(value, is_text), "not a table of texts"),
    ("rivet", lambda value: is_table(value, is_number), "not a table of numbers"),
    ("t_end step settle_turns count_turns", is_number, "not a number"),
)


def parameter_problem(name, value):
    """What is wrong with the value of a parameter in a result, nothing if it may stand there."""
    known = variable_of(name)
    if known is not None and known.type in TYPES:
        items = [item.name.lower() for item in TYPES[known.type]]
        return "" if value in items else f"allowed: {', '.join(items)}"
    if known is None and isinstance(value, str):  # an enumeration of another version
        return ""
    return "" if is_number(value) else "not a number"


def write_parquet(result, metadata, path):
    """Columns with units, metadata in the schema."""
    import pyarrow as pa

    fields = [pa.field(name, pa.float64(), metadata={"unit": result.units[name]}) for name in result.data]
    schema = pa.schema(fields, metadata={KEY: json.dumps(metadata)})
    write_table(pa.table(list(result.data.values()), schema=schema), path)


def read_parquet(path):
    """Data and metadata of write_parquet."""
    table = read_table(path)
    metadata = json.loads(table.schema.metadata[KEY.encode()])
    return {name: table[name].to_numpy() for name in table.column_names}, metadata


def write_csv(result, metadata, path):
    """TOML behind "# ", names, numbers with all their digits."""
    with path.open("w", encoding="utf-8") as file:
        file.writelines(f"# {line}\n" for line in to_toml(metadata))
        file.write(",".join(result.data) + "\n")
        np.savetxt(file, np.column_stack(list(result.data.values())), fmt="%.17g", delimiter=",")


def read_csv(path):
    """Data and metadata of write_csv."""
    with path.open(encoding="utf-8") as file:
        header = []
        for line in file:
            if not line.startswith("#"):
                break
            header.append(line[2:])
        names = line.rstrip("\n").split(",")
        numbers = file.readlines()
    columns = np.loadtxt(numbers, delimiter=",", ndmin=2) if numbers else np.empty((0, 0))
    return dict(zip(names, columns.T, strict=True)), tomllib.loads("".join(header))


def write_mat(result, metadata, path):
    """Nested structs; the elements of ball[...] and rivet[...] as columns."""
    from scipy.io import savemat

    tree = {"metadata": json.dumps(metadata), "names": np.array(list(result.data), dtype=object)}
    for place, columns in group_by_place(result.data).items():
        *branches, leaf = place
        node = tree
        for branch in branches:
            node = node.setdefault(branch, {})
        node[leaf] = np.column_stack([result.data[name] for name in columns])
    savemat(path, {"result": tree}, do_compression=True, long_field_names=True)


def read_mat(path):
    """Data and metadata of write_mat."""
    from scipy.io import loadmat

    tree = loadmat(path, simplify_cells=False, struct_as_record=True, squeeze_me=False)["result"][0, 0]
    names = [str(np.squeeze(name)) for name in tree["names"].ravel()]
    data = dict.fromkeys(names)
    for place, columns in group_by_place(names).items():
        node = tree
        for branch in place[:-1]:
            node = node[branch][0, 0]
        data |= dict(zip(columns, node[place[-1]].T, strict=True))
    return data, json.loads(str(np.squeeze(tree["metadata"])))


def group_by_place(names):
    """Names grouped by their path without indices: ("ball", "Q_i") -> ["ball[1].Q_i", "ball[2].Q_i", ...]."""
    places = {}
    for name in names:
        places.setdefault(tuple(re.sub(r"\[\d+\]", "", name).split(".")), []).append(name)
    return places


WRITERS = {"parquet": write_parquet, "csv": write_csv, "mat": write_mat}
READERS = {"parquet": read_parquet, "csv": read_csv, "mat": read_mat}
