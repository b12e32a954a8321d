"""Tables of every kind: read as the values that they were made from, or one line that names the file's fault."""

import math
import random
import tomllib
from datetime import datetime, timedelta
from importlib.util import find_spec

import numpy as np
import pytest
from library import ROOT

from bearing_model.generated.variables import UNITS
from riveted_bearing.base.errors import UserError
from riveted_bearing.base.tables import Table, Wanted, read
from riveted_bearing.base.units import BASE, SECONDS, check_alike, conversion, parsed, plain, scales_of, to_si

RPM = math.pi / 30.0
UNITS_OF = {  # SI value of one unit by definition: SI brochure, NIST SP 811
    "s": {"s": 1.0, "ms": 1e-3, "µs": 1e-6, "us": 1e-6, "min": 60.0, "h": 3600.0, "sec": 1.0},
    "N": {"N": 1.0, "kN": 1e3, "mN": 1e-3, "daN": 10.0, "kgf": 9.80665, "lbf": 4.4482216152605, "MN": 1e6},
    "rad/s": {"rad/s": 1.0, "deg/s": math.pi / 180.0, "rev/s": 2.0 * math.pi, "rps": 2.0 * math.pi, "krpm": 1e3 * RPM}
    | dict.fromkeys(("rpm", "rev/min", "r/min", "RPM", "1/min", "min-1", "min^-1", "min⁻¹", "U/min"), RPM),
    "m/s2": {"m/s2": 1.0, "g": 9.80665, "mg": 9.80665e-3, "m/s²": 1.0, "m/s^2": 1.0, "mm/s2": 1e-3, "in/s2": 0.0254},
    "m/s": {"mm/s": 1e-3, "m/s": 1.0, "in/s": 0.0254, "µm/s": 1e-6, "km/h": 1.0 / 3.6},
    "m": {"µm": 1e-6, "μm": 1e-6, "um": 1e-6, "nm": 1e-9, "mm": 1e-3, "mil": 25.4e-6, "in": 25.4e-3, "cm": 1e-2},
    "N.m": {"N.m": 1.0, "Nm": 1.0, "N·mm": 1e-3, "kNm": 1e3, "lbf.in": 0.1129848290276167, "in-lb": 0.1129848290276167},
    "Pa": {"MPa": 1e6, "N/mm²": 1e6, "bar": 1e5, "psi": 6894.757293168361, "GPa": 1e9},
    "m3/s": {"L/min": 1e-3 / 60.0, "l/min": 1e-3 / 60.0, "cm3/s": 1e-6},
    "rad/s2": {"rad/s2": 1.0, "rpm/s": RPM, "deg/s^2": math.pi / 180.0},
    "kg.m": {"g.mm": 1e-6, "g·mm": 1e-6, "kg.m": 1.0},
    "Pa.s": {"mPa.s": 1e-3, "cP": 1e-3, "mPas": 1e-3},
    "m2/s": {"mm2/s": 1e-6, "cSt": 1e-6, "mm²/s": 1e-6},
    "1": {"%": 1e-2, "-": 1.0, "ppm": 1e-6},
}
SEPARATORS = {",": ".", ";": ".,", "\t": ".,", " ": ".,"}  # and the decimal signs that go with each
ENCODINGS = ("utf-8", "utf-8-sig", "utf-16", "utf-16-le", "cp1252")
HEADS = ("{} [{}]", "{} ({})", "{}[{}]", "{} / {}", "{} in {}", "{}, {}")


def scales(base):
    return scales_of(base, UNITS.get(base, {}))


def text_of(value, decimal, digits):
    return (f"{value:.{digits}f}" if digits else f"{value:.12g}").replace(".", decimal)


