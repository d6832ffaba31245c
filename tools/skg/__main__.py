"""`python -m skg`: the command `skg`, where its script is not on the path."""

from skg.cli import main

if __name__ == "__main__":
    main()
