#!/usr/bin/python3
"""`python3 -m rbc aggregates`, without a path to set."""
from rbc import command_line  # noqa: F401  says what is missing
from rbc.commands.aggregates import main

if __name__ == "__main__":
    main()
