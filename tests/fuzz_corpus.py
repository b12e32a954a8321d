"""Strings that fuzzing starts from, kept in the tree as text: one string a line, in hexadecimal digits, in
tests/corpus/.

    python tests/fuzz_corpus.py unpack tests/corpus/fuzz_api.txt build/corpus        a file for each line
    python tests/fuzz_corpus.py pack build/corpus tests/corpus/fuzz_api.txt [BYTES]  adds the shortest strings that are not there, up to BYTES of text (100000)

`make fuzz` does the first.  After a run that reached more, `fuzz_api -merge=1 SMALL build/corpus` keeps in the folder
SMALL what each of its strings adds, and the second brings SMALL into the tree.
"""

import hashlib
import sys
from pathlib import Path

CORPUS = Path(__file__).with_name("corpus")


def read(path):
    """The strings of a file of the tree; a line that starts with # is a comment."""
    return [bytes.fromhex(line) for line in path.read_text().splitlines() if line and not line.startswith("#")]


def unpack(path, folder):
    """Write each string to a file that is named by its digest, as libFuzzer names its own."""
    folder.mkdir(parents=True, exist_ok=True)
    for string in read(path):
        (folder / hashlib.sha1(string).hexdigest()).write_bytes(string)


def add(strings, path, most=100_000):
    """Add the shortest of the strings that the file does not have, as long as its text stays below `most` bytes."""
    text = path.read_text()
    for string in sorted(set(strings) - set(read(path)) - {b""}, key=lambda string: (len(string), string)):
        if len(text) + 2 * len(string) + 1 > most:
            break
        text += f"{string.hex()}\n"
    path.write_text(text)


def pack(folder, path, most=100_000):
    """Add the strings of a folder's files."""
    add([file.read_bytes() for file in folder.iterdir()], path, most)


def main():
    act, source, target, *most = sys.argv[1:]
    {"unpack": unpack, "pack": pack}[act](Path(source), Path(target), *map(int, most))


if __name__ == "__main__":
    main()
