"""Who touches whom, and where; kept up to date as things move."""
