"""How much lag does the gain of the position controller take away? As cells of a notebook."""

import kontur

# %% one run
run = kontur.run("programs/square_corner.nc", settings={"X,Y.getriebe[0].kv": 3000})
print(run)
# %% columns
print(run.to_pandas()[["t_s", "line", "X_set_mm", "X_lag_mm"]].describe())
# %% many runs
table = kontur.sweep("programs/square_corner.nc", {"X,Y.getriebe[0].kv": "1000..5000:1000"})
print(table.to_pandas()[["X,Y.getriebe[0].kv", "duration_s", "X_lag_max_mm"]])
