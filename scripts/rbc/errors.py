"""What is wrong with what a user gave."""


class InputError(ValueError):
    """Of a file or an argument, in words for the one who gave it."""
