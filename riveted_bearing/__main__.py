"""python -m riveted_bearing: the same as the program riveted-bearing."""

from .cli import program

program(prog_name="riveted-bearing")
