"""`python -m lumiar` is the command `lumiar`."""

from .cli import main

main()
