"""Scenes that come with the package, to begin with."""

from __future__ import annotations

import re
from importlib import resources
from importlib.resources.abc import Traversable
from pathlib import Path

import loadflow
from loadflow.errors import InputError
from loadflow.numerics.fields import none_such
from loadflow.scene.messages import NAME, NAME_SAYS


def _folder() -> Traversable:
    """Scenes of the installed package, or those of a checkout."""
    inside = resources.files("loadflow").joinpath("data", "scenes")
    return inside if inside.is_dir() else Path(loadflow.__file__).parents[1] / "pipelines"


def templates() -> dict[str, str]:
    """Names of the scenes, with the first sentence of each.

    Examples
    --------
    >>> "quick_look" in templates()
    True
    """
    files = (file for file in _folder().iterdir() if file.name.endswith(".toml"))
    return {
        file.name[:-5]: _first_sentence(file.read_text(encoding="utf-8"))
        for file in sorted(files, key=lambda file: file.name)
    }


def template_text(template: str, name: str) -> str:
    """A scene that comes with the package, under another name.

    Raises
    ------
    InputError
        No such scene, or a name that no run can have.
    """
    known = templates()
    if template not in known:
        raise InputError(none_such("scene", [template], known))
    if not re.fullmatch(NAME, name):
        raise InputError(f"name = {name!r}: {NAME_SAYS}")
    text = _folder().joinpath(f"{template}.toml").read_text(encoding="utf-8")
    return re.sub(r'(?m)^name = ".*"$', f'name = "{name}"', text, count=1)


def _first_sentence(text: str) -> str:
    comment = " ".join(re.match(r"(?:#.*\n)*", text)[0].replace("#", " ").split())  # type: ignore[index]
    return re.split(r"(?<=[.:])\s(?=[A-Z])", comment, maxsplit=1)[0]