def made(rng, separator, decimal, encoding):
    """Bytes of a table with heads, the base unit of its second column, and its times and values in SI."""
    base = rng.choice(list(UNITS_OF))
    unit, time_unit = rng.choice(list(UNITS_OF[base])), rng.choice(["s", "ms", "us", "min"])
    if encoding == "cp1252" and unit in ("μm", "min⁻¹"):
        unit = next(iter(UNITS_OF[base]))
    digits = rng.choice([0, 3, 6])
    step, rows = rng.choice([1.0, 0.25, 0.02]), rng.choice([8, 40, 150])
    t = [round(k * step, 6) for k in range(rows)]
    x = [round(rng.uniform(-2.0, 3.0) * 10.0 ** rng.choice([0, 1, 3]), digits or 7) for _ in t]
    if rng.random() < 0.3:  # whole numbers first, as a counter writes them
        x = [float(round(value)) for value in x[:-1]] + [x[-1] + 0.5]
    head = rng.choice(HEADS if separator != "," else [one for one in HEADS if "," not in one])
    if separator == " ":
        head = "{}[{}]"
        unit = unit.replace(" ", "")
    names = [f"t [{time_unit}]" if separator != " " else f"t[{time_unit}]", head.format("x", unit), "note"]
    quote = rng.random() < 0.2 and separator != " "
    lines = [separator.join(f'"{name}"' if quote else name for name in names)]
    for a, b in zip(t, x, strict=True):
        cells = [text_of(a, decimal, 6), text_of(b, decimal, digits), "a"]
        lines.append(separator.join(f'"{cell}"' if quote else cell for cell in cells))
    if rng.random() < 0.3:
        lines[1:1] = ["# a remark"]
    if rng.random() < 0.2 and separator != " ":
        lines = [f"sep={separator}", *lines]
    if rng.random() < 0.2 and separator == ";":
        lines = [f"{line};;" for line in lines if not line.startswith(("#", "sep"))] + [";;;;"]
    si = UNITS_OF["s"][time_unit] * np.array(t), UNITS_OF[base][unit] * np.array(x)
    return lines, base, si


def damaged(rng, lines, separator, decimal):
    """The lines with one fault, and what its message says."""
    first = next(k for k, line in enumerate(lines) if line.lstrip('"').startswith("t")) + 1
    first += lines[first].startswith("#")
    k = rng.randrange(first + 2, first + 7)
    cells = lines[k].split(separator)
    quote = '"' if cells[0].startswith('"') else ""
    kind = rng.choice(
        ["nan", "empty", "word", "short", "long", "back", "twice", "gap", "unit", "number", "inf", "date"]
    )
    faults = {
        "nan": "NaN",
        "empty": "" if separator != " " else "n/a",
        "word": "fault",
        "number": "1_000",
        "inf": "1e999",
    }
    faults["date"] = "2026-01-31" if separator != " " else "12:30:05"
    row = f"row {k + 1}"
    if kind in faults:
        cells[1] = f"{quote}{faults[kind]}{quote}"
        said = [row, '"x']
    elif kind == "short":
        cells, said = cells[:1], [row, "1 entries"]
    elif kind == "long":
        cells, said = [*cells[:2], "7", "8", "9", "9"], [row, "has 6 entries"]
    elif kind in ("back", "twice"):
        cells[0] = lines[k - (2 if kind == "back" else 1)].split(separator)[0]
        said = [row, "must increase"]
    elif kind == "gap":
        for i in range(k, len(lines)):
            late = lines[i].split(separator)
            text = late[0].strip('"')
            if text:
                late[0] = f"{quote}{text_of(float(text.replace(decimal, '.')) + 1000.0, decimal, 6)}{quote}"
                lines[i] = separator.join(late)
        return lines, [row, "a gap of"]
    else:
        lines[first - 1 - lines[first - 1].startswith("#")] = separator.join(
            f"{quote}{name}{quote}" for name in ("t", f"x[{rng.choice(['V', 'furlong', 'kg/K', 'counts'])}]", "note")
        )
        return lines, ['"x', "does not fit"]
    lines[k] = separator.join(cells)
    return lines, said


