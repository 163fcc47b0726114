"""Every printed number of the journal bearing, table by table."""

import pytest

from loadflow.validation import _journal_shapes as shapes
from loadflow.validation import journal

TABLES = [
    journal.base_load_checks,
    journal.periodic_load_checks,
    journal.friction_checks,
    journal.closed_form_checks,
    journal.converged_table_checks,
    journal.side_flow_checks,
    journal.squeeze_checks,
    shapes.coefficient_checks,
    shapes.pad_checks,
    shapes.comsol_checks,
    shapes.slider_checks,
]


@pytest.mark.parametrize("table", TABLES, ids=lambda table: table.__name__)
def test_printed_numbers(table):
    checks = list(table())
    assert checks
    missed = [
        f"{c.source}, {c.name}: {c.got:.6g} beside {c.expected:.6g} ({c.deviation:+.4f})"
        for c in checks
        if not c.ok
    ]
    assert not missed, "\n".join(missed)
