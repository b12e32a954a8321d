"""Load path of rigid halves."""
