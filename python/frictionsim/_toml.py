"""Python values in TOML."""

from __future__ import annotations

import json
import math
import os
from collections.abc import Mapping, Sequence
from typing import Any

from . import _native


def toml(value: Any) -> str:
    """A value in TOML: numbers, texts, truth values, lists, mappings; NumPy's too."""
    if hasattr(value, "tolist") and not isinstance(value, (str, bytes)):
        value = value.tolist()
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, int):
        return str(value)
    if isinstance(value, float):
        return repr(value) if math.isfinite(value) else str(value)
    if isinstance(value, os.PathLike):
        value = os.fspath(value)
    if isinstance(value, str):
        # DEL is the one character that JSON leaves as it is and TOML does not.
        return json.dumps(value, ensure_ascii=False).replace("\x7f", "\\u007f")
    if isinstance(value, Mapping):
        entries = ", ".join(f"{_quoted(str(key))} = {toml(inner)}" for key, inner in value.items())
        return f"{{ {entries} }}" if entries else "{}"
    if isinstance(value, Sequence) and not isinstance(value, (bytes, bytearray)):
        return "[" + ", ".join(toml(item) for item in value) + "]"
    raise TypeError(f"{value!r} has no form in TOML: a case takes numbers, texts, truth values, lists and mappings")


def _quoted(key: str) -> str:
    is_bare = key != "" and key.isascii() and key.replace("_", "").replace("-", "").isalnum()
    return key if is_bare else toml(key)


def override(key: str, value: Any) -> str:
    """What the command line has behind ``--set``; ``None`` takes the key away, as ``--unset`` does."""
    if value is None:
        return _native.without(key)
    try:
        return f"{key}={toml(value)}"
    except TypeError as error:
        raise TypeError(f"{key}: {error}") from None
