"""How a scene is made again in another process: functions that pickle knows by their names."""

from . import _core


def scene(**keys):
    return _core.Scene(**keys)


def load(path, **keywords):
    return _core.load(path, **keywords)


def demo(name, **keywords):
    return _core.demo(name, **keywords)
