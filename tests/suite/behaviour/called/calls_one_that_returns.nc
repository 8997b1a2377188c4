L returns_to_main.nc
X3 F6000
M17
