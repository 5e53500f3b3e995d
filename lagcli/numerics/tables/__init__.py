"""The result as text, JSON, CSV, NPZ and Parquet."""
