"""The HTTP server and its workers: portraits in, jobs over them, snapshots of their progress out."""
