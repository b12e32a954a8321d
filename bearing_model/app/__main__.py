"""python -m bearing_model.app"""

from .cli import app

app(prog_name="riveted-bearing")