@pytest.mark.parametrize("separator", SEPARATORS)
def test_tables_are_read_as_they_were_made(separator, tmp_path):
    """300 tables a separator, a third with a fault: 1,200 files."""
    rng, path = random.Random(f"tables {separator}"), tmp_path / "rig.csv"
    for number in range(300):
        decimal, encoding = rng.choice(SEPARATORS[separator]), rng.choice(ENCODINGS)
        lines, base, si = made(rng, separator, decimal, encoding)
        said = []
        if number % 3 == 0:
            lines, said = damaged(rng, lines, separator, decimal)
        text = rng.choice(["\n", "\r\n"]).join(lines) + rng.choice(["", "\n"])
        path.write_bytes(text.encode(encoding))
        try:
            found = Table(path).series(Wanted("t", SECONDS), Wanted("x", scales(base)))
        except UserError as problem:
            message = str(problem)
            assert said and "\n" not in message and message.startswith(str(path)), (message, text[:400])
            assert all(words in message for words in said), (message, said, text[:400])
            continue
        assert not said, (said, text[:600])
        for values, expected in zip(found, si, strict=True):
            np.testing.assert_allclose(values, expected, rtol=1e-13, atol=1e-300, err_msg=text[:400])


@pytest.mark.parametrize("base", UNITS_OF)
def test_units_are_those_of_their_definitions(base):
    for symbol, si in UNITS_OF[base].items():
        factor, offset = conversion(symbol, base)
        assert (1.0 - offset) / factor == pytest.approx(si, rel=1e-14), symbol
    others = (one for one in UNITS_OF if one != base and {one, base} != {"m/s2", "kg"})
    assert not any(conversion(other, base) for other in others)


def test_the_units_of_the_fmu_have_the_exponents_of_its_table():
    with (ROOT / "fmus" / "variables.toml").open("rb") as file:
        table = tomllib.load(file)["units"]
    for name, entry in table.items():
        exponents, value = parsed(plain(name))
        if "dimension" not in entry:
            assert exponents == tuple(entry.get(base, 0) for base in BASE) and value == pytest.approx(1.0), name
        for symbol, factor in entry.get("display", {}).items():
            assert conversion(symbol, name) == pytest.approx(factor if isinstance(factor, list) else (factor, 0.0))


@pytest.mark.parametrize(
    ("text", "base", "expected"),
    [
        ("time,n_rpm\n0,60\n1,120\n", "rad/s", [2 * math.pi, 4 * math.pi]),  # a last word that fits is a unit
        ("time,n (1/min)\n0,60\n1,120\n", "rad/s", [2 * math.pi, 4 * math.pi]),
        ("time;n\ns;rpm\n0;60,5\n1;120\n", "rad/s", [121 * math.pi / 60, 4 * math.pi]),  # a line of units
        ("time;n [N]\n0;1.234,5\n1;2.000,25\n", "N", [1234.5, 2000.25]),
        ('time,n\n0,"1,234.5"\n1,"2,000.25"\n', "N", [1234.5, 2000.25]),
        ("time;n\n0,5;1\u202f234,5\n1;2\u00a0000\n", "N", [1234.5, 2000.0]),
        ("time;n\n0,000;2,990\n1,000;3,000\n", "N", [2.99, 3.0]),
        ("Logger X1\nsn;7\n\ntime;n\n0;1\n1;2\n", "N", [1.0, 2.0]),
        ("time|n\n0|1e3\n1|-.5E-1\n", "N", [1e3, -0.05]),
        ("time [s]  n [kN]\n0  1\n1   2\n", "N", [1e3, 2e3]),
        ("time;n\r0;1\r1;2\r", "N", [1.0, 2.0]),
        ("time,n [degC]\n0,20\n1,-273.15\n", "K", [293.15, 0.0]),
        ("time\tn\n0\t\u22121\n1\t2\n", "N", [-1.0, 2.0]),
    ],
)
def test_ways_of_writing(text, base, expected, tmp_path):
    (tmp_path / "rig.csv").write_bytes(text.encode())
    t, n = read(
        tmp_path / "rig.csv", Wanted("time", SECONDS), Wanted("n_rpm" if "n_rpm" in text else "n", scales(base))
    )
    assert n == pytest.approx(expected, rel=1e-15, abs=1e-13) and t[1] == 1.0


