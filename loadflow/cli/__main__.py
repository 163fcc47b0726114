"""``python -m loadflow.cli``."""

from loadflow.cli import main

main()
