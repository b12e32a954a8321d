"""Written by fmus/generate.py from fmus/variables.toml."""
