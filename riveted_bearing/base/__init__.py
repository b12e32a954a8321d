"""What every room stands on: errors, units, tables, TOML files, and files that are written whole or not at all.
It imports no other room.
"""
