"""Command lines: a module for each command of `python3 -m rbc`, which its main() runs."""
