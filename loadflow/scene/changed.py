"""A scene with something in it changed, checked as a scene that is read."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from pydantic import ValidationError

from loadflow.errors import InputError
from loadflow.scene.loads import Loads
from loadflow.scene.messages import message
from loadflow.scene.scene import Scene, make_scene


def with_loads(scene: Scene, files: list[str], **reading: Any) -> Scene:
    """Return the scene with its load series read from `files` (names or glob patterns).

    Parameters
    ----------
    scene : Scene
        The scene.
    files : list of str
        Names or glob patterns.
    **reading
        Keys of `Loads` that say how files are read; None leaves the scene's.

    Returns
    -------
    Scene
        Another scene; the given one stays.

    Raises
    ------
    InputError
        A bad value among them.

    Examples
    --------
    >>> from loadflow.scene import make_scene, with_loads
    >>> scene = with_loads(make_scene({"name": "look"}), ["/data/runs/*.outb"], frame="rotating")
    >>> scene.loads.source, scene.loads.frame
    ('files', 'rotating')
    """
    given = {key: value for key, value in reading.items() if value is not None}
    absolute = [str(Path(file).absolute()) for file in files]
    try:
        read = Loads.model_validate({"source": "files", "files": absolute} | given)
    except ValidationError as error:
        raise InputError(message(error, "loads", {}, Loads)) from error
    update = {key: getattr(read, key) for key in ("source", "files", *given)}
    return scene.model_copy(update={"loads": scene.loads.model_copy(update=update)})


def with_name(scene: Scene, name: str) -> Scene:
    """Return the scene under another name, which is checked as that of a file is."""
    make_scene({"name": name}, "name of the run")
    return scene.model_copy(update={"name": name})
