"""docs/validation.md is written by benchmarks/validation_page.py from the newest record of benchmarks/validation.py."""

import sys

from library import ROOT

sys.path.insert(0, str(ROOT / "benchmarks"))

from records import newest_record
from validation_page import PAGE, page


def test_page_is_that_of_the_newest_record():
    assert PAGE.read_text(encoding="utf-8") == page(newest_record("validation"))


def test_page_shows_the_records_numbers():
    """Another number in the record is another number on the page."""
    data = newest_record("validation")
    data["working_point"][0]["core"] = 54.321
    data["heat"]["rows"][0]["total"] = 263.0
    text = page(data)
    assert "| 54.321 |" in text and "| 28,000 | 350 | 263 | 0.75 |" in text
