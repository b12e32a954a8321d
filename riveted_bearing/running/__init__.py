"""One run: the FMU, the scene that says what to simulate, the march through it, its results and their main figures.
It imports base and bearing.
"""
