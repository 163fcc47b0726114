"""A value that no key can have is refused with the file and the key, whichever key it is."""

import math

import pytest
from test_every_key import leaves, scene_of, scene_with, ways
from walk_scenes import BASES, WALKED, files

from loadflow.errors import InputError
from loadflow.scene.unused import unused_keys

WRONG = ({"no such key": 1.0}, math.nan, 1e300)
"""A table where no table stands, or with a key that it does not have; what is no number."""


@pytest.fixture(scope="module")
def words(tmp_path_factory):
    return files(tmp_path_factory.mktemp("values"))


def keys_once(words):
    """A scene and a path for every key of every class, each once."""
    seen = set()
    for name in BASES:
        scene = scene_of(BASES[name], words)
        for section in dict.fromkeys(where.split(".")[0] for where in WALKED[name]):
            table = scene.model_dump(mode="json", include={section})[section]
            for path, value in leaves(table):
                *_, owner = [(section, path), *ways(scene, section, path)]
                if owner not in seen:
                    seen.add(owner)
                    yield name, section, path, value, table


def test_a_wrong_value_is_refused_with_its_key(words):
    told, tried = [], 0
    for name, section, path, value, table in keys_once(words):
        number = isinstance(value, int | float) and not isinstance(value, bool)
        key = next(str(part) for part in reversed(path) if not isinstance(part, int))
        for wrong in WRONG if number else WRONG[:1]:
            where = ".".join(map(str, (section, *path)))
            try:
                scene = scene_with(name, words, section, path, wrong, table)
            except InputError as error:
                said = str(error)
                # a number too large for what stands beside it is told with that
                known = section if wrong == 1e300 else key
                if not (said.startswith("scene: ") and known in said):
                    told.append((where, wrong, said))
            except Exception as error:  # what is no message of the package
                told.append((where, wrong, repr(error)))
            else:
                if where not in unused_keys(scene):
                    told.append((where, wrong, "accepted"))
            tried += 1
    assert told == []
    assert tried > 1000
