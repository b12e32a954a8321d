"""The quasi-static start, the default step and the integration of the reference."""
