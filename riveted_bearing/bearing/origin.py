"""Where values of a bearing come from, in words."""

from typing import Any

SOURCE = "NKE General Catalogue 2018/10"
EXAMPLE = "6207"  # whose values stand where no rule leads to another


def not_given(origin: Any) -> Any:
    """What was not given, by what stands for it: {"by rule": names, ...}; nothing for a shipped file."""
    if "shipped" in origin.values():
        return {}
    sources = {"catalogue": f"from {SOURCE}", "rule": "by rule", EXAMPLE: f"of the {EXAMPLE}"}
    found = {source: [name for name, of in origin.items() if of == key] for key, source in sources.items()}
    return {source: grouped(names) for source, names in found.items() if names}


def grouped(names):
    """Dotted names with each prefix once: Z, bearing (D, d_m), cage (m)."""
    groups = {}
    for name in names:
        prefix, _, last = name.rpartition(".")
        groups.setdefault(prefix, []).append(last)
    return ", ".join(
        f"{prefix} ({', '.join(lasts)})" if prefix else ", ".join(lasts) for prefix, lasts in groups.items()
    )
