"""What Gracilis raises. Messages are those of the program; str(error) has a line for each problem."""


class Error(Exception):
    """The base of all errors whose cause lies outside of Gracilis.

    exit_code: int, what the program would have ended with.
    problems: list of dict with the keys file, where, what, remedy (each str, may be empty).
    """

    def __init__(self, message, exit_code=1, problems=()):
        super().__init__(message)
        self.exit_code = exit_code
        self.problems = list(problems)

    def __reduce__(self):
        return type(self), (str(self), self.exit_code, self.problems)


class ConfigurationError(Error):
    """A scene or a setting is wrong (exit code 2)."""


class InputError(Error):
    """A file or an array is missing, malformed or holds what cannot be used (exit code 3)."""


class QualityError(Error):
    """A simulation made something that must not be used, such as a value that is not finite (exit code 5)."""


class SceneWarning(UserWarning):
    """What a user should know about a scene that can be run all the same."""
