"""The pages' English and length: words, sentences, lines.

Words are those of `wc -w`.  Sentences are those of the running text and of list items: code blocks, tables, headings
and pictures are left out, and a piece of inline code or a formula counts as one word.  fmus/generate.py writes
parameters.md, `riveted-bearing schema` files.md.
"""

import re
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[1]
DOCS = ROOT / "docs"
NOTES = sorted((DOCS / "notes").glob("*.md"))
PAGES = [ROOT / "README.md", *sorted(DOCS.glob("*.md")), *NOTES]
GENERATED = ("docs/files.md", "docs/parameters.md")  # as long as their tables

LIMITS = {  # words of a page
    "README.md": 800,
    "docs/api.md": 50,
    "docs/browser.md": 200,
    "docs/cages.md": 1250,
    "docs/cookbook.md": 480,
    "docs/coupling.md": 2500,
    "docs/developing.md": 1250,
    "docs/failure.md": 750,
    "docs/guide.md": 1450,
    "docs/identify.md": 850,
    "docs/life.md": 1700,
    "docs/method.md": 3000,
    "docs/own_bearing.md": 1600,
    "docs/paper.md": 300,
    "docs/performance.md": 1400,
    "docs/physics.md": 1375,
    "docs/real_time.md": 950,
    "docs/releasing.md": 300,
    "docs/rivet.md": 1550,
    "docs/running.md": 1620,
    "docs/stability.md": 650,
    "docs/surfaces.md": 1325,
    "docs/validation.md": 2050,
}
USE = (  # pages that begin with a picture of what one gets
    *("README.md", "docs/guide.md", "docs/browser.md", "docs/cookbook.md", "docs/own_bearing.md", "docs/cages.md"),
    *("docs/life.md", "docs/running.md", "docs/coupling.md", "docs/real_time.md", "docs/surfaces.md"),
    *("docs/identify.md", "docs/failure.md"),
)
NOTE, ALL_PAGES, MOST_PAGES, PICTURE = 400, 26_000, 26, 150_000  # words, words beside the notes, pages, bytes
SENTENCE, LINE, LONG_LINES = 35, 160, 0.01

ABBREVIATIONS = "Fig Figs Eq Eqs eq eqs Ref Refs Sec Tab Nos Vol vol p pp e.g i.e cf vs al approx resp Dr".split()
END = re.compile(r"(?<=[.!?])[\"'”’)\]*_]*\s+(?=[\"'“‘(\[*_]*[A-Z0-9])")


def name_of(page):
    return page.relative_to(ROOT).as_posix()


def paragraphs(text):
    """Running text and list items, each as one line without markup."""
    text = re.sub(r"<!--.*?-->", "", text, flags=re.S)
    text = re.sub(r"^([ \t]*)(```|~~~).*?^\1\2[ \t]*$", "\n", text, flags=re.S | re.M)
    text = re.sub(r"\$\$.*?\$\$", " Formula ", text, flags=re.S)
    found, block = [], []

    def end():
        if block:
            found.append(plain(" ".join(block)))
        block.clear()

    in_list = in_code = False
    after_blank = True
    for line in text.splitlines():
        bare = line.strip()
        indented = line.startswith("    ") and not re.match(r"\s*([-*+]|\d+[.)])\s", line)
        in_code = indented and (in_code or (after_blank and not in_list))
        if not bare:
            end()
        elif in_code or bare.startswith(("|", "#", ":::", "![", "<")) or re.fullmatch(r"[-*_= ]{3,}", bare):
            end()
            in_list = in_list and not bare.startswith("#")
        else:
            if item := re.match(r"([-*+]|\d+[.)])\s+", bare):
                end()
                in_list, bare = True, bare[item.end() :]
            elif after_blank and not line.startswith(" "):
                in_list = False
            block.append(bare.removeprefix("> "))
        after_blank = not bare
    end()
    return found


def plain(text):
    """Without links' addresses, inline code and formulas."""
    text = re.sub(r"``.+?``|`[^`]+`", "Code", text)
    text = re.sub(r"\$[^$]+\$", "Formula", text)
    text = re.sub(r"!\[[^]]*\]\([^)]*\)", "", text)
    text = re.sub(r"\[([^]]*)\]\([^)]*\)", lambda link: link[1][:1].upper() + link[1][1:], text)  # may begin a sentence
    return re.sub(r"\s+", " ", text.replace("**", "")).strip()


def sentences(text):
    """The sentences of a page, in their order."""
    found = []
    for paragraph in paragraphs(text):
        begun = ""
        for part in END.split(paragraph):
            begun = f"{begun} {part}".strip()
            if not re.search(rf"(?:^|[\s(])(?:{'|'.join(map(re.escape, ABBREVIATIONS))})\.$", begun):
                found.append(begun)
                begun = ""
        found += [begun] if begun else []
    return found