@pytest.mark.parametrize(
    ("data", "said"),
    [
        (b"time,n\n0,5,1,2\n1,5,1,3\n", ["row 2 has 4 entries", "a comma as decimal sign"]),
        (b"time;n\n0;1,5\n1;2.5\n", ["two decimal signs", 'row 2 has "1,5"', 'row 3 has "2.5"']),
        (b"time;n\n0;1,500\n1;2,750\n", ["row 2", '"1,500"', "a thousand"]),
        (b"time,T_C\n0,20\n1,30\n", ['"T_C"', 'is "C" its unit?']),
        (b"0,1\n1,2\n2,3\n", ["row 1", "names"]),
        (b"PK\x03\x04\0\0", ["openpyxl" if find_spec("openpyxl") is None else "not an Excel workbook"]),
        (b"\xd0\xcf\x11\xe0\0\0", ["an old Excel workbook"]),
        (b"time,n\n12:00,1\n12:01,2\n13,3\n", ["row 4", '"13"', "like those above"]),
        (b"time,n\n2024-05-01 12:00,1\n12:01,2\n", ["row 3", "like those above"]),
        (b"time,n\n01/02/2024,1\n02/02/2024,2\n05/06/2024,2\n", ["either order", "2024-05-31"]),
        (b"time,n\n13/02/2024,1\n02/14/2024,2\n", ["change their order"]),
        (b"time,n\n12:00:01,1\n12:00:00,2\n", ["row 3", "must increase"]),
        (b"time,n\n0,12:00:01\n1,12:00:02\n", ["row 2", "a date or time of day"]),
        (b"\xff\xfet\0,\0n\0\n\0\x00", ["UTF-16", "row 2"]),
        (b"\x01\x02\0\0binary", ["no text"]),
        (b"", ["not a CSV table"]),
        (b"time\n0\n", ["not a CSV table"]),
        (b"time,n\n", ["no row of numbers"]),
        (b"time [ms],time [s],n\n0,0,1\n", ["two columns have this name"]),
        (b"time,n [kN]\n0,1\n", ["its unit is kN, but lbf was asked for"]),
        (b"time;n\n[s];[V]\n0;1\n1;2\n", ['"n [V]"', '"V" does not fit']),
        (b'time,n\n0,1\n1,"2\n2,3\n', ["row 4", '"2 2,3"', "not a number"]),
        (b"timeMs,n\n0,1\n1,2\n", ['"timeMs"', 'is "Ms" its unit?']),
        (b"time,n\n1700000000000,1\n1700000000010,2\n", ["row 2", "53,870 years", "[ms]"]),
    ],
)
def test_faults_of_files(data, said, tmp_path):
    (tmp_path / "rig.csv").write_bytes(data)
    kelvin, unit = b"T_C" in data, "lbf" if b"kN" in data else ""
    with pytest.raises(UserError) as refused:
        Table(tmp_path / "rig.csv").series(
            Wanted("timeMs" if b"Ms" in data else "time", SECONDS),
            Wanted("T_C" if kelvin else "n", scales("K" if kelvin else "N"), unit),
        )
    message = str(refused.value)
    assert "\n" not in message and "rig.csv" in message and all(words in message for words in said), message


def test_parquet_is_read_as_csv_is(tmp_path):
    pa, parquet = pytest.importorskip("pyarrow"), pytest.importorskip("pyarrow.parquet")
    path, names = tmp_path / "rig.parquet", ("time [ms]", "n [rpm]")
    parquet.write_table(pa.table({names[0]: list(range(9)), names[1]: pa.array([60] * 8 + [90], pa.int32())}), path)
    t, n = Table(path).series(Wanted("time", SECONDS), Wanted("n", scales("rad/s")))
    assert t[-1] == pytest.approx(8e-3) and n[[0, -1]] == pytest.approx([2 * math.pi, 3 * math.pi])
    parquet.write_table(pa.table({"time": [0, 1], "n": ["1.000,5", "2,25"]}), path)
    assert read(path, Wanted("n", scales("N")))[0].tolist() == [1000.5, 2.25]
    for values, said in (
        ([60.0, None, 1.0], 'row 2, column "n'),
        ([1.0, 2.0, math.nan], "row 3"),
        (list("abc"), "row 1"),
        (["1,250", "2,750", "3,000"], "row 1"),
    ):
        field = pa.field("n", pa.array(values).type, metadata={"unit": "rpm"})
        parquet.write_table(
            pa.table([[0, 1, 2], values], schema=pa.schema([pa.field("time", pa.int64()), field])), path
        )
        with pytest.raises(UserError, match=said):
            read(path, Wanted("time", SECONDS), Wanted("n", scales("rad/s")))


