"""What a page was made of, kept in its head; read without what draws pages."""

from __future__ import annotations

import re
from pathlib import Path


def mark_of(path: Path) -> str | None:
    """Return the mark that a page was written with; None without a page or a mark.

    Parameters
    ----------
    path : Path
        The page.

    Returns
    -------
    str or None
        The mark.

    Examples
    --------
    >>> import tempfile
    >>> from pathlib import Path
    >>> from loadflow.report import mark_of, write_page
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     mark_of(write_page(Path(folder) / "page.html", "Look", {}, [], mark="4711"))
    '4711'
    """
    if not path.is_file():
        return None
    with path.open(encoding="utf-8", errors="replace") as stream:
        found = _MARK.search(stream.read(_HEAD))
    return found[1] if found else None


_HEAD = 1000  # characters in which the mark is found
_MARK = re.compile(r'<meta name="made-of" content="([^"]+)">')
