"""One line of progress with an estimate of the time left, on standard error."""
import sys
import time


class Progress:
    """Steps have weights in any unit of expected work; the rate so far gives the time left."""

    def __init__(self, name, weight):
        self.name, self.weight, self.done, self.started = name, weight, 0.0, time.monotonic()

    def step(self, text, weight=1.0):
        """That much is done; text says what it was."""
        self.done += weight
        spent = time.monotonic() - self.started
        left = spent * max(self.weight - self.done, 0) / self.done
        print(f"{self.name}: {text}  [{spent:.0f} s, about {left:.0f} s left]", file=sys.stderr, flush=True)
