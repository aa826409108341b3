"""What the experiments share: runs of the program (context, measure), tables, the machine's record, fits and style."""
