; Axes at rest under real-time inputs (inputs_of_axes.csv), visible in the trace group `axis`:
;   X  0.1 mm on the additional interface, through a PT2 of 20 ms; the interface is switched on by --set, see README.md
;   Y  a force of -1 m/s2: the axis rests 0.1 mm away, force x time constant / Kv; M30 waits for it, so its window is
;      made 0.2 mm by --set (with the 0.01 mm of the list the run ends with K-0130: it never arrives)
;   Z  an encoder that reads 0.05 mm too much: the load rests 0.05 mm short
%INPUTS_OF_AXES
N10 G04 1
N20 M30
