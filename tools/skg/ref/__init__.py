"""The reference: SKG interpreted straight from its specification, in 50-digit arithmetic.

It knows nothing of the firmware and shares no code with it; tests compare the two byte for byte.
"""

from skg.ref.interpreter import Result, run

__all__ = ["Result", "run"]
