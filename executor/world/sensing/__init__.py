"""What robots and cameras measure."""
