"""Campaigns of random and hostile input; docs/campaigns.md lists the commands."""
