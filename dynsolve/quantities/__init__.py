"""What the derivation names."""
