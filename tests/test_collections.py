"""How often Python looks for unreachable objects."""

import gc

import pytest

from loadflow.numerics.collections import FEW, few_collections


def test_a_process_collects_as_before_once_what_made_many_objects_has_ended_or_failed():
    before = gc.get_threshold()

    def fails():
        with few_collections():
            assert gc.get_threshold()[0] == FEW > before[0]
            assert gc.get_freeze_count() > 0
            with few_collections():
                pass
            assert gc.get_threshold()[0] == FEW
            assert gc.get_freeze_count() > 0
            raise RuntimeError

    with pytest.raises(RuntimeError):
        fails()
    assert gc.get_threshold() == before
    assert gc.get_freeze_count() == 0
