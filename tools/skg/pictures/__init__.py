"""Pictures of tapes and drawings."""