def test_the_first_block_of_a_record_does_not_decide_on_its_numbers(tmp_path):
    (tmp_path / "rig.csv").write_text("time;n\n" + "".join(f"{k};6000\n" for k in range(70000)) + "70000;6000,5\n")
    t, n = Table(tmp_path / "rig.csv").series(Wanted("time", SECONDS), Wanted("n", scales("N")))
    assert n[-1] == 6000.5 and n[0] == 6000.0 and t[-1] == 70000.0


def test_gaps_are_those_of_a_record_and_can_be_allowed(tmp_path):
    path = tmp_path / "rig.csv"

    def read_with(times, **options):
        path.write_text("time,n\n" + "".join(f"{t},1\n" for t in times))
        return Table(path).series(Wanted("time", SECONDS), Wanted("n", scales("N")), **options)

    with pytest.raises(UserError, match=r"row 7: a gap of 200 s, usual is 1 s"):
        read_with([0, 1, 2, 3, 4, 204, 205])
    assert len(read_with([0, 1, 2, 3, 4, 204, 205], gap=200.0)[0]) == 7
    with pytest.raises(UserError, match=r"row 7: a gap of 200 s"):
        read_with([0, 1, 2, 3, 4, 204, 205], gap=100.0)
    assert len(read_with([0, 0.1, 0.11, 5.0, 5.001, 60.0, 61.0])[0]) == 7  # points of no fixed rate


FORMATS = {  # of strftime, as loggers write: whether the date is in it
    "%Y-%m-%dT%H:%M:%S.%fZ": True,
    "%Y-%m-%d %H:%M:%S.%f": True,
    "%Y/%m/%d %H:%M:%S": True,
    "%Y%m%dT%H%M%S": True,
    "%d.%m.%Y %H:%M:%S": True,
    "%d/%m/%Y %H:%M:%S": True,
    "%m/%d/%Y %I:%M:%S %p": True,
    "%d-%b-%Y %H:%M:%S": True,
    "%d.%m.%y %H:%M:%S": True,
    "%H:%M:%S.%f": False,
    "%H:%M:%S": False,
    "%I:%M:%S %p": False,
}


@pytest.mark.parametrize("form", FORMATS)
def test_dates_are_seconds_since_the_first_row(form, tmp_path):
    """Ten records a format, from 20 minutes before midnight of days in all months: what Python's datetime makes of the times."""
    rng = random.Random(f"dates {form}")
    for _ in range(10):
        start = datetime(2024, rng.randint(1, 12), rng.randint(1, 28), 23, 40, rng.randint(0, 59))
        step = rng.choice((1, 10, 60)) if "%f" not in form else rng.choice((0.125, 0.5))
        seconds = step * np.arange(rng.choice((30, 300)))
        separator = rng.choice([";", "\t"] if "," in form else [",", ";", "\t"])
        head = rng.choice(("time", "time [s]", "time (HH:MM:SS)", "time [UTC]"))
        rows = ((start + timedelta(seconds=float(t))).strftime(form) + f"{separator}{k}" for k, t in enumerate(seconds))
        (tmp_path / "rig.csv").write_text("\n".join([f"{head}{separator}n", *rows]))
        t, n = Table(tmp_path / "rig.csv").series(Wanted("time", SECONDS), Wanted("n", scales("N")))
        np.testing.assert_allclose(t, seconds, rtol=0.0, atol=1e-5)
        assert n[-1] == len(seconds) - 1


@pytest.mark.parametrize(
    ("texts", "expected"),
    [
        (["2024-03-31T01:30:00+01:00", "2024-03-31T03:30:00+02:00"], [0.0, 3600.0]),  # the clocks of Europe go on
        (["99:59:59", "100:00:01,5"], [0.0, 2.5]),
        (["00:58.5", "01:01.0"], [0.0, 2.5]),
        (["1 Feb 2024 12:00", "1 Mar 2024 12:00"], [0.0, 29 * 86400.0]),
        (["30/04/2024", "01/05/2024"], [0.0, 86400.0]),  # the order of a later row tells
        (["01/05/2024 23:59:59", "02/05/2024 00:00:00"], [0.0, 1.0]),  # a second, not a month
    ],
)
def test_ways_of_writing_dates(texts, expected, tmp_path):
    (tmp_path / "rig.csv").write_text("time;n\n" + "".join(f"{text};1\n" for text in texts))
    assert read(tmp_path / "rig.csv", Wanted("time", SECONDS))[0].tolist() == expected


