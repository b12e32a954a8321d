"""Encodings of text files: by mark, by zeros, else as Windows writes it; damaged bytes are named by their row."""

import codecs

from .errors import UserError

MARKS = {
    codecs.BOM_UTF8: "utf-8-sig",
    codecs.BOM_UTF32_LE: "utf-32",
    codecs.BOM_UTF32_BE: "utf-32",
    codecs.BOM_UTF16_LE: "utf-16",
    codecs.BOM_UTF16_BE: "utf-16",
}


def encoding_of(path, start):
    """UTF-8, UTF-16 or UTF-32 by the mark of the byte order or its zeros, else Latin-1 as Windows writes it."""
    marked = next((encoding for mark, encoding in MARKS.items() if start.startswith(mark)), None)
    zeros = [byte == 0 for byte in start[:2]] if len(start) > 3 else []
    if encoding := marked or {(False, True): "utf-16-le", (True, False): "utf-16-be"}.get(tuple(zeros)):
        return checked(path, encoding)
    if b"\0" in start:
        raise UserError(f"{path}: not a CSV table: it holds bytes that are no text")
    for encoding in ("utf-8", "cp1252"):
        try:
            decode(path, encoding)
            return encoding
        except UnicodeDecodeError:
            pass
    return "latin-1"


def checked(path, encoding):
    """An encoding if all of the file has it; UserError naming the row where it ends."""
    try:
        decode(path, encoding)
    except UnicodeDecodeError:
        with path.open(encoding=encoding, errors="replace") as file:
            row = next((number for number, line in enumerate(file, 1) if "\ufffd" in line), 1)
        raise UserError(f"{path}: row {row}: bytes that are no {encoding.upper()} text: the file is damaged") from None
    return encoding


def decode(path, encoding):
    """UnicodeDecodeError unless all of a file is text of an encoding."""
    with path.open(encoding=encoding) as file:
        while file.read(1 << 20):
            pass
