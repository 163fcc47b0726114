"""Work for worker processes, in a module that they can import."""

import os
import signal
import time
import warnings


def doubled(item):
    """Twice the item; 13 kills the process, as a system does that runs out of memory."""
    if item == 13:
        os.kill(os.getpid(), signal.SIGKILL)
    time.sleep(0.01)
    return 2 * item


def idle(_):
    """Nothing."""


def always_killed(item):
    os.kill(os.getpid(), signal.SIGKILL)


def doubted(item):
    """The item, with a warning that names it."""
    warnings.warn(f"film {item} is thin", UserWarning, stacklevel=1)
    return item