def words(sentence):
    return [word for word in sentence.split() if re.search(r"\w", word)]


def english(page):
    return name_of(page) not in GENERATED


def each(pages):
    return pytest.mark.parametrize("page", pages, ids=name_of)


# ---------------------------------------------------------------------------------------------- the reader of sentences


def test_sentences_are_found():
    text = """# A heading that is no sentence. It is not.

One sentence with `code that. Has words` and $a. B$ in it.  Another one, of Fig. 3 and 0.4 s, e.g. This one.
It runs over
lines (and ends). `code` begins the third! Is this the fourth?

    an indented. Block of code

| a table | is. Left out |
|---|---|

- An item of 3 N with [links](page.md#part) and a line
  that goes on. [page.md](page.md) is the second
- **Bold.** Another

```sh
a block. Of code
```
![A picture. Left out](picture.png)
"""
    assert sentences(text) == [
        "One sentence with Code and Formula in it.",
        "Another one, of Fig. 3 and 0.4 s, e.g. This one.",
        "It runs over lines (and ends).",
        "Code begins the third!",
        "Is this the fourth?",
        "An item of 3 N with Links and a line that goes on.",
        "Page.md is the second",
        "Bold.",
        "Another",
    ]
    assert len(words("a – b = 3, Code")) == 4


# ------------------------------------------------------------------------------------------------------------ the pages


def test_every_page_has_a_limit():
    pages = {name_of(page) for page in PAGES if page not in NOTES} - set(GENERATED)
    assert pages == {*LIMITS} and len({*pages, *GENERATED}) <= MOST_PAGES


@each([page for page in PAGES if name_of(page) not in GENERATED])
def test_words(page):
    limit = NOTE if page in NOTES else LIMITS[name_of(page)]
    found = len(page.read_text(encoding="utf-8").split())
    assert found <= limit, f"{name_of(page)}: {found} words, at most {limit}"


def test_words_of_all_pages():
    total = sum(len((ROOT / name).read_text(encoding="utf-8").split()) for name in LIMITS)
    assert total <= ALL_PAGES, f"{total} words, at most {ALL_PAGES}"


@pytest.mark.parametrize("name", USE)
def test_a_page_of_use_begins_with_its_picture(name):
    text = (ROOT / name).read_text(encoding="utf-8")
    assert re.match(r"# .*\n\n!\[[^]]{10,}\]\([\w/]+\.(png|svg)\)\n", text), name


def test_pictures_are_small_described_and_used():
    used = set()
    for page in PAGES:
        for words_of_it, path in re.findall(r"!\[([^]]*)\]\(([^)]+)\)", page.read_text(encoding="utf-8")):
            assert len(words_of_it.split()) >= 3, f"{name_of(page)}: {path} without words for those who do not see it"
            used.add((page.parent / path).resolve())
    there = {path for kind in ("png", "svg") for path in DOCS.rglob(f"*.{kind}")}
    assert there == used, f"not there or on no page: {sorted(map(str, there ^ used))}"
    large = [path.name for path in used if path.stat().st_size > PICTURE]
    assert not large, f"more than {PICTURE} bytes: {large}"


@each([page for page in PAGES if english(page)])
def test_sentences_are_short(page):
    found = sentences(page.read_text(encoding="utf-8"))
    long = [f"{len(words(text))} words: {text}" for text in found if len(words(text)) > SENTENCE]
    assert not long, f"{name_of(page)}: {len(long)} sentences over {SENTENCE} words\n" + "\n".join(long)


@each([page for page in PAGES if english(page)])
def test_what_is_no_noun(page):
    """The word begins a question that has its question mark, and nothing else: "what is left" is "the rest"."""
    found = []
    for text in sentences(page.read_text(encoding="utf-8")):
        rest = re.sub(r"^\W*what\b", "", text, flags=re.I) if text.rstrip("\"'”’)*_").endswith("?") else text
        if re.search(r"\bwhat\b", rest, re.I):
            found.append(text)
    assert not found, f'{name_of(page)}: {len(found)} times "what" as a noun\n' + "\n".join(found)


@each([page for page in PAGES if english(page)])
def test_lines_are_short(page):
    """Without the addresses of links.  1 % of a page's lines may be longer, and one line of a short page."""
    lines = [re.sub(r"\]\([^)]*\)", "]", line) for line in page.read_text(encoding="utf-8").splitlines()]
    long = [f"line {k}, {len(line)} characters: {line[:100]} …" for k, line in enumerate(lines, 1) if len(line) > LINE]
    told = f"{name_of(page)}: {len(long)} lines over {LINE} characters\n" + "\n".join(long)
    assert len(long) <= max(1, LONG_LINES * len(lines)), told
