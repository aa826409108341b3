"""Our scenes for other renderers: the reader of GLB files, a writer for each renderer, and how each is run and
timed."""
