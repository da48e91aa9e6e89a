"""What a run leaves behind: result, fields, history, picture; and what it says while it runs."""
