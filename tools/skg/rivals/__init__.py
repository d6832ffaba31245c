"""The rivals of SKG: programs in other languages of its time, translated into SKG programs.

A wing that shares no geometry with the firmware or the reference, so that these can be checked against it.
"""
