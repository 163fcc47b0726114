"""``python -m loadflow`` is the command line."""

from loadflow.cli import main

main()
