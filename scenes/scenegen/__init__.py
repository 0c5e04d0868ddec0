"""What generate.py builds the committed scene files from. Lengths are metres, Z is up."""