def test_long_records_with_dates_are_read_in_pieces(tmp_path):
    """Over two midnights and two pieces: one reference for all of them."""
    count = 140_000
    clock = (f"{k // 3600 % 24:02}:{k // 60 % 60:02}:{k % 60:02};1" for k in range(80_000, 80_000 + count))
    (tmp_path / "rig.csv").write_text("time;n\n" + "\n".join(clock))
    t, _ = Table(tmp_path / "rig.csv").series(Wanted("time", SECONDS), Wanted("n", scales("N")))
    np.testing.assert_array_equal(t, np.arange(count))


def test_dates_in_parquet_and_excel(tmp_path):
    """Dates by their types, as pandas and Excel have them, and as texts."""
    pa, parquet = pytest.importorskip("pyarrow"), pytest.importorskip("pyarrow.parquet")
    start, expected = datetime(2024, 5, 1, 23, 59, 58), np.array([0.0, 0.5, 3.0])
    stamps = [start + timedelta(seconds=float(t)) for t in expected]
    columns = [pa.array(stamps, pa.timestamp(unit)) for unit in ("ms", "us", "ns")]
    columns += [pa.array([f"{stamp:%d.%m.%Y %H:%M:%S.%f}" for stamp in stamps])]
    for column in columns:
        parquet.write_table(pa.table({"time": column, "n [rpm]": [60, 60, 90]}), tmp_path / "rig.parquet")
        t, n = read(tmp_path / "rig.parquet", Wanted("time", SECONDS), Wanted("n", scales("rad/s")))
        assert t == pytest.approx(expected, abs=1e-6) and n[-1] == pytest.approx(3 * math.pi)
    openpyxl = pytest.importorskip("openpyxl")
    book = openpyxl.Workbook()
    book.active.append(["made by the rig"])
    sheet = book.create_sheet("record")
    for row in (["time", "n [rpm]", "note"], *([stamp, speed, None] for stamp, speed in zip(stamps, (60, 60, 90.5)))):
        sheet.append(row)
    book.save(tmp_path / "rig.xlsx")
    t, n = read(tmp_path / "rig.xlsx", Wanted("time", SECONDS), Wanted("n", scales("rad/s")))
    assert t == pytest.approx(expected, abs=1e-3) and n[-1] == pytest.approx(90.5 / 30 * math.pi)
    for row, cells in enumerate(
        (("0,00", "60,5"), ("0,50", "1.060,5"), ("3,00", 90)), 2
    ):  # as a wrong locale leaves them
        sheet[f"A{row}"], sheet[f"B{row}"] = cells
    book.save(tmp_path / "rig.xlsx")
    t, n = read(tmp_path / "rig.xlsx", Wanted("time", SECONDS), Wanted("n", scales("rad/s")))
    assert t == pytest.approx(expected) and n == pytest.approx(np.array([60.5, 1060.5, 90.0]) / 30 * math.pi)
    sheet["B3"] = "fast"
    book.save(tmp_path / "rig.xlsx")
    with pytest.raises(UserError, match='row 3, column "n .rpm.": "fast"'):
        read(tmp_path / "rig.xlsx", Wanted("n", scales("rad/s")))


@pytest.mark.parametrize("base", [base for base in UNITS if base not in ("1", "s")])
def test_a_bare_number_beside_another_unit_is_refused(base):
    """Of every quantity of the FMU: the SI unit and 0 may stand beside bare numbers, as may SI values of the size of the
    text's; numbers that go with the text's own unit may not.
    """
    own = scales(base)
    check_alike([f"1 {base}", 2], own)
    for symbol in own:
        check_alike([f"1 {symbol}", f"2 {base}", 0, 0.0], own)
        check_alike([f"1 {symbol}", 1.1 * to_si(f"1 {symbol}", own)], own)
        if symbol != base:
            with pytest.raises(UserError, match=r"2 has no unit beside"):
                check_alike([f"1 {symbol}", 2], own)
