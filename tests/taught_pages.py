"""Pages that teach by commands, scenes and Python, which tests carry out."""

from pathlib import Path

import loadflow

DOCS = Path(loadflow.__file__).parents[1] / "docs"
TUTORIAL = DOCS / "tutorial.md"
TAUGHT = [TUTORIAL, *sorted((DOCS / "how-to").glob("*.md"))]
