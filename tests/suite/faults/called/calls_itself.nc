L calls_itself.nc
M17
